#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include <boresight/plant/antenna/antenna_plant.hpp>
#include <boresight/plant/linear/state_space.hpp>

namespace boresight::control {

/// A disturbance torque on the antenna, applied where the wind acts.
enum class DisturbanceType { step, impulse };

/// Boresight response to a torque of 1 N m from t = 0 on (step), or of 1 N m s at t = 0 (impulse),
/// at the motor shaft, from rest. Errors are relative to the final boresight angle. Under a step
/// this includes static flexure, even if the controller holds the encoder still.
struct ResponseScore {
  double final_value = 0.0;    // rad per N m (N m s)
  double peak = 0.0;           // largest magnitude of the boresight angle, rad
  double time_of_peak = 0.0;   // s; infinite if the final value is only approached
  double largest_error = 0.0;  // largest magnitude less the final value, rad
  /// Time (s) after which the boresight stays within `return_fraction` of `peak` around the final
  /// value; none if it does not within `horizon`.
  std::optional<double> return_time;
  double integral_squared_error = 0.0;  // rad^2 s
  double horizon = 0.0;                 // s, duration of the search for peak and return
};

struct ResponseOptions {
  double return_fraction = 0.05;
  /// Longest simulated time (s). A simulation ends earlier when the slowest pole has decayed by a
  /// factor of 1e-6. With very many states it ends after the time that 4e9 multiplications take.
  double longest = 3600.0;
};

/// A point of a response.
struct ResponseSample {
  double time = 0.0;       // s
  double boresight = 0.0;  // rad
};

/// The linear antenna with a state-space controller in the time domain, exact: a linear map of the
/// complete loop state from one period to the next. With a sampled controller the period is its
/// sample time. The plant moves by its matrix exponential under the held command, which acts one
/// sample after its samples, and the torque begins at a sample. With a continuous controller the
/// period is the dead time (or a part of it if the loop has fast poles). The delayed command is
/// then the polynomial through the demand at the Gauss points of the period one dead time earlier,
/// integrated against the matrix exponential. This is a spectral method of steps (D. Breda, S.
/// Maset, R. Vermiglio, Stability of Linear Delay Differential Equations, 2015, ch. 6). The
/// response to a torque is smooth from period to period, with errors below 1e-9.
class ClosedLoopResponse {
 public:
  /// `delay`: s, of a continuous controller.
  /// @throws InvalidInput as antenna_state_space_controller or for a negative delay;
  /// NumericalFailure for a controller with poles above 120 over the dead time (sample time), which
  /// this method does not resolve.
  ClosedLoopResponse(const plant::AntennaPlant& plant, const plant::StateSpace& controller,
                     double delay);

  double period() const { return period_; }
  /// Largest magnitude of an eigenvalue of the map, with exact dead time. The closed loop is stable
  /// below 1.
  double spectral_radius() const { return spectral_radius_; }
  /// ln(spectral radius) over the period, 1/s: the real part of the slowest pole.
  double abscissa() const;
  bool stable() const { return spectral_radius_ < 1.0; }

  /// Computes the integral of the squared boresight angle after an impulse, and of its squared
  /// error after a step, from a Lyapunov equation over all time. Peak and return time come from the
  /// simulated response.
  /// @throws NumericalFailure unless the loop is stable.
  ResponseScore score(DisturbanceType course, const ResponseOptions& options = {}) const;

  /// The boresight angle up to `duration`, at the points of every period.
  /// @throws InvalidInput for a duration that is not positive or takes more than a million periods.
  std::vector<ResponseSample> boresight(DisturbanceType course, double duration) const;

 private:
  Eigen::VectorXd start(DisturbanceType course) const;
  double between(const Eigen::VectorXd& values, double fraction) const;

  double period_ = 0.0;
  Eigen::VectorXd fraction_, weight_;  // Gauss's points on (0, 1)
  Eigen::VectorXd barycentric_;        // weights of the polynomial through them
  Eigen::MatrixXd transition_;         // states x states
  Eigen::VectorXd step_, impulse_;     // effect of a constant torque; state after an impulse
  Eigen::MatrixXd boresight_;          // points x states
  Eigen::VectorXd boresight_step_;     // points
  double spectral_radius_ = 0.0;
};

}  // namespace boresight::control
