#pragma once

#include <array>
#include <memory>

#include <Eigen/Core>

#include <boresight/control/loops/closed_loop.hpp>
#include <boresight/design/problem/goals.hpp>
#include <boresight/design/problem/tracking_problem.hpp>

namespace boresight::design {

/// Accuracy of the fixed-gain evaluation on each plant.
struct FixedGainOptions {
  /// Error allowed in a variance per panel of frequencies, relative to the root of the panel's
  /// width (control::LoopQuadrature). With the default, the boresight rms agrees with the tuner's
  /// within 1e-5, control effort and Ms within 1e-4.
  double tolerance = 1e-7;
  /// Plants with an Ms above this are checked by eigenvalues, not by Nyquist encirclements alone.
  double confirm_peak = 4.0;
};

/// Values of a fixed-gain controller on one plant. Variances in rad^2 of motor (boresight) and
/// (rad/s)^2 (control effort).
struct FixedGainValues {
  double wind_variance = 0.0;     // in the problem's wind at its mean speed
  double climate_variance = 0.0;  // expected over the problem's climate; 0 without one
  double noise_variance = 0.0;
  double effort_variance = 0.0;
  /// Of valve demand and motor torque driven by the wind; 0 unless the constraints include gusts.
  double wind_demand_variance = 0.0;  // (rad/s)^2
  double wind_torque_variance = 0.0;  // (N m)^2
  /// Ms, order of control::loop_breaks; 1 where |S| does not exceed 1.
  std::array<double, 3> sensitivity_peaks{1.0, 1.0, 1.0};
  /// By Nyquist encirclements along the frequencies: a quick filter; confirm() gives the verdict.
  bool stable = false;
};

/// Evaluates one fixed-gain controller on plant after plant, values only. It is made for Monte
/// Carlo and sensitivity studies, which need thousands of evaluations per second. The frequencies,
/// the weights of wind and noise and the controller's compensators are computed once. Each plant
/// costs only its own response at some 300 of these frequencies, without allocation. The values of
/// a plant do not depend on the plants before it. Use one object per thread; copies are
/// independent.
class FixedGainEvaluator {
 public:
  /// Uses the problem's wind, climate, noise, dead time and bands. Its plant determines only the
  /// frequency band (valve corner, analysis_band).
  /// @throws InvalidInput as control::validate, motor_wind_spectrum(problem), or for a tolerance or
  /// peak that is not positive.
  FixedGainEvaluator(const TrackingProblem& problem, const control::Controller& controller,
                     const Constraints& goals, const FixedGainOptions& options = {});
  ~FixedGainEvaluator();
  FixedGainEvaluator(const FixedGainEvaluator& other);
  FixedGainEvaluator& operator=(const FixedGainEvaluator& other);
  FixedGainEvaluator(FixedGainEvaluator&& other) noexcept;
  FixedGainEvaluator& operator=(FixedGainEvaluator&& other) noexcept;

  /// @throws NumericalFailure for a response that is not finite.
  FixedGainValues evaluate(const plant::AntennaPlant& plant);

  /// True if the values need confirmation by eigenvalues: the encirclements show instability, or an
  /// Ms exceeds FixedGainOptions::confirm_peak.
  bool near_the_axis(const FixedGainValues& values) const;
  /// Eigenvalues of the closed loop, position loop open and closed, about 1 ms.
  /// @throws NumericalFailure as numerics::eigenvalues.
  control::StabilityVerdict confirm(const plant::AntennaPlant& plant);

  const control::Controller& controller() const;
  /// Frequencies (rad/s, rising) used for the last plant.
  Eigen::ArrayXd frequencies() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace boresight::design
