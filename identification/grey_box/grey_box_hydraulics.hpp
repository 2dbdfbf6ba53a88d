#pragma once

#include <Eigen/Core>

#include <boresight/identification/grey_box/grey_box_record.hpp>

namespace boresight::identification {

/// Coefficients of the hydraulic half. Pressures are expressed as the recorded torque (N m), flows
/// as the recorded motor rate (rad/s).
struct HydraulicCoefficients {
  enum : Eigen::Index {
    stiffness_1,      // N m/rad: of the oil on the side that drives upwards
    stiffness_2,      // N m/rad
    cross_leakage,    // rad/s per N m: across the motors
    null_leakage,     // through the valve's centre, from supply and to return
    case_leakage,     // from either side to the case
    valve_gain,       // rad/s of opening per rad/s of command
    valve_null,       // rad/s of opening without command
    valve_lag,        // s
    valve_curvature,  // relative increase of the gain at the largest command
    line_resistance,  // N m per rad/s: pressure lost between valve and motor ports, each way
    supply_torque,    // N m
    supply_droop,     // relative fall of the supply at the largest command
    tachometer_zero,  // rad/s
    tachometer_lag,   // s
    correction,       // 1/s
    valve_lap,        // rad/s of opening that the lands cover about the centre; below 0: underlap
    count
  };
};

/// Scales of the coefficients.
struct HydraulicUnits {
  double supply_torque = 0.0;    // N m, as stated
  double return_torque = 0.0;    // N m
  double largest_command = 0.0;  // rad/s, in size, of all records
};

/// Predicts the recorded pressures of both sides from the recorded motor rate w and the valve's
/// command, one step ahead. With o the opening, s(y) a square root that keeps its sign, both
/// pressures P as torque:
///   P1' =  K1 (q1 - w - gx (P1 - P2) + g0 (Ps + Pr - 2 P1) - gc P1) + l (measured - P1)
///   P2' = -K2 (q2 - w - gx (P1 - P2)) + K2 (g0 (Ps + Pr - 2 P2) - gc P2) + l (measured - P2)
///   o > 0: q1 = o s(2 (Ps - P1 - R w)/(ps - pr)), q2 = o s(2 (P2 - R w - Pr)/(ps - pr)),
///   mirrored for o < 0
/// as plant::to_feedback_system but for the lines' resistance R; w the recorded rate less its zero
/// and put forward by the tachometer's lag, the opening that of port_opening behind the valve's
/// lag. Heun's method.
///
/// Writes measured less predicted pressure of both sides, 2 a sample, and, unless `jacobian` is
/// null, its derivatives (coefficients x 2 samples). Nothing is allocated per sample.
/// @throws InvalidInput for a record without valve command, or a number of coefficients other than
/// count.
void predict_pressures(const GreyBoxRecord& record, const HydraulicUnits& units,
                       const Eigen::VectorXd& coefficients, Eigen::VectorXd& residuals,
                       Eigen::MatrixXd* jacobian);

/// The port's opening (rad/s) at a spool position s (rad/s of command), and its derivatives: by the
/// spool and, directly, by coefficients:
///   x = gain s (1 + curvature |s|/largest command) + null
///   o = x - (sqrt((x + lap)^2 + e^2) - sqrt((x - lap)^2 + e^2))/2,  e 2/1000 of the largest
///   command
/// which rises with s: nothing within the lap, x less the lap beyond; twice x within an underlap,
/// where both lands let oil through. Leakage takes a flow in proportion to the load, the lap the
/// same at every load; as most of the load is friction of nearly one size, the two look alike, and
/// a lap of a thousandth of the stroke counts as much as a good part of the leakage.
struct PortOpening {
  double value = 0.0;
  double by_spool = 0.0;
  double by_gain = 0.0;
  double by_curvature = 0.0;
  double by_null = 0.0;
  double by_lap = 0.0;
};
PortOpening port_opening(const Eigen::VectorXd& coefficients, const HydraulicUnits& units,
                         double spool);

/// d/dt of both pressures (N m/s) at an opening (rad/s) and a motor rate (rad/s), without
/// correction, and its derivatives: by the pressures, the opening, the rate and, directly, the
/// coefficients.
struct PressureRates {
  Eigen::Vector2d value;
  Eigen::Matrix2d by_pressure;
  Eigen::Vector2d by_opening, by_rate;
  Eigen::Matrix<double, 2, HydraulicCoefficients::count> by_coefficient;
};
PressureRates pressure_rates(const Eigen::VectorXd& coefficients, const HydraulicUnits& units,
                             const Eigen::Vector2d& pressure, double opening, double rate);

}  // namespace boresight::identification
