#pragma once

#include <optional>
#include <string>
#include <string_view>

#include <boresight/design/limits/pointing_limit.hpp>
#include <boresight/design/studies/time_domain_study.hpp>
#include <boresight/design/studies/tuning_study.hpp>
#include <boresight/plant/linear/state_space.hpp>

namespace boresight::design {

/// A state-space controller instead of loops with gains: the refined one of a PointingLimit
/// (PointingLimit::refined), on the nonlinear antenna.
struct StateSpaceStudy {
  /// Sampled, in the form of control::antenna_state_space_controller.
  plant::StateSpace controller;
  std::string start;        // PointingLimit::refined_from
  double wind_speed = 0.0;  // m/s, mean
  /// Of the name "state space, order N".
  SimulatedCandidate simulated;
  /// is_limit_cycle_free up to the allowed_limit_cycle.
  bool limit_cycle_free = false;
  /// figure_change from the loops to this controller.
  std::optional<numerics::Interval> change;
};

/// PointingLimit::refined, in the form of control::antenna_state_space_controller, named "state
/// space, order N". None without it.
std::optional<control::Controller> refined_controller(const PointingLimit& limit);

/// The refined controller of a limit at this wind speed (m/s) as one more controller of the study,
/// of the structure state_space_name: assessed and evaluated as tuned loops are. None without it.
/// @throws as assess and evaluate.
std::optional<TunedController> state_space_candidate(const Mission& mission,
                                                     const PlantEnsemble& ensemble,
                                                     const TuningStudy& study,
                                                     const PointingLimit& limit, double wind_speed);

/// The decision between the loops and a state-space controller; the first of these that applies.
enum class StateSpaceVerdict {
  incomplete,    // a run did not complete
  limit_cycle,   // beyond the allowed amplitude
  unsettled,     // after a slew, within the tightest budget
  better,        // by more than negligible_change and by the whole 95 % interval
  no_advantage,  // none of these
};
std::string_view to_string(StateSpaceVerdict verdict);
StateSpaceVerdict verdict(const StateSpaceStudy& study);

/// Simulates the refined controller of a limit as the recommended loops were simulated: by the same
/// options and in the same winds, without separate influences. The problem is that of both. None
/// without a refined controller or Antenna::nonlinear. Takes some 4 s of computing on the 70-m
/// antenna, over `threads`. The result does not depend on their number. @throws as verify_in_time.
std::optional<StateSpaceStudy> study_state_space(const Mission& mission,
                                                 const TrackingProblem& problem,
                                                 const PointingLimit& limit,
                                                 const TimeDomainStudy& loops, unsigned threads);

}  // namespace boresight::design
