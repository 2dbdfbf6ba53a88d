#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <boresight/design/ensembles/budgets_on_plants.hpp>
#include <boresight/design/problem/budget_speeds.hpp>
#include <boresight/design/problem/pointing.hpp>
#include <boresight/design/studies/redesign_study.hpp>
#include <boresight/design/studies/retuned_present.hpp>
#include <boresight/design/verification/linear_prediction.hpp>
#include <boresight/numerics/parallel_loop.hpp>
#include <boresight/plant/antenna/plant_response.hpp>
#include <boresight/plant/nonlinear/drive_capability.hpp>

namespace boresight::design {
namespace {

using control::LoopStructure;
constexpr int seed_count = 8;

DesignTask make_task(const Mission& mission, std::uint64_t seed, std::string name,
                     const plant::Antenna& variant, LoopStructure structure) {
  DesignTask task;
  task.name = std::move(name);
  task.problem = tracking_problem(mission, variant);
  task.structure = std::move(structure);
  task.goals = constraints(mission);
  task.options.seed = seed;
  return task;
}

// Where none is stable, the first.
const TunedController& recommended_or_first(const ControllerStudy& study) {
  if (const TunedController* controller = recommended_or(study, Fitness::unstable))
    return *controller;
  return *std::ranges::find_if(study.tuned.controllers, [](const TunedController& row) {
    return row.tuned_for != TunedFor::present;
  });
}

// The search of the recommended controller, from other seeds and without its warm starts; none of a
// state space, which no random starts made.
std::vector<DesignTask> seed_tasks(const Mission& mission, const PlantEnsemble& ensemble,
                                   const TunedController& row, std::uint64_t seed) {
  std::vector<DesignTask> tasks;
  if (row.is_state_space()) return tasks;
  for (int i = 0; i < seed_count; ++i) {
    tasks.push_back(make_task(mission, seed, "as built", mission.antenna,
                              row.design.tuning.controller.structure));
    DesignTask& task = tasks.back();
    task.problem.wind.mean_speed = row.wind_speed;
    if (mission.minimises_climate) task.problem.climate = mission.climate;
    task.options.seed = seed + static_cast<std::uint64_t>(i);
    if (row.tuned_for == TunedFor::robust) {
      task.options.members = ensemble.members;
      task.options.objective = mission.objective;
    }
  }
  return tasks;
}

// The tuned controller at the sky: other winds, static error, bands and budgets.
void evaluate_in_wind(const Mission& mission, RecommendedDesign& section) {
  const TrackingProblem& problem = section.problem;
  control::LoopEvaluator evaluator = make_evaluator(problem);
  const control::Controller& controller = section.design.tuning.controller;
  const double noise = section.design.tuning.evaluation.noise_variance;
  const Eigen::ArrayXd transmission = evaluator.wind_transmission(controller);
  for (const auto model :
       {plant::WindModel::uniform, plant::WindModel::vickery, plant::WindModel::coherence}) {
    TrackingProblem alternative = problem;
    alternative.wind.model = model;
    section.wind_alternatives.push_back(
        {model, boresight_rms_at_speed(alternative, evaluator, transmission, noise,
                                       problem.wind.mean_speed)});
    section.wind_alternatives.back().speed_limits =
        budget_speeds(alternative, evaluator, controller, noise, mission.budgets, section.effect);
  }
  const auto structure =
      plant::structure_response(problem.plant.structure, evaluator.response().frequency);
  section.flexure_rms = boresight_rms_at_speed(
      problem, evaluator, structure.boresight_per_wind.abs2(), 0.0, problem.wind.mean_speed);
  Mission in_this_wind = mission;
  in_this_wind.wind = problem.wind;
  section.torque_limited_wind_speed = torque_limited_wind_speed(in_this_wind);
  section.static_error = static_boresight_error(problem, controller);
  section.static_encoder_error = static_encoder_error(problem, controller);
  for (const auto& band : mission.bands) {
    section.losses.push_back({band,
                              pointing_loss_db(section.design.boresight_rms, band.beamwidth,
                                               LossConvention::mean_loss_two_axes),
                              pointing_loss_db(section.static_error, band.beamwidth,
                                               LossConvention::mean_loss_one_axis)});
  }
  const auto speeds =
      budget_speeds(problem, evaluator, controller, noise, mission.budgets, section.effect);
  for (std::size_t i = 0; i < speeds.size(); ++i) {
    section.budgets.push_back({mission.budgets[i], speeds[i]});
  }
}

// The figures of a design that was tuned over the climate, at one wind speed as everywhere here.
void at_one_speed(const RecommendedDesign& section, Design& design) {
  auto evaluated = assess(section.problem, design.tuning.controller, section.goals);
  evaluated.tuning = std::move(design.tuning);
  design = std::move(evaluated);
}

RecommendedDesign recommended_design(const Mission& mission, const TunedController& row,
                                     const NonlinearEffect& effect, std::uint64_t seed,
                                     const std::vector<Design>& repeated) {
  RecommendedDesign section;
  section.effect = effect;
  section.structure = row.design.tuning.controller.structure;
  section.name = row.structure;
  section.tuned_for = row.tuned_for;
  section.design = row.design;
  section.goals = constraints(mission);
  for (std::size_t i = 0; i < repeated.size(); ++i) {
    section.seeds.push_back({seed + i, repeated[i].boresight_rms, repeated[i].verification.passed});
    if (repeated[i].verification.passed &&
        repeated[i].boresight_rms < 1.01 * row.design.boresight_rms) {
      ++section.seeds_within_1_percent;
    }
  }

  section.problem = tracking_problem(mission);
  section.problem.wind.mean_speed = row.wind_speed;
  section.design_speed = section.problem.wind.mean_speed;
  section.wind_model = section.problem.wind.model;
  section.wind_site = section.problem.wind.site;
  section.climate = mission.climate_parts;
  for (const auto& [name, controller] : mission.present_controllers) {
    section.present.push_back(
        {controller.structure.name(), assess(section.problem, controller, section.goals)});
  }
  if (row.stable()) {
    if (mission.minimises_climate) at_one_speed(section, section.design);
    evaluate_in_wind(mission, section);
    section.trade = row.trade;
  }
  return section;
}

// Every series of the flywheel comparison is one task a row.
struct FlywheelPlan {
  FlywheelComparison comparison;
  std::vector<DesignTask> tasks;
};

FlywheelPlan plan_flywheels(const Mission& mission, const RedesignTask& task,
                            const TunedController& loops) {
  // Their gains are one more start of each search.
  constexpr int starts = 6;
  const control::Controller& tuned = loops.design.tuning.controller;
  FlywheelPlan plan;
  const plant::Antenna& antenna = mission.antenna;
  for (const auto& [count, label] : task.disks) {
    FlywheelRow row;
    row.disks = count;
    row.label = label;
    row.as_built = count == antenna.flywheels.disks && !label.starts_with("ratio");
    const auto other = changed(antenna, {plant::set_to("motor.flywheel_disks", count)});
    row.motor_inertia = motor_inertia(other);
    row.reflected_inertia = plant::reflected_inertia(linear_plant(other));
    row.motor_to_load_ratio = plant::motor_to_load_ratio(row.motor_inertia, row.reflected_inertia);
    plan.comparison.rows.push_back(std::move(row));
  }
  const double linear = antenna.drive.viscous_friction;
  const double tracking = plant::tracking_friction(antenna);
  std::vector<std::pair<double, std::string>> frictions{{linear, "linear plant"},
                                                        {tracking, "slope at tracking rate"}};
  // Twice the same study would tell nothing.
  if (std::abs(tracking - linear) <= 1e-9 * std::max(tracking, linear)) {
    frictions = {{linear, ""}};
  }
  for (const auto& [friction, name] : frictions) {
    plan.comparison.series.push_back({name, friction, tuned.structure, {}});
    for (const auto& row : plan.comparison.rows) {
      plan.tasks.push_back(
          make_task(mission, task.seed, row.label,
                    changed(antenna, {plant::set_to("motor.flywheel_disks", row.disks),
                                      plant::set_to("drive.viscous_friction", friction)}),
                    tuned.structure));
      plan.tasks.back().options.starts = starts;
      if (loops.stable()) plan.tasks.back().options.warm_starts = {tuned.gains};
    }
  }
  return plan;
}

// With the mission's own gains or, where it states none, with what stands for them.
void compare_with_present(const Mission& mission, const TuningStudy& tuned,
                          const TunedController& best, RedesignStudy& result) {
  RecommendedDesign& section = result.recommended;
  if (!mission.present_controllers.empty()) {
    if (result.time_domain && result.time_domain->present) {
      section.present.front().simulated_rms = result.time_domain->present->simulated_rms;
    }
    return;
  }
  const TunedController* row = retuned_present(tuned, mission.present_structure, best.wind_speed);
  if (row == nullptr) return;
  if (row == &best) {
    section.is_retuned_present = true;
    return;
  }
  const control::Controller& controller = row->design.tuning.controller;
  RecommendedDesign::PresentController present{
      row->structure, assess(section.problem, controller, section.goals), true};
  if (row->in_time && row->in_time->expected) {
    present.simulated_rms = row->in_time->expected->rms.value;
  }
  if (result.time_domain) {
    add_present(mission, section.problem, {row->structure, controller}, true, *result.time_domain);
  }
  section.present.push_back(std::move(present));
}

FlywheelComparison finish_flywheels(FlywheelPlan plan, std::vector<Design>::iterator design,
                                    unsigned threads) {
  const std::size_t rows = plan.comparison.rows.size();
  for (auto& series : plan.comparison.series) {
    series.designs.assign(std::make_move_iterator(design),
                          std::make_move_iterator(design + static_cast<std::ptrdiff_t>(rows)));
    design += static_cast<std::ptrdiff_t>(rows);
  }
  numerics::for_each_index(plan.comparison.series.size(), threads, [&](std::size_t s) {
    const auto first = plan.tasks.begin() + static_cast<std::ptrdiff_t>(s * rows);
    improve_along({first, first + static_cast<std::ptrdiff_t>(rows)},
                  plan.comparison.series[s].designs);
  });
  return std::move(plan.comparison);
}

// Wind speeds (m/s) up to which a controller keeps the budgets on its own plant.
std::optional<std::vector<double>> speed_limits(const Mission& mission,
                                                const TrackingProblem& problem,
                                                const Design& design,
                                                const NonlinearEffect& effect) {
  if (design.tuning.status == TuningStatus::unstable) return std::nullopt;
  return budget_speeds(problem, make_evaluator(problem), design.tuning.controller,
                       design.tuning.evaluation.noise_variance, mission.budgets, effect);
}

// Of the recommended controller; none where it misses its constraints.
std::optional<TimeDomainStudy> time_domain_of(const Mission& mission, ControllerStudy& study,
                                              const TunedController& best,
                                              const RedesignTask& task) {
  if (study.time_domain && study.time_domain->controller == description_of(best)) {
    return std::move(study.time_domain);
  }
  if (!best.constraints_met) return std::nullopt;
  auto problem = tracking_problem(mission);
  problem.wind.mean_speed = best.wind_speed;
  return verify_in_time_domain(mission, problem, best.design.tuning.controller,
                               description_of(best), task.seed, task.threads, FurtherRuns::all);
}

}  // namespace

RedesignStudy redesign(const Mission& mission, const PlantEnsemble& ensemble,
                       const RedesignTask& task) {
  TuneOptions how;
  how.seed = task.seed;
  how.threads = task.threads;
  how.progress = task.progress;
  ControllerStudy study = study_controllers(mission, ensemble, how, ChoiceDetail::verified);
  const TunedController& best = recommended_or_first(study);
  // What the antenna's variants are tuned with: instead of a state space the best loops at its wind
  // speed, of which there are some, as it started from them.
  const TunedController& loops =
      best.is_state_space() ? *recommended_loops(study.tuned, best.wind_speed) : best;
  const auto seeds = seed_tasks(mission, ensemble, best, task.seed);
  std::vector<DesignTask> alternatives;
  for (const auto& [name, antenna] : task.alternatives) {
    alternatives.push_back(
        make_task(mission, task.seed, name, antenna, loops.design.tuning.controller.structure));
  }
  FlywheelPlan flywheels = plan_flywheels(mission, task, loops);

  std::vector<DesignTask> tasks = seeds;
  tasks.insert(tasks.end(), alternatives.begin(), alternatives.end());
  tasks.insert(tasks.end(), flywheels.tasks.begin(), flywheels.tasks.end());
  auto designs = solve_all(tasks, task.threads, task.progress);

  const auto first_alternative = designs.begin() + static_cast<std::ptrdiff_t>(seeds.size());
  const auto first_row = first_alternative + static_cast<std::ptrdiff_t>(alternatives.size());
  RedesignStudy result;
  result.time_domain = time_domain_of(mission, study, best, task);
  const NonlinearEffect effect =
      result.time_domain ? result.time_domain->own().effect().for_budgets() : NonlinearEffect{};
  result.recommended =
      recommended_design(mission, best, effect, task.seed, {designs.begin(), first_alternative});
  if (best.is_state_space()) {
    auto& beside = result.recommended.loops.emplace(loops.structure, loops.design);
    if (mission.minimises_climate && loops.stable()) {
      at_one_speed(result.recommended, beside.design);
    }
    if (loops.in_time) beside.simulated_rms = loops.in_time->rms();
  }
  for (const auto* row : tied_with(study.tuned, best)) {
    result.recommended.ties.push_back(description_of(*row));
  }
  result.recommended.fitness = fitness(assessment_of(study.tuned, best));
  compare_with_present(mission, study.tuned, best, result);
  std::vector<Design> other(first_alternative, first_row);
  improve_along(alternatives, other);
  for (std::size_t i = 0; i < other.size(); ++i) {
    auto limits = speed_limits(mission, alternatives[i].problem, other[i],
                               &loops == &best ? effect : loops.effect().for_budgets());
    result.alternatives.push_back({std::move(other[i]), std::move(limits)});
  }
  result.flywheels = finish_flywheels(std::move(flywheels), first_row, task.threads);
  return result;
}

void evaluate_on(const std::vector<EnsembleMember>& members, unsigned threads,
                 RecommendedDesign& design) {
  if (design.design.tuning.status == TuningStatus::unstable || members.empty()) return;
  const auto& controller = design.design.tuning.controller;
  design.ensemble = evaluate(design.problem, members, controller, design.goals, threads);
  std::vector<PointingBudget> budgets;
  std::vector<double> limits;
  for (const auto& result : design.budgets) {
    budgets.push_back(result.budget);
    limits.push_back(result.wind_speed_limit);
  }
  design.curves = ensemble_curves(design.problem, members, controller, *design.ensemble,
                                  highest_compared_speed(design.design_speed, limits), threads);
  const auto met = plants_within_budgets(design.problem, members, controller, design.goals, budgets,
                                         design.effect, threads);
  for (std::size_t i = 0; i < met.size(); ++i) design.budgets[i].plants_met = met[i];
}

void add_probabilities(const Mission& mission, const PlantDistribution& distribution,
                       const MonteCarloOptions& options, RecommendedDesign& design) {
  if (design.design.tuning.status == TuningStatus::unstable) return;
  std::vector<PointingBudget> budgets;
  for (const auto& result : design.budgets) budgets.push_back(result.budget);
  const auto found = sampled_probabilities(mission, distribution, design.design.tuning.controller,
                                           budgets, design.effect, options);
  design.constraints_met = found.constraints_met;
  for (std::size_t i = 0; i < budgets.size(); ++i)
    design.budgets[i].probability = found.budgets_met[i];
}

}  // namespace boresight::design
