#pragma once

#include <array>
#include <optional>
#include <vector>

#include <boresight/design/audit/audit_graph.hpp>
#include <boresight/design/audit/physical_check.hpp>
#include <boresight/io/audit/resonance_verdict.hpp>

namespace boresight::io {

/// A case's numbers at the motor shaft for all motors, SI. They are recomputed from the most
/// elementary printed numbers.
struct ShaftNumbers {
  double motors = 0.0;      // inertia of all motors
  double gear_train = 0.0;  // load inertia without the antenna
  double antenna = 0.0;     // inertia of the antenna
  double oil_stiffness = 0.0;
  double supply_torque = 0.0;  // at the supply pressure, return pressure not subtracted
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

/// Physical checks of a case. A check without its inputs is left out. Ids and failure conditions:
/// - inertia_remainder: a measured inertia less motors and gear train is negative, or less than
///   half of the inertia that the antenna needs. Explained by an inertia "as_printed" or
///   "recomputed";
/// - friction_slope: as viscous friction it gives a mode that was seen to ring a damping ratio over
///   1, or takes more than the supply's torque at slew rate;
/// - wave_speed: two lines' sound speeds differ by more than two standard uncertainties, or a slosh
///   frequency printed elsewhere so differs from its own line's. The second speed has the bounds;
/// - structural_bound: it is of another axis than the case's;
/// - structural_predictions: frequencies of the linear plant with locked motors, lowest first,
///   differ by more than 5 % from those of structure.prediction. Entries and numbers are those that
///   differ;
/// - structural_shares: a mode's wind fraction or beam weight exceeds one half and three times its
///   inertia fraction. Entries are pairs of such a fraction and the inertia's. Numbers are the
///   boresight deflection (rad) in the mean wind;
/// - motors_held: several antennas have the frequencies that the case states for locked motors
///   (plant/antenna/motors_held_modes.hpp);
/// - gear_stiffness: the stated gear stiffness and the plant's, which follows from the locked-rotor
///   frequency, differ by more than a factor of 1.3. With a stated uncertainty, they differ
///   instead by more than three standard uncertainties u, a factor of 1 + 3 u, and 1.05. u includes
///   the stated uncertainties of inertia and locked-rotor frequency. Explained by "other_antenna",
///   the entry's value then being the index into structure_specifications; "heaviest_mode", another
///   frequency of that mode, the entry; "inputs", if no frequency of it explains the difference;
///   "missing_modes", without modes; "held_frequencies", if no other antenna explains it;
/// - ensemble_range: the range in [ensemble] is narrower than the case's uncertainty of the number
///   (member_ranges.hpp, spread_of_stated). A pair of entries and of numbers for each;
/// - impulse_order: of two inertias from an accelerating window, the one with more friction
///   subtracted is the larger. Entries are these two and the friction of the first;
/// - resonance_expected: the resonance computed from masses, oil spring and structure
///   (plant::hydraulic_mode) differs from the measured one by more than three standard
///   uncertainties;
/// - resonance_damping: the measured damping ratio differs from that of the case's hydraulic mode
///   by more than a factor of 2;
/// - recorder_limit: it is below the tachometer's voltage at slew rate;
/// - coulomb_levels: those of two tests differ by more than a factor of 1.5;
/// - slew_rate_without_load: the slew rate at the motor exceeds the no-load rate with the valve
///   fully open, by simulation.valve_stroke or the valve's rated flow (the entries);
/// - slew_rate_under_load: the slew rate exceeds the rate under load. Friction and offset torque T
///   reduce the no-load rate by the factor sqrt(1 - T/Ts), less leakage, with Ts the torque of the
///   supply pressure above the return (Merritt, Hydraulic Control Systems, 1967). The valve is that
///   of design/problem/drive_capability.hpp without its overlap. Explained by "friction" or
///   "friction_and_offset";
/// - valve_strokes: these two strokes differ by more than 5 %. Like the two checks before, by more
///   than two standard uncertainties as well;
/// - inertia_against_dish: antenna inertia over diameter^5 is at most a tenth of the least or at
///   least ten times the largest of dss14_inertia_figures. Structures of one kind have one figure:
///   masses scale with the cube of the diameter, radii of gyration with the diameter;
/// - flywheel_rim: at slew rate the rim of a disk of stated radius exceeds 150 m/s. There rotation
///   stresses a steel disk with a small bore to (3 + 0.3)/4 rho v^2 = 146 MPa (Timoshenko and
///   Goodier, Theory of Elasticity, article 32), over half the strength of mild steel;
/// - flywheel_inertia: all disks have more than ten times the inertia of all else at the motors;
/// - friction_against_supply: breakaway, or the friction curve at slew rate, exceeds 40 % of the
///   supply's torque by more than two standard uncertainties. Explained by "breakaway" or
///   "slewing", with "_beyond_supply" if it so exceeds all of it. The first entry is the largest
///   contribution, the second the supply pressure;
/// - friction_test_line: intercept or slope of the constant-speed tests' line lies outside the
///   friction curve's range over all speeds by more than a factor of 1.5 and two standard
///   uncertainties;
/// - friction_curve_tests: the curve has as many unknowns as friction_curve.test has tests, and its
///   Stribeck rate by identification::steady_friction_intervals is open or wider than a factor of
///   1.5;
/// - return_pressure: drive.return_pressure and simulation.return_pressure differ by more than 5 %
///   and two standard uncertainties;
/// - coincidence: two methods, the entries, print the same inertia to the last digit;
/// - carrier_frequency: a beamwidth of more than 5 deg.
/// @throws InvalidInput as shaft_numbers, make_plant, make_problem and structure_specifications;
/// NumericalFailure as resonating_mode.
PhysicalChecks check_physics(const Case& antenna, const design::AuditGraph& graph);

}  // namespace boresight::io
