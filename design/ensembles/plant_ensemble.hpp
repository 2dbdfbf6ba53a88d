#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <boresight/design/tuning/tuner.hpp>

namespace boresight::design {

/// The 30 perturbed models on which designs of the problem's antenna are evaluated if no records
/// exist.
/// First the nominal plant; then one change at a time: structure frequencies (modes and locked
/// rotor) x 0.95 and x 1.05, oil stiffness x 0.8 and x 1.33, leakage 0.3 times the nominal (0.366
/// 1/s on the reference antenna). Then 24 of a seeded Latin hypercube over frequencies x [0.95,
/// 1.05], oil stiffness x [0.8, 1.33], leakage x [0.3, 1], friction slope [0, 12] N m s/rad. Names
/// state the change.
/// @throws InvalidInput for a nominal leakage that is not positive.
std::vector<EnsembleMember> reference_ensemble(const TrackingProblem& problem, std::uint64_t seed);

/// One controller, evaluated with fixed gains, on one member. Rms at the sky in rad, per axis.
struct MemberResult {
  std::string name;
  bool stable = false;                        // by eigenvalues
  double boresight_rms = 0.0;                 // NaN if unstable, like all below
  double control_effort = 0.0;                // rad/s
  std::array<double, 3> sensitivity_peaks{};  // order of control::loop_breaks
  double worst_constraint = 0.0;              // quantity/limit; infinity if unstable
};

struct EnsembleResult {
  std::vector<MemberResult> members;  // in the order given
  int stable = 0;
  int within_constraints = 0;
  /// Rms of the stable members: smallest, median, 95 % quantile, largest (rad at the sky). NaN if
  /// none is stable.
  double min_rms = 0.0, median_rms = 0.0, high_rms = 0.0, largest_rms = 0.0;
  /// The member with the worst normalised constraint (quantity/limit). Of members within 1e-6 of
  /// the worst the first, so that round-off does not decide.
  std::size_t worst = 0;
};

/// Evaluates a controller with fixed gains on every member instead of the problem's plant. The
/// result does not depend on the number of threads. O(members x (grid + states^3)).
/// @throws InvalidInput without members, and as control::validate.
EnsembleResult evaluate(const TrackingProblem& problem, const std::vector<EnsembleMember>& members,
                        const control::Controller& controller, const Constraints& goals,
                        unsigned threads);

/// Root of the mean square of the members' rms (rad at the sky), by which proposals and motors are
/// compared. Infinite if one member is unstable.
double rms_over_members(const EnsembleResult& ensemble);

}  // namespace boresight::design
