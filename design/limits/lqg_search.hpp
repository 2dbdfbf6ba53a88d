#pragma once

#include <vector>

#include <boresight/design/limits/sampled_setting.hpp>

namespace boresight::design {

/// What an LQG is made to keep on every plant.
struct LqgSearchGoals {
  double sensitivity_peak = 2.0;  // largest |S| at the valve command
  double valve_effort = 0.6;      // rad/s rms of noise-driven command
};

/// What is searched over: the design believes in more noise and charges more than there is.
struct LqgWeights {
  /// rad^2 of motor per (rad/s)^2: trades rms against both goals.
  double command_weight = 0.0;
  /// (rad/s)^2 s: intensity of white noise added to the command, so that the estimator trusts its
  /// model less there and the loop gets back the margins of state feedback (loop transfer
  /// recovery: J. C. Doyle, G. Stein, IEEE Trans. Automatic Control 24(4), 1979).
  double input_noise = 0.0;
  /// rad^2 s of motor: intensity of white noise in what each spring of the structure feels of its
  /// deflection, as if its stiffness were not known; and the cost of the deflections' mean square
  /// (beam: 1). Both make a design that does not lean on the structure's frequencies (M. Tahk,
  /// J. L. Speyer, IEEE Trans. Automatic Control 32(12), 1987).
  double spring_noise = 0.0;
  double spring_weight = 0.0;
  /// (N m)^2 s: intensity of white noise torque at the motor, as if friction were not known.
  double friction_noise = 0.0;
};

struct LqgSearchResult {
  /// Whether a controller that keeps the goals was found: the rest is empty where not.
  bool found = false;
  LqgWeights weights;
  plant::StateSpace controller;
  /// Beam rms (rad of motor): the largest over the plants.
  double beam_rms = 0.0;
  int candidates = 0;
};

/// The LQG of a setting for weights. @throws as control::lqg.
plant::StateSpace weighted_lqg(const SampledSetting& setting, const LqgWeights& weights);

/// An LQG of `nominal` of little beam rms that keeps the goals: for each input noise the least
/// command weight that does, the input noise by a scan of eight decades and a golden section. A
/// benchmark, not a bound: the family is not all controllers, the search no proof of its least.
/// @throws InvalidInput for a peak not above 1 or an effort not above 0.
LqgSearchResult search_limited_lqg(const SampledSetting& nominal, const LqgSearchGoals& goals);

/// An LQG of `model` that is stable and within the goals on every one of `plants`, of little rms on
/// the worst of them: all five weights, by a compass search in their logarithms, the command weight
/// again the least that does. A benchmark as well. Deterministic, whatever the number of threads.
/// @throws InvalidInput also without plants and for plants of other frequencies than the model's.
LqgSearchResult search_robust_lqg(const SampledSetting& model,
                                  const std::vector<SampledSetting>& plants,
                                  const LqgSearchGoals& goals, unsigned threads);

}  // namespace boresight::design
