#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>

#include <boresight/design/problem/nonlinear_effect.hpp>
#include <boresight/design/verification/simulated_rms.hpp>

namespace boresight::design {

/// The purpose of a tuning.
enum class DesignPurpose { nominal, robust };

/// Result of a nonlinear simulation at steady rates without wind, for limit cycles.
enum class LimitCycleVerdict {
  not_simulated,
  allowed,    // none, or none beyond the allowed_limit_cycle
  not_shown,  // a nonlinear run in search of limit cycles did not complete
  not_allowed,
};

/// One controller on one antenna in one wind. Angles at the sky, rad.
struct Assessment {
  std::string structure;  // decides exact ties, by alphabetical order
  DesignPurpose purpose = DesignPurpose::nominal;
  std::size_t parts = 0;  // LoopStructure::parts
  bool stable = false;    // on the nominal plant
  /// Stability and constraints on the nominal plant, confirmed by independent code.
  bool verified = false;
  bool nominal_constraints_met = false;
  /// Stable and within every constraint on every ensemble member; false also if not evaluated.
  bool member_constraints_met = false;
  double linear_rms = std::numeric_limits<double>::quiet_NaN();  // boresight error in wind
  /// The same on the nonlinear antenna: none where it was not simulated, NaN where a run in wind
  /// did not complete.
  std::optional<double> simulated_rms;
  /// The estimate from several records behind simulated_rms; none for a single record.
  std::optional<SimulatedRms> expected;
  LimitCycleVerdict limit_cycles = LimitCycleVerdict::not_simulated;
  /// Largest amplitude of the boresight's limit cycles; none where not simulated.
  std::optional<double> limit_cycle_amplitude;
  /// Pointing budgets required in this wind, and those met.
  std::size_t budgets_required = 0, budgets_met = 0;
};

/// Fitness of a controller for use, best first. The last deficiency of this list that applies
/// decides.
enum class Fitness {
  fit,             // free of everything below
  misses_budget,   // a required pointing budget
  misses_member,   // unstable or beyond a constraint on an ensemble member, or not evaluated there
  not_shown,       // a nonlinear run in search of limit cycles did not complete
  limit_cycle,     // beyond the allowed_limit_cycle
  lost_in_wind,    // the nonlinear run in wind did not complete
  misses_nominal,  // a constraint on the nominal plant
  unverified,      // not confirmed by independent code
  unstable,        // on the nominal plant, or without an rms
};

Fitness fitness(const Assessment& assessment);

/// Nonlinear effect of its simulation beyond linear_rms. The factor is infinite where a run in wind
/// did not complete. No effect where it was not simulated.
NonlinearEffect nonlinear_effect(const Assessment& assessment);

/// The figure that ranks controllers of equal fitness, rad rms: NonlinearEffect::rms of the linear
/// rms, which is the simulated rms with the limit cycle. It is the linear rms where a run in wind
/// did not complete.
double ranking_figure(const Assessment& assessment);

/// Counts one budget (rad rms) as required. It counts as met if NonlinearEffect::for_budgets is
/// within it, no run was lost, and the limit-cycle runs completed.
void count_budget(double budget, Assessment& assessment);

/// Relative change of the ranking figure from `from` to `to` with its interval, for the same winds
/// (relative_change). None without the same winds.
std::optional<numerics::Interval> figure_change(const Assessment& from, const Assessment& to);

/// True if two ranking figures tie: within that relative difference of one another, or within the
/// interval of figure_change.
bool are_tied(const Assessment& one, const Assessment& other, double relative);

}  // namespace boresight::design
