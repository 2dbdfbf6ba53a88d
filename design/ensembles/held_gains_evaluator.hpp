#pragma once

#include <array>
#include <memory>

#include <Eigen/Core>

#include <boresight/control/loops/closed_loop.hpp>
#include <boresight/design/problem/goals.hpp>
#include <boresight/design/problem/tracking_problem.hpp>

namespace boresight::design {

/// How closely a held law is looked at on each plant.
struct HeldGainsOptions {
  /// Of a variance: what one panel of frequencies may be wrong by, over the root of its width
  /// (control::LoopQuadrature). At the default a beam rms is within 1e-5 of the tuner's, valve
  /// effort and peaks within 1e-4.
  double tolerance = 1e-7;
  /// Plants with a sensitivity peak above this are judged by eigenvalues, not by the winding alone.
  double confirm_peak = 4.0;
};

/// A law with its gains held on one plant. Variances in rad^2 of motor (beam) and (rad/s)^2 (valve
/// effort).
struct HeldGainsValues {
  double wind_variance = 0.0;     // in the problem's wind at its mean speed
  double climate_variance = 0.0;  // expected over the problem's climate; 0 without one
  double noise_variance = 0.0;
  double effort_variance = 0.0;
  /// Of valve demand and motor torque as the wind drives them; 0 unless the goals ask for gusts.
  double wind_demand_variance = 0.0;  // (rad/s)^2
  double wind_torque_variance = 0.0;  // (N m)^2
  /// Highest |S|, order of control::loop_breaks; 1 where it does not rise above that.
  std::array<double, 3> sensitivity_peaks{1.0, 1.0, 1.0};
  /// By the winding along the frequencies: a quick filter, confirm() has the verdict.
  bool stable = false;
};

/// Judges one control law, its gains held, on plant after plant by value only: what Monte Carlo and
/// sensitivity studies need thousands of times a second. The frequencies, the wind's and noise's
/// weights and the law's compensators are made once; a plant costs its own response at some 300 of
/// them, and no allocation. What a plant is given does not depend on those before it. Copies are
/// independent; not to be shared between threads.
class HeldGainsEvaluator {
 public:
  /// Wind, climate, noise, dead time and bands are the problem's; its plant matters for the band of
  /// frequencies only (valve corner, analysis_band).
  /// @throws InvalidInput as control::validate(law), motor_wind_spectrum(problem), or for a
  /// tolerance or peak that is not positive.
  HeldGainsEvaluator(const TrackingProblem& problem, const control::ControlLaw& law,
                     const HardGoals& goals, const HeldGainsOptions& options = {});
  ~HeldGainsEvaluator();
  HeldGainsEvaluator(const HeldGainsEvaluator& other);
  HeldGainsEvaluator& operator=(const HeldGainsEvaluator& other);
  HeldGainsEvaluator(HeldGainsEvaluator&& other) noexcept;
  HeldGainsEvaluator& operator=(HeldGainsEvaluator&& other) noexcept;

  /// @throws NumericalFailure for a response that is not finite.
  HeldGainsValues evaluate(const plant::AntennaPlant& plant);

  /// Whether values need the eigenvalues' word: the winding says unstable, or a peak stands above
  /// HeldGainsOptions::confirm_peak.
  bool near_the_axis(const HeldGainsValues& values) const;
  /// Eigenvalues of the closed loop, position loop open and closed, about 1 ms.
  /// @throws NumericalFailure as numerics::eigenvalues.
  control::StabilityVerdict confirm(const plant::AntennaPlant& plant);

  const control::ControlLaw& law() const;
  /// Frequencies (rad/s, rising) that the last plant took.
  Eigen::ArrayXd frequencies() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace boresight::design
