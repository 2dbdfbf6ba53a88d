#pragma once

#include <string>
#include <vector>

#include <boresight/design/audit/audit_graph.hpp>
#include <boresight/io/case/case_file.hpp>

namespace boresight::app {

/// A number that a reason rests on, SI (Hz where the unit says so).
struct NamedNumber {
  std::string name;
  double value = 0.0;
  std::string unit;
};

/// An input or result that contradicts physics or the rest of the case.
struct Implausibility {
  /// What the check looks at, closed: "inertia remainder", "friction slope", "wave speed",
  /// "structural bound", "impulse order", "resonance expected", "resonance damping", "recorder
  /// limit", "Coulomb levels", "coincidence", "carrier frequency", "valve stroke", "friction
  /// against the supply", "friction tests", "return pressure", "inertia against the dish",
  /// "flywheel", "structural predictions", "structural shares", "motors held",
  /// "gear stiffness", "ensemble range".
  std::string check;
  /// The quantity, by id.
  std::string id;
  /// One sentence with the numbers in it.
  std::string reasoning;
  std::vector<NamedNumber> numbers;
};

/// Physical checks of a case. A check whose inputs the case does not have says nothing.
/// - inertia remainder: what motors and gear train leave of a measured inertia is negative, or
///   less than half of what the antenna needs;
/// - friction slope: as viscous friction it damps a mode that was seen to ring (damping ratio over
///   1), or takes more than the supply's torque at slew rate;
/// - wave speed: two lines' sound speeds differ by more than two standard uncertainties, or a slosh
///   frequency printed elsewhere does from its own line's;
/// - structural bound of another axis than the case's;
/// - structural predictions: with the motors held the linear plant's frequencies, the lowest first
///   as those of structure.prediction, are more than 5 % away from them;
/// - motors held: several antennas have the frequencies that the case states with the motors held
///   (plant/antenna/motors_held_modes.hpp);
/// - gear stiffness: that of the gear train as stated and the plant's, which follows from the
///   locked-rotor frequency, are more than a factor of 1.3 apart; where an uncertainty of it is
///   stated, instead more than three standard uncertainties u, a factor of 1 + 3 u, and 1.05. u
///   also has what is stated for inertia and locked-rotor frequency;
/// - ensemble range: [ensemble] states a narrower range than the case's uncertainty of the number
///   (tune/plant_members.hpp, spread_of_stated);
/// - impulse order: of two inertias from an accelerating window, the one with more friction
///   subtracted is the larger;
/// - resonance expected from masses, oil spring and structure (plant::hydraulic_mode), more than
///   three standard uncertainties away (redesign/resonance_verdict.hpp);
/// - resonance damping: the measured damping ratio is more than a factor of 2 from that of the
///   case's hydraulic mode;
/// - recorder limit below the tachometer's voltage at slew rate;
/// - Coulomb levels of two tests more than 1.5 apart;
/// - valve stroke: the slew rate at the motor is beyond what the valve, fully open, lets the motors
///   turn at without load, by simulation.valve_stroke or the valve's rated flow, or against their
///   load: friction and offset torque T there leave of that rate, with the torque Ts of what the
///   supply has above the return, the share sqrt(1 - T/Ts), less what leaks (Merritt, Hydraulic
///   Control Systems, 1967; the same valve as design/problem/drive_reach.hpp's, without its
///   overlap); or these two strokes are more than 5 % apart. All by more than two standard
///   uncertainties;
/// - inertia against the dish: antenna inertia over diameter^5 is a tenth of the least or ten times
///   the largest of DSS-14's, 0.126 (64 m, elevation), 0.195 and 0.245 kg/m3 (70 m, elevation and
///   azimuth; Sommerville, section II). Structures of one kind have one figure: their masses go
///   with the cube, radii of gyration with the diameter itself;
/// - flywheel: at slew rate the rim of a disk of stated radius runs faster than 150 m/s, where
///   rotation stresses a steel disk with a small bore to (3 + 0.3)/4 rho v^2 = 146 MPa (Timoshenko
///   and Goodier, Theory of Elasticity, article 32), over half of what mild steel bears; or all
///   disks have more than ten times the inertia of all else at the motors;
/// - friction against the supply: breakaway, or the friction curve at slew rate, takes more than
///   the supply's torque, or more than 40 % of it, by more than two standard uncertainties;
/// - friction tests: intercept or slope of the constant-speed tests' line is more than a factor of
///   1.5 and two standard uncertainties beyond what the friction curve has at any speeds, or the
///   curve has as many unknowns as friction_curve.test has tests, and a Stribeck rate that
///   identification::steady_friction_intervals has more than a factor of 1.5 wide or open;
/// - return pressure: drive.return_pressure and simulation.return_pressure are more than 5 %
///   and two standard uncertainties apart;
/// - coincidence: two methods print the same inertia to the last digit;
/// - carrier frequency: a beam wider than 5 deg.
std::vector<Implausibility> implausibilities(const io::Case& antenna,
                                             const design::AuditGraph& graph);

}  // namespace boresight::app
