#pragma once

#include <boresight/design/limits/robust_constraints.hpp>

namespace boresight::design {

/// Search variables: fictitious noise and additional costs of the LQG design.
struct LqgWeights {
  /// rad^2 of motor per (rad/s)^2: trades rms against both constraints.
  double command_weight = 0.0;
  /// (rad/s)^2 s: intensity of white noise added to the command. The estimator then relies less on
  /// its model there, and the loop recovers the margins of state feedback (loop transfer recovery:
  /// J. C. Doyle, G. Stein, IEEE Trans. Automatic Control 24(4), 1979).
  double input_noise = 0.0;
  /// `spring_noise`, rad^2 s of motor: intensity of white noise in the deflection of each spring of
  /// the structure, as if its stiffness were uncertain. `spring_weight`: cost of the deflections'
  /// mean square (boresight: 1). Both reduce the design's dependence on the structure's frequencies
  /// (M. Tahk, J. L. Speyer, IEEE Trans. Automatic Control 32(12), 1987).
  double spring_noise = 0.0;
  double spring_weight = 0.0;
  /// N m: rms of a slow torque at the motor with the corner `friction_corner` (rad/s), as which the
  /// design sees dry friction. The estimator follows it, so that the loop acts against friction as
  /// with integral action, and does not take the torque of a motor that friction holds for the
  /// wind's.
  double friction_torque = 0.0;
  double friction_corner = 0.2;
};

struct LqgSearchResult {
  /// True if a controller that meets the constraints was found; otherwise the rest is empty.
  bool found = false;
  LqgWeights weights;
  plant::StateSpace controller;
  Eigen::Index full_order = 0;  // of the LQG before any reduction
  /// Boresight rms (rad of motor): the largest over the plants.
  double boresight_rms = 0.0;
  int candidates = 0;
};

/// The LQG of a setting with the given weights. @throws as control::lqg.
plant::StateSpace weighted_lqg(const SampledSetting& setting, const LqgWeights& weights);

/// Searches an LQG of `nominal` with small boresight rms that meets the constraints. For each input
/// noise it takes the smallest feasible command weight; the input noise is found by a scan of eight
/// decades and a golden section. The result is a benchmark, not a bound: the family does not
/// contain all controllers, and the search does not prove optimality.
/// @throws as validate.
LqgSearchResult search_limited_lqg(const SampledSetting& nominal, const SampledLoopGoals& goals);

/// Searches an LQG of `model` that meets the constraints, with small worst-case rms. A compass
/// search in the logarithms varies all weights but the command weight, which is again the smallest
/// feasible one. The controller found is then reduced (ControllerReduction) to the lowest order
/// that meets the same constraints with an rms at most 1 % larger. The result is also a benchmark.
/// Deterministic, whatever the number of threads.
LqgSearchResult search_robust_lqg(const SampledSetting& model,
                                  const RobustConstraints& constraints);

}  // namespace boresight::design
