#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <boresight/design/problem/budget_speeds.hpp>
#include <boresight/design/studies/controller_study.hpp>
#include <boresight/design/studies/limit_study.hpp>
#include <boresight/design/studies/state_space_study.hpp>
#include <boresight/numerics/parallel_loop.hpp>

namespace boresight::design {
namespace {

// The usable designs for the same purpose and wind speed.
std::vector<NamedController> alternatives(const TuningStudy& section, const TunedController& best) {
  std::vector<NamedController> controllers;
  for (const auto& row : section.controllers) {
    if (row.tuned_for != best.tuned_for || row.wind_speed != best.wind_speed || !row.usable()) {
      continue;
    }
    controllers.push_back({description_of(row), row.design.tuning.controller});
  }
  return controllers;
}

ControllerInTime evaluated(const TimeDomainStudy::Candidate& run, double limit_cycle) {
  const auto& [controller, result, rms] = run;
  return {.limit_cycle_free = is_limit_cycle_free(result.limit_cycles, limit_cycle),
          .limit_cycles = limit_cycle_amplitude(result.limit_cycles),
          .boresight_rms = result.wind.boresight_rms,
          .limit_cycle_runs_complete = limit_cycle_runs_complete(result.limit_cycles),
          .expected = rms};
}

void limit_speeds(const Mission& mission, TunedController& row) {
  row.speed_limits = budget_speeds(tracking_problem(mission), row.design.tuning.controller,
                                   mission.budgets, row.effect());
}

// Sets the nonlinear results of the controllers that were compared.
void take_runs(const Mission& mission, const TimeDomainStudy& compared, TuningStudy& section) {
  const double limit_cycle = allowed_limit_cycle(mission);
  for (auto& row : section.controllers) {
    if (!row.usable()) continue;
    if (const auto run = run_of(compared, row)) {
      row.in_time = evaluated(*run, limit_cycle);
      limit_speeds(mission, row);
    }
  }
}

bool needed(const TuningStudy& section, double speed) {
  return std::ranges::any_of(
      section.budgets, [&](const PointingBudget& budget) { return budget.wind_speed == speed; });
}

}  // namespace

std::optional<EnsembleCurves> curves_of(const TuningStudy& study, const TunedController& row,
                                        const PlantEnsemble& ensemble, unsigned threads) {
  if (!row.stable() || !row.ensemble || ensemble.members.empty()) return std::nullopt;
  TrackingProblem problem = study.problem;
  problem.wind.mean_speed = row.wind_speed;
  return ensemble_curves(problem, ensemble.members, row.design.tuning.controller, *row.ensemble,
                         highest_compared_speed(row.wind_speed, row.speed_limits), threads);
}

std::string description_of(const TunedController& row) {
  return fmt::format("{}, {}", row.structure, to_string(row.tuned_for));
}

std::optional<TimeDomainStudy::Candidate> run_of(const TimeDomainStudy& section,
                                                 const TunedController& row) {
  if (section.wind_speed != row.wind_speed) return std::nullopt;
  const std::string controller = description_of(row);
  if (section.controller == controller) return section.own();
  const auto one =
      std::ranges::find(section.candidates, controller, &TimeDomainStudy::Candidate::controller);
  return one == section.candidates.end() ? std::nullopt : std::optional(*one);
}

void evaluate_in_time(const Mission& mission, const TimeDomainStudy* compared, TunedFor purpose,
                      std::uint64_t seed, unsigned threads,
                      const std::function<bool()>& interrupted, TuningStudy& section) {
  if (compared == nullptr) return;
  take_runs(mission, *compared, section);
  const double limit_cycle = allowed_limit_cycle(mission);
  std::vector<TunedController*> to_run;
  for (auto& row : section.controllers) {
    if (row.tuned_for != purpose || !row.usable() || row.in_time) continue;
    if (needed(section, row.wind_speed)) to_run.push_back(&row);
  }
  const auto options = comparison_options(mission, seed);
  numerics::for_each_index(to_run.size(), threads, [&](std::size_t i) {
    if (interrupted && interrupted()) return;
    TunedController& row = *to_run[i];
    auto problem = tracking_problem(mission);
    problem.wind.mean_speed = row.wind_speed;
    const auto run = compare_in_time_domain(
        mission, problem, {description_of(row), row.design.tuning.controller}, options);
    if (!run) return;
    row.in_time = evaluated(*run, limit_cycle);
    limit_speeds(mission, row);
  });
}

const TunedController* shown_controller(const TuningStudy& section,
                                        const TimeDomainStudy* in_time) {
  if (const TunedController* recommended = recommended_tuned_controller(section))
    return recommended;
  const TunedController* best = best_controller(section);
  if (best == nullptr || in_time == nullptr) return best;
  for (const auto& controller : section.controllers) {
    if (description_of(controller) == in_time->controller &&
        controller.wind_speed == best->wind_speed && controller.usable()) {
      return &controller;
    }
  }
  return best;
}

ControllerStudy study_controllers(const Mission& mission, const PlantEnsemble& ensemble,
                                  const TuneOptions& options, ChoiceDetail detail) {
  ControllerStudy study{tune_structures(mission, ensemble, options), std::nullopt};
  const auto stopped = [&] { return options.interrupted && options.interrupted(); };
  const TunedController* best = best_controller(study.tuned);
  if (best == nullptr || stopped()) return study;
  const double wind_speed = best->wind_speed;
  const TunedFor purpose = best->tuned_for;
  auto problem = tracking_problem(mission);
  problem.wind.mean_speed = wind_speed;
  std::optional<TimeDomainChoice> choice;
  if (mission.antenna.nonlinear) {
    choice.emplace(mission, problem, options.seed, options.threads);
    for (const auto& one : alternatives(study.tuned, *best)) choice->add(one);
  }
  const auto& structures = options.structures.empty() ? mission.structures : options.structures;
  if (choice) {
    study.time_domain = choice->chosen(structures.state_space ? ChoiceDetail::compared : detail);
  }
  evaluate_in_time(mission, study.time_domain ? &*study.time_domain : nullptr, purpose,
                   options.seed, options.threads, options.interrupted, study.tuned);
  if (!structures.state_space) return study;
  const auto not_run = [&] {
    study.tuned.not_run.push_back({std::string(state_space_name), purpose, wind_speed});
  };
  if (stopped()) {
    not_run();
    return study;
  }
  study.limit = pointing_limit_of(mission, study.tuned, ensemble, wind_speed, options.threads);
  if (stopped()) {
    not_run();
    return study;
  }
  const auto row = state_space_candidate(mission, ensemble, study.tuned, *study.limit, wind_speed);
  if (row) study.tuned.controllers.push_back(*row);
  if (!choice) return study;
  if (row && row->usable()) {
    // Beside nominal designs only one that meets its constraints on every member is fit.
    if (row->tuned_for != purpose) {
      choice.emplace(mission, problem, options.seed, options.threads);
    }
    choice->add({description_of(*row), row->design.tuning.controller});
  }
  study.time_domain = choice->chosen(detail);
  take_runs(mission, *study.time_domain, study.tuned);
  return study;
}

const TunedController* recommended_or(const ControllerStudy& study, Fitness accepted) {
  if (const TunedController* controller = recommended_tuned_controller(study.tuned))
    return controller;
  // One that was not simulated beside others that limit-cycle is none to prefer.
  if (study.time_domain && accepted >= Fitness::lost_in_wind) {
    return shown_controller(study.tuned, &*study.time_domain);
  }
  if (study.tuned.wind_speeds.empty()) return nullptr;
  return recommended_at(study.tuned, study.tuned.wind_speeds.front(), true, {.accepted = accepted});
}

}  // namespace boresight::design
