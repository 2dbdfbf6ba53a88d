#pragma once

#include <string>

#include <Eigen/Core>

#include <boresight/identification/grey_box/grey_box_parameters.hpp>
#include <boresight/identification/grey_box/grey_box_record.hpp>

namespace boresight::identification {

/// What a fitted drive is made to do.
struct GreyBoxManoeuvre {
  std::string name;
  TestKind test = TestKind::other;
  double sample_time = 0.0;  // s
  /// Valve command (rad/s of no-load speed as stated), or with the rate loop closed the rate
  /// command (rad/s), straight between samples.
  Eigen::VectorXd command;
  bool rate_loop_closed = false;
};

/// What the recorder would show of it, without noise, wind and corrections by measurements: both
/// halves of the model coupled, from rest. With the rate loop closed the valve follows the command
/// plus the integral of its error, as slowly as suits the hydraulic mode. Five steps a sample.
/// @throws InvalidInput for fewer than two samples or a sample time that is not positive;
/// NumericalFailure if the model runs away.
GreyBoxRecord simulate_drive(const GreyBoxParameters& parameters, const Eigen::VectorXd& point,
                             const GreyBoxManoeuvre& manoeuvre);

/// How well the fitted drive, driven by a record's valve command alone, does what was recorded:
/// root mean square of the difference over that of the record about its mean, of rate and torque.
/// 0: the same; 1: no better than the mean. For a record that was not fitted.
struct GreyBoxValidation {
  double rate_error = 0.0;
  double torque_error = 0.0;
};

/// @throws InvalidInput for a record without valve command; as simulate_drive.
GreyBoxValidation validate_drive(const GreyBoxParameters& parameters, const Eigen::VectorXd& point,
                                 const GreyBoxRecord& record);

}  // namespace boresight::identification
