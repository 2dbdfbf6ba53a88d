#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <boresight/identification/grey_box/grey_box_objective.hpp>
#include <boresight/identification/grey_box/grey_box_parameters.hpp>
#include <boresight/numerics/statistics/interval.hpp>
#include <boresight/plant/antenna/friction.hpp>

namespace boresight::identification {

/// Drive parameters estimated by the grey box, true (not as recorded) unless stated otherwise. SI
/// at the motor shaft.
struct DriveEstimate {
  double inertia = 0.0;              // kg m2, all of it
  double inertia_as_recorded = 0.0;  // what the recorder's torque and rate show of it
  double motor_inertia = 0.0;        // all motors with flywheels
  double motor_to_load_ratio = 0.0;  // motors against everything else, Sommerville eq. 27
  double oil_stiffness = 0.0;        // N m/rad
  double bulk_modulus = 0.0;         // Pa
  double leakage_rate = 0.0;         // 1/s
  double offset_as_recorded = 0.0;   // N m, at the campaign's mean pressure
  /// Level at which friction saturates (N m): the intercept of a straight line through high speeds.
  double coulomb_level = 0.0;
  double lowest_frequency = 0.0;  // Hz, locked rotor; 0 without structure
  plant::FrictionCurve friction;
  double tracking_slope = 0.0;  // N m s/rad: of the curve at DriveKnowledge::tracking_rate
  /// s, of a first-order lag: a valve of second order has 2 (damping ratio)/(circular frequency).
  double valve_lag = 0.0;
  double bristle_stiffness = 0.0;  // N m/rad
  double bristle_damping = 0.0;    // N m s/rad
  double rigid_inertia = 0.0;      // kg m2: what turns rigidly with the motors, motors included
  Eigen::VectorXd mode_inertia;    // kg m2, of each mode of the locked rotor
  Eigen::VectorXd mode_frequency;  // Hz
  double mode_damping = 0.0;
  /// True if the records contradict the stated numbers behind inertia or stiffness: do not design
  /// for this drive.
  bool contradicted = false;
};

/// Model errors that the records do not show: standard uncertainties by engineering judgement,
/// separate from the fit's.
struct GreyBoxDiscrepancy {
  /// Of the torque balance, relative: friction that changes with load or position, oil torque that
  /// is not proportional to pressure. Widens inertia and friction by it, frequencies by half of it.
  /// Widens the offset by this fraction of the torque over the root of the number of records.
  double torque_balance = 0.003;
  /// Of the flow balance, relative to the flow: unmodelled effects of valve and lines. Widens the
  /// leakage, which is a small part of the flow.
  double flow_balance = 0.003;
  /// Of the oil's stiffness, relative: waves in the lines, compliant hoses, a pressure-dependent
  /// bulk modulus.
  double stiffness = 0.006;
  /// Of the valve's lag, relative. A second-order valve is fitted as a first-order lag, which is 6
  /// % short at a damping ratio of 0.7 (simulated valves of 12 and 45 Hz, swept to 8 Hz).
  double valve_lag = 0.06;
};

/// The optimum and its uncertainty, as points of the parameters.
struct GreyBoxPosterior {
  Eigen::VectorXd point;
  /// Covariance under a true model with white errors.
  Eigen::MatrixXd formal;
  /// Covariance including the errors' correlation and the model's misfit; never below `formal`.
  Eigen::MatrixXd covariance;
  /// The part that further records of the same kind would not remove: the shift of the optimum with
  /// the prediction horizon, which is zero for a true model.
  Eigen::MatrixXd misfit;
  /// Mean variance of the covariance over the formal one's, by directions.
  double inflation = 1.0;
  double leakage_discrepancy = 0.0;    // relative standard uncertainty
  double torque_discrepancy = 0.0;     // relative
  double stiffness_discrepancy = 0.0;  // relative
  double lag_discrepancy = 0.0;        // relative, of the valve's lag
  double offset_discrepancy = 0.0;     // N m, standard uncertainty: offset_discrepancy
  /// Where the drive moves one way, friction's level and the offset are one number: by how much
  /// either may be the other's (N m, standard uncertainty; the sign is the motion's). 0 otherwise.
  double one_way = 0.0;
  /// If the drive is never fast enough for friction to saturate: standard uncertainty of the
  /// logarithm of the saturating level, and with it of its rate. Slow friction does not change.
  double unsaturated = 0.0;
};

/// Covariance at the optimum of an objective: the formal one made wider by the scatter of the
/// scores over stretches of `stretch` s (a sandwich after P. J. Huber, Proc. 5th Berkeley Symp. 1,
/// 1967, with correlation kept within stretches as in W. K. Newey and K. D. West, Econometrica
/// 55(3), 1987), no direction narrower than the formal one, and by the mean square of `shifts`:
/// how far the optimum moves when predictions reach less far or farther ahead (columns).
GreyBoxPosterior grey_box_posterior(const GreyBoxObjective& objective, const Eigen::VectorXd& point,
                                    const Eigen::MatrixXd& shifts, double stretch);

/// The drive at a point.
DriveEstimate drive_estimate(const GreyBoxParameters& parameters, const Eigen::VectorXd& point);

/// Derivatives of the logarithm of a positive number of the drive by the point.
Eigen::VectorXd log_gradient(const GreyBoxParameters& parameters, const Eigen::VectorXd& point,
                             double DriveEstimate::*member);

/// Samples from the posterior, discrepancies included; deterministic by seed.
std::vector<DriveEstimate> posterior_samples(const GreyBoxParameters& parameters,
                                             const GreyBoxPosterior& posterior, int count,
                                             std::uint64_t seed);

/// A number of an estimate by name.
struct DriveQuantity {
  const char* name;
  const char* unit;
  double DriveEstimate::*member;
};

/// Those that intervals are given for.
const std::vector<DriveQuantity>& drive_quantities();

}  // namespace boresight::identification
