#pragma once

#include <array>
#include <optional>
#include <vector>

#include <boresight/design/audit/audit_graph.hpp>
#include <boresight/design/audit/physical_check.hpp>
#include <boresight/io/audit/resonance_verdict.hpp>

namespace boresight::io {

/// A case's numbers at the motor shaft, all motors, recomputed from what is printed nearest to
/// them. SI.
struct ShaftNumbers {
  double motors = 0.0;      // inertia of all motors
  double gear_train = 0.0;  // load inertia without the antenna
  double antenna = 0.0;     // inertia of the antenna
  double oil_stiffness = 0.0;
  double supply_torque = 0.0;  // at the supply pressure, the return pressure not taken off
  double slew_rate = 0.0;
};
/// @throws InvalidInput unless the graph is case_graph of the case.
ShaftNumbers shaft_numbers(const Case& antenna, const design::AuditGraph& graph);

/// Inertia over the fifth power of the diameter (kg/m3), Sommerville, section II: 64 m with 100e6
/// lbf ft s2 and 70 m with 241.667e6 about elevation, 70 m with 303.3e6 about azimuth.
inline constexpr std::array dss14_inertia_figures{0.126, 0.195, 0.245};

/// The physical checks of a case, those that hold and those that fail.
struct PhysicalChecks {
  ShaftNumbers shaft;
  /// Measured against expected, where a resonance was measured.
  std::optional<ResonanceVerdict> resonance;
  std::vector<design::PhysicalCheck> checks;
};

/// Physical checks of a case. One whose inputs the case does not have is left out. Their ids, and
/// when they fail:
/// - inertia_remainder: what motors and gear train leave of a measured inertia is negative, or
///   less than half of what the antenna needs. Explained by an inertia "as_printed" or
///   "recomputed";
/// - friction_slope: as viscous friction it damps a mode that was seen to ring (damping ratio over
///   1), or takes more than the supply's torque at slew rate;
/// - wave_speed: two lines' sound speeds differ by more than two standard uncertainties, or a slosh
///   frequency printed elsewhere does from its own line's. The second speed has the bounds;
/// - structural_bound: of another axis than the case's;
/// - structural_predictions: with the motors held the linear plant's frequencies, the lowest first
///   as those of structure.prediction, are more than 5 % away from them: entries and numbers are
///   of those that are;
/// - structural_shares: a mode takes more than half of wind or beam and three times its fraction of
///   the inertia. Entries are pairs of such a fraction and the inertia's, numbers the bending of
///   the beam (rad) in the mean wind;
/// - motors_held: several antennas have the frequencies that the case states with the motors held
///   (plant/antenna/motors_held_modes.hpp);
/// - gear_stiffness: that of the gear train as stated and the plant's, which follows from the
///   locked-rotor frequency, are more than a factor of 1.3 apart; where an uncertainty of it is
///   stated, instead more than three standard uncertainties u, a factor of 1 + 3 u, and 1.05. u
///   also has what is stated for inertia and locked-rotor frequency. Explained by "other_antenna",
///   the entry's value then which of structure_specifications; "heaviest_mode", another frequency
///   of that mode, the entry; "inputs", where no frequency of it does; "missing_modes", without
///   modes; "held_frequencies", where no other antenna does;
/// - ensemble_range: [ensemble] states a narrower range than the case's uncertainty of the number
///   (member_ranges.hpp, spread_of_stated): a pair of entries and of numbers for each;
/// - impulse_order: of two inertias from an accelerating window, the one with more friction
///   subtracted is the larger. Entries are these two and the friction of the first;
/// - resonance_expected: from masses, oil spring and structure (plant::hydraulic_mode), more than
///   three standard uncertainties from the measured one;
/// - resonance_damping: the measured damping ratio is more than a factor of 2 from that of the
///   case's hydraulic mode;
/// - recorder_limit: below the tachometer's voltage at slew rate;
/// - coulomb_levels: of two tests more than 1.5 apart;
/// - slew_rate_without_load: the slew rate at the motor is beyond what the valve, fully open, lets
///   the motors turn at without load, by simulation.valve_stroke or the valve's rated flow (the
///   entries); slew_rate_under_load: against their load: friction and offset torque T there leave
///   of that rate, with the torque Ts of what the supply has above the return, the fraction
///   sqrt(1 - T/Ts), less what leaks (Merritt, Hydraulic Control Systems, 1967; the same valve as
///   design/problem/drive_reach.hpp's, without its overlap); explained by "friction" or
///   "friction_and_offset"; valve_strokes: these two strokes are more than 5 % apart. All by more
///   than two standard uncertainties;
/// - inertia_against_dish: antenna inertia over diameter^5 is a tenth of the least or ten times
///   the largest of dss14_inertia_figures. Structures of one kind have one figure: their masses go
///   with the cube, radii of gyration with the diameter itself;
/// - flywheel_rim: at slew rate the rim of a disk of stated radius runs faster than 150 m/s, where
///   rotation stresses a steel disk with a small bore to (3 + 0.3)/4 rho v^2 = 146 MPa (Timoshenko
///   and Goodier, Theory of Elasticity, article 32), over half of what mild steel bears;
///   flywheel_inertia: all disks have more than ten times the inertia of all else at the motors;
/// - friction_against_supply: breakaway, or the friction curve at slew rate, takes more than 40 %
///   of the supply's torque by more than two standard uncertainties. Explained by "breakaway" or
///   "slewing", and "_beyond_supply" where it so takes more than all of it; the first entry has
///   most part in it, the second is the supply pressure;
/// - friction_test_line: intercept or slope of the constant-speed tests' line is more than a factor
///   of 1.5 and two standard uncertainties beyond what the friction curve has at any speeds;
/// - friction_curve_tests: the curve has as many unknowns as friction_curve.test has tests, and a
///   Stribeck rate that identification::steady_friction_intervals has more than a factor of 1.5
///   wide or open;
/// - return_pressure: drive.return_pressure and simulation.return_pressure are more than 5 %
///   and two standard uncertainties apart;
/// - coincidence: two methods, the entries, print the same inertia to the last digit;
/// - carrier_frequency: a beam wider than 5 deg.
/// @throws InvalidInput as shaft_numbers, make_plant, make_problem and structure_specifications;
/// NumericalFailure as resonating_mode.
PhysicalChecks check_physics(const Case& antenna, const design::AuditGraph& graph);

}  // namespace boresight::io
