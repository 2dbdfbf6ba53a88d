#pragma once

#include <array>
#include <string>
#include <vector>

#include <boresight/design/tuner.hpp>

namespace boresight::design {

/// A plant that may be the true one.
struct EnsembleMember {
  std::string name;
  plant::AntennaPlant plant;
};

/// One control law, its gains held, on one member. Rms at the sky in rad, one axis.
struct MemberResult {
  std::string name;
  bool stable = false;                        // by eigenvalues
  double beam_rms = 0.0;                      // NaN if unstable, like all below
  double valve_effort = 0.0;                  // rad/s
  std::array<double, 3> sensitivity_peaks{};  // order of control::loop_breaks
  double worst_goal_ratio = 0.0;              // quantity/limit; infinity if unstable
};

struct EnsembleResult {
  std::vector<MemberResult> members;  // in the order given
  int stable = 0;
  int within_goals = 0;
  /// Of the stable members' rms: smallest, median, 95 % quantile, largest (rad at the sky); NaN if
  /// none is stable.
  double least_rms = 0.0, median_rms = 0.0, high_rms = 0.0, largest_rms = 0.0;
  std::size_t worst = 0;  // the member farthest from its goals
};

/// Judges a law with its gains held on every member in place of the problem's plant. Results do not
/// depend on the thread count. O(members x (grid + states^3)).
/// @throws InvalidInput without members, and as control::validate(law).
EnsembleResult judge(const TrackingProblem& problem, const std::vector<EnsembleMember>& members,
                     const control::ControlLaw& law, const HardGoals& goals, unsigned threads);

}  // namespace boresight::design
