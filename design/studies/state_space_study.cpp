#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include <boresight/control/loops/state_space_controller.hpp>
#include <boresight/design/decisions/negligible_change.hpp>
#include <boresight/design/studies/pointing_evaluation.hpp>
#include <boresight/design/studies/state_space_study.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::design {

std::string_view to_string(StateSpaceVerdict verdict) {
  switch (verdict) {
    case StateSpaceVerdict::incomplete:
      return "incomplete";
    case StateSpaceVerdict::limit_cycle:
      return "limit_cycle";
    case StateSpaceVerdict::unsettled:
      return "unsettled";
    case StateSpaceVerdict::better:
      return "better";
    case StateSpaceVerdict::no_advantage:
      return "no_advantage";
  }
  throw InvalidInput("state-space verdict: not one of those there are");
}

StateSpaceVerdict verdict(const StateSpaceStudy& study) {
  if (!study.change) return StateSpaceVerdict::incomplete;
  if (!study.limit_cycle_free) return StateSpaceVerdict::limit_cycle;
  const auto& slew = study.simulated.result.slew;
  if (slew && !slew->settling_time) return StateSpaceVerdict::unsettled;
  return study.change->upper < 0.0 && study.change->value < -negligible_change
             ? StateSpaceVerdict::better
             : StateSpaceVerdict::no_advantage;
}

std::optional<control::Controller> refined_controller(const PointingLimit& limit) {
  if (!limit.refined) return std::nullopt;
  const auto system = control::antenna_state_space_controller(limit.refined->controller);
  return control::state_space_controller(fmt::format("state space, order {}", system.a.rows()),
                                         system);
}

std::optional<TunedController> state_space_candidate(const Mission& mission,
                                                     const PlantEnsemble& ensemble,
                                                     const TuningStudy& study,
                                                     const PointingLimit& limit,
                                                     double wind_speed) {
  const auto controller = refined_controller(limit);
  if (!controller) return std::nullopt;
  TunedController row;
  row.structure = state_space_name;
  row.tuned_for = ensemble.members.empty() ? TunedFor::nominal : TunedFor::robust;
  row.wind_speed = wind_speed;
  row.design = assess(problem_at(mission, study, wind_speed), *controller, study.goals);
  row.design.name = row.structure;
  evaluate_pointing(mission, ensemble, study, row);
  if (row.ensemble) {
    auto& worst = row.design.tuning.worst_constraint;
    worst = std::max(worst, row.ensemble->members[row.ensemble->worst].worst_constraint);
  }
  return row;
}

std::optional<StateSpaceStudy> study_state_space(const Mission& mission,
                                                 const TrackingProblem& problem,
                                                 const PointingLimit& limit,
                                                 const TimeDomainStudy& loops, unsigned threads) {
  const auto controller = refined_controller(limit);
  if (!controller || !mission.antenna.nonlinear) return std::nullopt;
  StateSpaceStudy study;
  study.controller = *controller->structure.state_space();
  study.start = limit.refined_from;
  study.wind_speed = problem.wind.mean_speed;
  NonlinearVerificationOptions options = loops.options;
  options.explain = options.second_integrator = false;
  options.threads = threads;
  auto simulated = compare_in_time_domain(mission, problem,
                                          {controller->structure.name(), *controller}, options);
  if (!simulated) return std::nullopt;
  study.simulated = std::move(*simulated);
  study.limit_cycle_free =
      is_limit_cycle_free(study.simulated.result.limit_cycles, allowed_limit_cycle(mission));
  study.change = figure_change(loops.own(), study.simulated);
  return study;
}

}  // namespace boresight::design
