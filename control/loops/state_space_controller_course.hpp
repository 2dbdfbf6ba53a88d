#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include <boresight/plant/antenna/antenna_plant.hpp>
#include <boresight/plant/linear/state_space.hpp>

namespace boresight::control {

/// A disturbance at the wind's torque on the antenna.
enum class TorqueCourse { step, impulse };

/// What the beam does after a torque of 1 N m from t = 0 on (step), or of 1 N m s at t = 0
/// (impulse), at the motor shaft, from rest. Errors are taken from where the beam ends, which a
/// controller that keeps its encoder still leaves bent under a step.
struct CourseScore {
  double final_value = 0.0;    // rad per N m (N m s)
  double peak = 0.0;           // largest magnitude of the beam, rad
  double time_of_peak = 0.0;   // s; infinite where the beam only approaches its final value
  double largest_error = 0.0;  // largest magnitude less the final value, rad
  /// s, after which the beam stays within `share` of `peak` around the final value; none if it does
  /// not within `horizon`.
  std::optional<double> return_time;
  double integral_squared_error = 0.0;  // rad^2 s
  double horizon = 0.0;                 // s watched for peak and return
};

struct CourseOptions {
  double return_share = 0.05;
  /// s. A loop whose slowest pole decays by 1e-6 sooner is watched until then, one of very many
  /// states for as long as 4e9 multiplications take.
  double longest = 3600.0;
};

/// A point of a course.
struct CoursePoint {
  double time = 0.0;  // s
  double beam = 0.0;  // rad
};

/// The linear antenna under a state-space controller in the time domain, exact: a linear map from
/// one period to the next of all that the loop remembers. Under a sampled controller the period is
/// its sample time: the plant moves by its matrix exponential under the held command, which acts
/// one sample after its samples, and the torque comes with a sample. Under a continuous one it is
/// the dead time (or a part of it where the loop has fast poles): the delayed command is the
/// polynomial through the demand at Gauss's points of the period one dead time ago, integrated
/// against the matrix exponential (a spectral method of steps; D. Breda, S. Maset, R. Vermiglio,
/// Stability of Linear Delay Differential Equations, 2015, ch. 6). What follows a torque is smooth
/// from period to period, and its errors are below 1e-9.
class ControlledCourse {
 public:
  /// `delay`: s, of a continuous controller.
  /// @throws InvalidInput as antenna_state_space_controller or for a negative delay;
  /// NumericalFailure for a controller with poles above 120 over the dead time (sample time), which
  /// a course cannot follow.
  ControlledCourse(const plant::AntennaPlant& plant, const plant::StateSpace& controller,
                   double delay);

  double period() const { return period_; }
  /// Largest magnitude of an eigenvalue of the map, dead time exact: the closed loop is stable
  /// below 1.
  double spectral_radius() const { return spectral_radius_; }
  /// ln(spectral radius) over the period, 1/s: real part of the slowest pole.
  double abscissa() const;
  bool stable() const { return spectral_radius_ < 1.0; }

  /// The integral of the squared beam after an impulse, and of its error after a step, from a
  /// Lyapunov equation over all time; peak and return from the course itself.
  /// @throws NumericalFailure unless the loop is stable.
  CourseScore score(TorqueCourse course, const CourseOptions& options = {}) const;

  /// The beam up to `duration`, at the points of every period. @throws InvalidInput for a duration
  /// that is not positive or takes more than a million periods.
  std::vector<CoursePoint> beam(TorqueCourse course, double duration) const;

 private:
  Eigen::VectorXd start(TorqueCourse course) const;
  double between(const Eigen::VectorXd& values, double share) const;

  double period_ = 0.0;
  Eigen::VectorXd share_, weight_;  // Gauss's points on (0, 1)
  Eigen::VectorXd barycentric_;     // weights of the polynomial through them
  Eigen::MatrixXd transition_;      // states x states
  Eigen::VectorXd step_, impulse_;  // what a constant torque adds in a period; a jolt's state
  Eigen::MatrixXd beam_;            // points x states
  Eigen::VectorXd beam_step_;       // points
  double spectral_radius_ = 0.0;
};

}  // namespace boresight::control
