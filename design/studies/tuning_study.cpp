#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include <fmt/format.h>

#include <boresight/design/studies/pointing_evaluation.hpp>
#include <boresight/design/studies/time_domain_study.hpp>
#include <boresight/design/studies/tuning_study.hpp>
#include <boresight/design/tuning/structure_parts.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/parallel_loop.hpp>
#include <boresight/plant/antenna/point_response.hpp>

namespace boresight::design {
namespace {

// Of every structure and wind speed: no tuning, or a nominal and a robust one.
struct TuningUnit {
  std::string name;
  control::LoopStructure structure;
  double wind_speed = 0.0;
  std::optional<control::Controller> present = std::nullopt;
  bool asked = true;                    // else only to start others from
  std::vector<std::size_t> parts = {};  // units whose structures this one extends
  std::vector<TunedController> controllers = {};
  std::vector<TuningNotRun> not_run = {};
};

class Study {
 public:
  Study(const Mission& mission, const PlantEnsemble& ensemble, const TuneOptions& options,
        const TuningStudy& section)
      : mission_(mission), ensemble_(ensemble), options_(options), section_(section) {
    if (section.minimises_climate && mission.climate.empty()) {
      throw InvalidInput(
          "tune: expected [[wind.climate]] in the case for the goal rms_over = "
          "climate, found none");
    }
  }

  void search(TuningUnit& unit) const {
    if (!unit.present) {
      search(unit, TunedFor::nominal);
      search(unit, TunedFor::robust);
      return;
    }
    TunedController row = new_row(unit, TunedFor::present);
    row.design =
        assess(problem_at(mission_, section_, unit.wind_speed), *unit.present, section_.goals);
    unit.controllers.push_back(std::move(row));
  }

  // Starts each controller of a unit from those of its parts, so that none is worse than what it
  // extends.
  void improve(TuningUnit& unit, const std::vector<TuningUnit>& units) const {
    bool other_nominal = false;
    for (auto& row : unit.controllers) {
      if (stopped()) return;
      const DesignTask task = task_of(unit, row.tuned_for);
      std::vector<std::vector<double>> starts;
      if (other_nominal) starts.push_back(unit.controllers.front().design.tuning.controller.gains);
      for (const std::size_t part : unit.parts) {
        for (const auto& controller : units[part].controllers) {
          if (controller.tuned_for != row.tuned_for || !controller.stable()) continue;
          std::ranges::move(
              starts_from_part(controller.design.tuning.controller, unit.structure, options_.seed),
              std::back_inserter(starts));
        }
      }
      other_nominal = improve_from(task, starts, row.design);
    }
  }

  void finish(TuningUnit& unit) const {
    for (auto& row : unit.controllers) evaluate_pointing(mission_, ensemble_, section_, row);
  }

 private:
  static TunedController new_row(const TuningUnit& unit, TunedFor purpose) {
    TunedController row;
    row.structure = unit.name;
    row.tuned_for = purpose;
    row.wind_speed = unit.wind_speed;
    return row;
  }

  bool stopped() const { return options_.interrupted && options_.interrupted(); }

  DesignTask task_of(const TuningUnit& unit, TunedFor purpose) const {
    DesignTask task;
    task.name = unit.name;
    task.problem = problem_at(mission_, section_, unit.wind_speed);
    task.structure = unit.structure;
    task.goals = section_.goals;
    task.options.seed = options_.seed;
    task.options.starts =
        unit.asked ? section_.starts : std::min(section_.starts, starts_of_a_part);
    task.options.stop = options_.interrupted;
    for (const auto& [name, controller] : mission_.present_controllers) {
      if (controller.structure == unit.structure)
        task.options.warm_starts.push_back(controller.gains);
    }
    if (purpose == TunedFor::robust) {
      task.options.members = ensemble_.members;
      task.options.objective = section_.objective;
    }
    return task;
  }

  void search(TuningUnit& unit, TunedFor purpose) const {
    if (stopped()) {
      unit.not_run.push_back({unit.name, purpose, unit.wind_speed});
      return;
    }
    DesignTask task = task_of(unit, purpose);
    if (!unit.controllers.empty() && unit.controllers.front().stable()) {
      task.options.warm_starts.push_back(unit.controllers.front().design.tuning.controller.gains);
    }
    TunedController row = new_row(unit, purpose);
    row.design = solve(task);
    unit.controllers.push_back(std::move(row));
  }

  const Mission& mission_;
  const PlantEnsemble& ensemble_;
  const TuneOptions& options_;
  const TuningStudy& section_;
};

// The speeds asked for, or the design's, and those of budgets that must be met.
std::vector<double> speeds_of(const Mission& mission, const TuneOptions& options) {
  std::vector<double> speeds = options.wind_speeds;
  if (speeds.empty()) speeds.push_back(mission.wind.mean_speed);
  for (const auto& budget : mission.budgets) {
    if (budget.wind_speed) speeds.push_back(*budget.wind_speed);
  }
  std::vector<double> once;
  for (const double speed : speeds) {
    if (!(speed >= 0.1) || !(speed <= 60.0)) {
      throw InvalidInput(
          fmt::format("tune: expected wind speeds of 0.1 to 60 m/s, found {:g} m/s", speed));
    }
    if (std::ranges::find(once, speed) == once.end()) once.push_back(speed);
  }
  return once;
}

std::vector<TuningUnit> units_of(const Mission& mission, std::vector<NamedStructure> named,
                                 const std::vector<double>& wind_speeds) {
  const std::size_t asked = named.size();
  const auto structures_of = [](const std::vector<NamedStructure>& some) {
    std::vector<control::LoopStructure> structures;
    for (const auto& one : some) structures.push_back(one.structure);
    return structures;
  };
  for (const auto& part :
       missing_parts(structures_of(named), structures_of(mission.usual_structures))) {
    named.push_back(*std::ranges::find(mission.usual_structures, part, &NamedStructure::structure));
  }
  const auto parts = parts_of(structures_of(named));
  std::vector<TuningUnit> units;
  for (const double speed : wind_speeds) {
    for (const auto& [name, controller] : mission.present_controllers) {
      units.push_back({name, controller.structure, speed, controller});
    }
    const std::size_t first = units.size();
    for (std::size_t s = 0; s < named.size(); ++s) {
      TuningUnit unit{named[s].name, named[s].structure, speed};
      unit.asked = s < asked;
      for (const std::size_t part : parts[s]) unit.parts.push_back(first + part);
      units.push_back(std::move(unit));
    }
  }
  return units;
}

// Whether a tuned controller is good for everything but for its verification.
bool only_unverified(const std::vector<TunedController>& controllers) {
  const auto tuned = [](const TunedController& row) { return row.tuned_for != TunedFor::present; };
  return std::ranges::any_of(controllers,
                             [&](const auto& row) { return tuned(row) && row.constraints_met; }) &&
         std::ranges::none_of(controllers,
                              [&](const auto& row) { return tuned(row) && row.usable(); });
}

}  // namespace

std::string_view to_string(TunedFor purpose) {
  static constexpr std::array names{"present", "nominal", "robust"};
  return names.at(static_cast<std::size_t>(purpose));
}

NonlinearEffect TunedController::effect() const {
  if (!in_time) return {};
  return NonlinearEffect::of_simulation(in_time->rms(), boresight_rms, in_time->limit_cycles);
}

double TunedController::budget_rms() const {
  return std::hypot(wind_rms(), limit_cycle_rms(effect().amplitude));
}

bool TunedController::keeps(double rms) const {
  if (in_time && (!in_time->limit_cycle_runs_complete || !std::isfinite(in_time->rms())))
    return false;
  return within_budget(budget_rms(), rms);
}

Assessment assessment_of(const TuningStudy& section, const TunedController& row,
                         bool with_simulation) {
  const bool robust = row.tuned_for == TunedFor::robust;
  Assessment result;
  result.structure = row.structure;
  result.purpose = robust ? DesignPurpose::robust : DesignPurpose::nominal;
  result.parts = row.design.tuning.controller.structure.parts();
  result.stable = row.stable();
  result.verified = row.design.verification.passed;
  result.nominal_constraints_met = row.constraints_met;
  result.member_constraints_met = robust && row.constraints_met;
  result.linear_rms = row.boresight_rms;
  if (with_simulation && row.in_time) {
    const ControllerInTime& run = *row.in_time;
    result.simulated_rms = run.rms();
    result.expected = run.expected;
    result.limit_cycle_amplitude = run.limit_cycles;
    result.limit_cycles = limit_cycle_verdict(run.limit_cycle_free, run.limit_cycle_runs_complete);
  }
  for (const auto& budget : section.budgets) {
    if (budget.wind_speed == row.wind_speed) count_budget(budget.rms, result);
  }
  if (section.boresight_rms_goal && row.wind_speed == section.wind_speeds.front()) {
    count_budget(*section.boresight_rms_goal, result);
  }
  return result;
}

namespace {

// The tuned controllers of one wind speed, and the choice among them.
struct Choice {
  std::vector<const TunedController*> rows;
  Recommendation recommendation;

  const TunedController* winner() const {
    return recommendation.winner ? rows[*recommendation.winner] : nullptr;
  }
};

Choice choose_at(const TuningStudy& section, double wind_speed, bool with_simulation,
                 const RecommendOptions& options, bool loops_alone = false) {
  Choice choice;
  std::vector<Assessment> candidates;
  for (const auto& row : section.controllers) {
    if (row.tuned_for == TunedFor::present || row.wind_speed != wind_speed) continue;
    if (loops_alone && row.is_state_space()) continue;
    choice.rows.push_back(&row);
    candidates.push_back(assessment_of(section, row, with_simulation));
  }
  choice.recommendation = recommend(candidates, options);
  return choice;
}

}  // namespace

const TunedController* recommended_at(const TuningStudy& section, double wind_speed,
                                      bool with_simulation, const RecommendOptions& options) {
  return choose_at(section, wind_speed, with_simulation, options).winner();
}

const TunedController* recommended_loops(const TuningStudy& section, double wind_speed) {
  constexpr bool with_simulation = true, loops_alone = true;
  return choose_at(section, wind_speed, with_simulation, {.accepted = Fitness::unstable},
                   loops_alone)
      .winner();
}

std::vector<const TunedController*> tied_with(const TuningStudy& section,
                                              const TunedController& recommended) {
  const Choice choice = choose_at(section, recommended.wind_speed, true, {});
  std::vector<const TunedController*> tied;
  for (const auto& rejected : choice.recommendation.rejected) {
    if (rejected.tied) tied.push_back(choice.rows[rejected.index]);
  }
  return tied;
}

std::optional<numerics::Interval> figure_change(const TunedController& from,
                                                const TunedController& to) {
  if (!from.in_time || !to.in_time) return std::nullopt;
  const ControllerInTime &one = *from.in_time, &other = *to.in_time;
  if (!one.expected || !other.expected) return std::nullopt;
  return relative_change({*one.expected, one.limit_cycles}, {*other.expected, other.limit_cycles});
}

const TunedController* best_controller(const TuningStudy& section,
                                       std::optional<double> wind_speed) {
  // Round-off of the search does not outweigh robustness.
  RecommendOptions options{.tie = 1e-3};
  const auto best_at = [&](double speed) { return recommended_at(section, speed, false, options); };
  if (wind_speed) return best_at(*wind_speed);
  for (const auto accepted : {Fitness::misses_budget, Fitness::misses_member}) {
    options.accepted = accepted;
    for (const double speed : section.wind_speeds) {
      if (const TunedController* best = best_at(speed)) return best;
    }
  }
  return nullptr;
}

const TunedController* nearest_to_budget(const TuningStudy& section,
                                         std::optional<double> wind_speed) {
  const TunedController* linear = best_controller(section, wind_speed);
  if (linear == nullptr) return nullptr;
  const auto minimum = [&](bool left_out) {
    const TunedController* nearest = nullptr;
    for (const auto& row : section.controllers) {
      if (row.tuned_for != linear->tuned_for || row.wind_speed != linear->wind_speed) continue;
      if (!row.usable() || row.left_out() != left_out) continue;
      if (row.in_time && !std::isfinite(row.in_time->rms())) continue;
      if (nearest == nullptr || row.budget_rms() < nearest->budget_rms()) nearest = &row;
    }
    return nearest;
  };
  const TunedController* nearest = minimum(false);
  if (nearest == nullptr) nearest = minimum(true);
  return nearest != nullptr ? nearest : linear;
}

const TunedController* recommended_tuned_controller(const TuningStudy& section,
                                                    std::optional<double> wind_speed) {
  if (!wind_speed) {
    const TunedController* best = best_controller(section);
    if (best == nullptr) return nullptr;
    wind_speed = best->wind_speed;
  }
  return recommended_at(section, *wind_speed, true, {});
}

TuningStudy tune_structures(const Mission& mission, const PlantEnsemble& ensemble,
                            const TuneOptions& options) {
  const auto& structures = options.structures.empty() ? mission.structures : options.structures;
  TuningStudy section;
  for (const auto& structure : structures.loops) section.structures.push_back(structure.name);
  if (structures.state_space) section.structures.emplace_back(state_space_name);
  section.wind_speeds = speeds_of(mission, options);
  section.goals = constraints(mission);
  validate(section.goals);
  section.objective = mission.objective;
  section.boresight_rms_goal = mission.rms_goal;
  section.minimises_climate = mission.minimises_climate;
  section.bands = mission.bands;
  section.budgets = mission.budgets;
  section.ensemble_source = ensemble.source;
  section.ensemble_size = ensemble.members.size();
  section.starts = options.starts;
  if (section.starts == 0) section.starts = mission.starts;
  if (section.starts == 0) section.starts = TuningOptions{}.starts;

  const Study study(mission, ensemble, options, section);
  section.problem = tracking_problem(mission);
  section.torque_limited_wind_speed = torque_limited_wind_speed(mission);
  section.wind_model = section.problem.wind.model;
  section.climate = mission.climate_parts;
  auto units = units_of(mission, structures.loops, section.wind_speeds);
  std::vector<std::vector<std::size_t>> parts;
  for (const auto& unit : units) parts.push_back(unit.parts);
  numerics::StepCounter counter(steps_of_search(parts), options.progress);
  const auto search = [&](std::size_t i) {
    study.search(units[i]);
    counter.step();
  };
  const auto improve = [&](std::size_t i) {
    study.improve(units[i], units);
    counter.step();
  };
  search_then_improve(parts, options.threads, search, improve);
  std::erase_if(units, [](const auto& unit) { return !unit.asked; });
  numerics::for_each_index(units.size(), options.threads,
                           [&](std::size_t i) { study.finish(units[i]); });
  for (auto& unit : units) {
    std::ranges::move(unit.controllers, std::back_inserter(section.controllers));
    std::ranges::move(unit.not_run, std::back_inserter(section.not_run));
  }
  section.unverified = only_unverified(section.controllers);
  return section;
}

}  // namespace boresight::design
