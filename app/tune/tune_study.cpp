#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include <fmt/format.h>

#include <boresight/app/tune/asked_structures.hpp>
#include <boresight/app/tune/engineer_units.hpp>
#include <boresight/app/tune/position_gain_trade.hpp>
#include <boresight/app/tune/tune_study.hpp>
#include <boresight/app/tune/tuned_assessment.hpp>
#include <boresight/design/tuning/structure_parts.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/mission_of.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/parallel_loop.hpp>
#include <boresight/plant/antenna/point_response.hpp>

namespace boresight::app {
namespace {

using design::TuningStatus;

// Of every structure and wind speed: no tuning, or a nominal and a robust one.
struct TuningUnit {
  std::string name;
  control::LoopStructure structure;
  double wind_speed = 0.0;
  std::optional<control::ControlLaw> present = std::nullopt;
  bool asked = true;                    // else only to start others from
  std::vector<std::size_t> parts = {};  // units whose structures this one extends
  std::vector<TunedLaw> laws = {};
  std::vector<std::string> not_run = {};
};

class Study {
 public:
  Study(const io::Case& antenna, const PlantEnsemble& ensemble, const TuneOptions& options,
        const TuneSection& section)
      : antenna_(antenna),
        ensemble_(ensemble),
        options_(options),
        section_(section),
        problem_(make_problem(antenna)),
        climate_(make_climate(antenna)) {
    if (section.minimises_climate && climate_.empty()) {
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
    TunedLaw row = new_row(unit, TunedFor::present);
    row.design = design::assess(problem_at(unit.wind_speed), *unit.present, section_.goals);
    unit.laws.push_back(std::move(row));
  }

  // Starts each law of a unit from those of its parts, so that none is worse than what it extends.
  void improve(TuningUnit& unit, const std::vector<TuningUnit>& units) const {
    bool other_nominal = false;
    for (auto& row : unit.laws) {
      if (stopped()) return;
      const design::DesignTask task = task_of(unit, row.tuned_for);
      std::vector<std::vector<double>> starts;
      if (other_nominal) starts.push_back(unit.laws.front().design.tuning.law.gains);
      for (const std::size_t part : unit.parts) {
        for (const auto& law : units[part].laws) {
          if (law.tuned_for != row.tuned_for || !law.stable()) continue;
          std::ranges::move(
              design::starts_from_part(law.design.tuning.law, unit.structure, options_.seed),
              std::back_inserter(starts));
        }
      }
      other_nominal = design::improve_from(task, starts, row.design);
    }
  }

  // What the laws mean at the sky and on the ensemble.
  void finish(TuningUnit& unit) const {
    for (auto& row : unit.laws) {
      finish(row);
      const bool every_member = !row.ensemble || row.ensemble->within_goals ==
                                                     static_cast<int>(row.ensemble->members.size());
      row.goals_met = row.stable() && row.design.tuning.status == TuningStatus::optimal &&
                      (row.tuned_for != TunedFor::robust || every_member);
    }
  }

 private:
  design::TrackingProblem problem_at(double wind_speed) const {
    design::TrackingProblem problem = problem_;
    problem.wind.mean_speed = wind_speed;
    if (section_.minimises_climate) problem.climate = climate_;
    return problem;
  }

  static TunedLaw new_row(const TuningUnit& unit, TunedFor purpose) {
    TunedLaw row;
    row.structure = unit.name;
    row.tuned_for = purpose;
    row.wind_speed = unit.wind_speed;
    return row;
  }

  bool stopped() const { return options_.interrupted && options_.interrupted(); }

  design::DesignTask task_of(const TuningUnit& unit, TunedFor purpose) const {
    design::DesignTask task;
    task.name = unit.name;
    task.problem = problem_at(unit.wind_speed);
    task.structure = unit.structure;
    task.goals = section_.goals;
    task.options.seed = options_.seed;
    task.options.starts =
        unit.asked ? section_.starts : std::min(section_.starts, design::starts_of_a_part);
    task.options.stop = options_.interrupted;
    for (const auto& law : present_laws(antenna_)) {
      if (law.structure == unit.structure) task.options.warm_starts.push_back(law.gains);
    }
    if (purpose == TunedFor::robust) {
      task.options.members = ensemble_.members;
      task.options.soft_goal = section_.soft_goal;
    }
    return task;
  }

  void search(TuningUnit& unit, TunedFor purpose) const {
    if (stopped()) {
      unit.not_run.push_back(
          fmt::format("{}, {}, {:g} m/s", unit.name, to_string(purpose), unit.wind_speed));
      return;
    }
    design::DesignTask task = task_of(unit, purpose);
    if (!unit.laws.empty() && unit.laws.front().stable()) {
      task.options.warm_starts.push_back(unit.laws.front().design.tuning.law.gains);
    }
    TunedLaw row = new_row(unit, purpose);
    row.design = design::solve(task);
    unit.laws.push_back(std::move(row));
  }

  void finish(TunedLaw& row) const {
    const control::ControlLaw& law = row.design.tuning.law;
    row.gains = in_engineers_units(antenna_, law);
    if (!row.stable()) {
      row.gains.clear();
      row.beam_rms = std::numeric_limits<double>::quiet_NaN();
      row.speed_limits.assign(section_.budgets.size(), row.beam_rms);
      return;
    }
    design::TrackingProblem problem = problem_;
    problem.wind.mean_speed = row.wind_speed;
    control::LoopEvaluator evaluator = design::make_evaluator(problem);
    const auto evaluation = evaluator.evaluate(law, false);
    row.beam_rms = std::sqrt(evaluation.beam_variance()) / problem.gear_ratio;
    for (const auto& budget : section_.budgets) {
      row.speed_limits.push_back(
          design::wind_speed_limit(problem, evaluator, law, evaluation.noise_variance, budget.rms));
    }
    if (!climate_.empty()) {
      problem.climate = climate_;
      row.climate_rms =
          std::sqrt(design::make_evaluator(problem).evaluate(law, false).beam_variance()) /
          problem.gear_ratio;
    }
    if (!ensemble_.members.empty()) {
      row.ensemble =
          design::judge(problem_at(row.wind_speed), ensemble_.members, law, section_.goals, 1);
    }
    row.trade = position_gain_trade(antenna_, problem, row.design.tuning, row.beam_rms,
                                    section_.goals, ensemble_.members);
  }

  const io::Case& antenna_;
  const PlantEnsemble& ensemble_;
  const TuneOptions& options_;
  const TuneSection& section_;
  design::TrackingProblem problem_;
  std::vector<design::WeightedWind> climate_;
};

// The speeds asked for, or the design's, and those of budgets that must be met.
std::vector<double> speeds_of(const io::Case& antenna, const TuneOptions& options) {
  std::vector<double> speeds = options.wind_speeds;
  if (speeds.empty()) speeds.push_back(antenna.wind.design_speed.value);
  for (const auto& budget : antenna.budgets) {
    if (budget.wind_speed) speeds.push_back(budget.wind_speed->value);
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

// As --structure takes it: a usual structure's short name, else the own one's.
std::string short_name(const control::LoopStructure& structure) {
  for (const auto* base : {"PI-0", "PI", "DPF", "LL", "FULL"}) {
    for (const auto* added : {"", "+N", "+C", "+N+C"}) {
      const std::string name = std::string(base) + added;
      if (control::LoopStructure::named(name) == structure) return name;
    }
  }
  return structure.name();
}

std::vector<TuningUnit> units_of(const io::Case& antenna, const TuneSection& section) {
  std::vector<control::LoopStructure> structures;
  for (const auto& name : section.structures) {
    structures.push_back(io::loop_structure(antenna, name));
  }
  const auto missing = design::missing_parts(structures, io::usual_structures_with_lag(antenna));
  structures.insert(structures.end(), missing.begin(), missing.end());
  const auto parts = design::parts_of(structures);
  std::vector<TuningUnit> units;
  for (const double speed : section.wind_speeds) {
    for (const auto& law : present_laws(antenna)) {
      units.push_back({short_name(law.structure), law.structure, speed, law});
    }
    const std::size_t first = units.size();
    for (std::size_t s = 0; s < structures.size(); ++s) {
      const bool asked = s < section.structures.size();
      TuningUnit unit{asked ? section.structures[s] : short_name(structures[s]), structures[s],
                      speed};
      unit.asked = asked;
      for (const std::size_t part : parts[s]) unit.parts.push_back(first + part);
      units.push_back(std::move(unit));
    }
  }
  return units;
}

// Whether a tuned law is good for everything but for its verification.
bool only_unverified(const std::vector<TunedLaw>& laws) {
  const auto tuned = [](const TunedLaw& row) { return row.tuned_for != TunedFor::present; };
  return std::ranges::any_of(laws, [&](const auto& row) { return tuned(row) && row.goals_met; }) &&
         std::ranges::none_of(laws, [&](const auto& row) { return tuned(row) && row.usable(); });
}

}  // namespace

std::string_view to_string(TunedFor purpose) {
  static constexpr std::array names{"present", "nominal", "robust"};
  return names.at(static_cast<std::size_t>(purpose));
}

const TunedLaw* best_law(const TuneSection& section, std::optional<double> wind_speed) {
  // Round-off of the search does not outweigh robustness.
  design::RecommendOptions options{.tie = 1e-3};
  const auto best_at = [&](double speed) { return recommended_at(section, speed, false, options); };
  if (wind_speed) return best_at(*wind_speed);
  for (const auto accepted : {design::Fitness::misses_budget, design::Fitness::misses_member}) {
    options.accepted = accepted;
    for (const double speed : section.wind_speeds) {
      if (const TunedLaw* best = best_at(speed)) return best;
    }
  }
  return nullptr;
}

const TunedLaw* nearest_to_budget(const TuneSection& section, std::optional<double> wind_speed) {
  const TunedLaw* linear = best_law(section, wind_speed);
  if (linear == nullptr) return nullptr;
  const auto least = [&](bool left_out) {
    const TunedLaw* nearest = nullptr;
    for (const auto& row : section.laws) {
      if (row.tuned_for != linear->tuned_for || row.wind_speed != linear->wind_speed) continue;
      if (!row.usable() || row.left_out() != left_out) continue;
      if (row.in_time && !std::isfinite(row.in_time->beam_rms)) continue;
      if (nearest == nullptr || row.budget_rms() < nearest->budget_rms()) nearest = &row;
    }
    return nearest;
  };
  const TunedLaw* nearest = least(false);
  if (nearest == nullptr) nearest = least(true);
  return nearest != nullptr ? nearest : linear;
}

TuneSection tune_structures(const io::Case& antenna, const PlantEnsemble& ensemble,
                            const TuneOptions& options) {
  TuneSection section;
  section.structures = asked_structures(antenna, options.structures);
  section.wind_speeds = speeds_of(antenna, options);
  section.goals = make_goals(antenna);
  design::validate(section.goals);
  section.soft_goal = make_soft_goal(antenna);
  if (antenna.goals.beam_rms) section.beam_rms_goal = antenna.goals.beam_rms->value;
  section.minimises_climate = antenna.goals.over_climate;
  section.bands = make_bands(antenna);
  section.budgets = make_budgets(antenna);
  section.ensemble_source = ensemble.source;
  section.ensemble_size = ensemble.members.size();
  section.starts = options.starts;
  if (section.starts == 0) section.starts = static_cast<int>(antenna.tuning.starts);
  if (section.starts == 0) section.starts = design::TuningOptions{}.starts;

  const Study study(antenna, ensemble, options, section);
  section.problem = make_problem(antenna);
  section.supply_wind_speed = supply_wind_speed(antenna, section.problem);
  section.wind_model = section.problem.wind.model;
  section.wind_mast = antenna.wind.mast;
  section.climate = antenna.wind.climate_parts;
  section.demand_assumption = io::demand_assumption(antenna);
  auto units = units_of(antenna, section);
  std::vector<std::vector<std::size_t>> parts;
  for (const auto& unit : units) parts.push_back(unit.parts);
  numerics::StepCounter counter(design::steps_of_search(parts), options.progress);
  const auto search = [&](std::size_t i) {
    study.search(units[i]);
    counter.step();
  };
  const auto improve = [&](std::size_t i) {
    study.improve(units[i], units);
    counter.step();
  };
  design::search_then_improve(parts, options.threads, search, improve);
  std::erase_if(units, [](const auto& unit) { return !unit.asked; });
  numerics::for_each_index(units.size(), options.threads,
                           [&](std::size_t i) { study.finish(units[i]); });
  for (auto& unit : units) {
    std::ranges::move(unit.laws, std::back_inserter(section.laws));
    std::ranges::move(unit.not_run, std::back_inserter(section.not_run));
  }
  section.unverified = only_unverified(section.laws);
  section.shortfalls = find_shortfalls(section);
  return section;
}

}  // namespace boresight::app
