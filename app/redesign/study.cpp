#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include <boresight/app/redesign/choices.hpp>
#include <boresight/app/redesign/sections.hpp>
#include <boresight/app/uncertainty/designed_antenna.hpp>
#include <boresight/design/problem/pointing.hpp>
#include <boresight/design/problem/static_bending.hpp>
#include <boresight/design/studies/controller_study.hpp>
#include <boresight/io/case/antenna_of.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/mission_of.hpp>
#include <boresight/io/case/plant_numbers.hpp>
#include <boresight/io/case/present_gains.hpp>
#include <boresight/numerics/parallel_loop.hpp>
#include <boresight/plant/antenna/antenna_change.hpp>
#include <boresight/plant/antenna/plant_response.hpp>

namespace boresight::app {
namespace {

using control::LoopStructure;
constexpr int seed_count = 8;

design::DesignTask make_task(const io::Case& antenna, const StudyOptions& options, std::string name,
                             const plant::Antenna& variant, LoopStructure structure) {
  design::DesignTask task;
  task.name = std::move(name);
  task.problem = make_problem(antenna, variant);
  task.structure = std::move(structure);
  task.goals = make_goals(antenna);
  task.options.seed = options.seed;
  return task;
}

double ratio_of(const io::Case& antenna, const design::TrackingProblem& problem, double disks) {
  return plant::motor_to_load_ratio(motor_inertia(antenna, disks),
                                    plant::reflected_inertia(problem.plant));
}

// Where none is stable, the first.
const TunedLaw& recommended_or_first(const design::ControllerStudy& study) {
  if (const TunedLaw* law = recommended_or(study, design::Fitness::unstable)) return *law;
  return *std::ranges::find_if(
      study.tuned.laws, [](const TunedLaw& row) { return row.tuned_for != TunedFor::present; });
}

// The search of the recommended controller, from other seeds and without its warm starts.
std::vector<design::DesignTask> seed_tasks(const DesignedAntenna& designed, const TunedLaw& row,
                                           const StudyOptions& options) {
  const io::Case& antenna = designed.antenna;
  std::vector<design::DesignTask> tasks;
  for (int i = 0; i < seed_count; ++i) {
    tasks.push_back(make_task(antenna, options, "as built", io::antenna_of(antenna),
                              row.design.tuning.law.structure));
    design::DesignTask& task = tasks.back();
    task.problem.wind.mean_speed = row.wind_speed;
    if (antenna.goals.over_climate) task.problem.climate = make_climate(antenna);
    task.options.seed = options.seed + static_cast<std::uint64_t>(i);
    if (row.tuned_for == TunedFor::robust) {
      task.options.members = designed.ensemble.members;
      task.options.soft_goal = make_soft_goal(antenna);
    }
  }
  return tasks;
}

// What the tuned law means at the sky: other winds, bending, bands and budgets.
void judge_in_wind(const io::Case& antenna, const design::TrackingProblem& problem,
                   TuningSection& section) {
  control::LoopEvaluator evaluator = design::make_evaluator(problem);
  const control::ControlLaw& law = section.design.tuning.law;
  const double noise = section.design.tuning.evaluation.noise_variance;
  const Eigen::ArrayXd transmission = evaluator.wind_transmission(law);
  for (const auto model :
       {plant::WindModel::uniform, plant::WindModel::vickery, plant::WindModel::coherence}) {
    design::TrackingProblem alternative = problem;
    alternative.wind.model = model;
    section.wind_alternatives.push_back(
        {model, design::beam_rms_at_speed(alternative, evaluator, transmission, noise,
                                          problem.wind.mean_speed)});
    for (const auto& budget : make_budgets(antenna)) {
      section.wind_alternatives.back().speed_limits.push_back(
          design::wind_speed_limit(alternative, evaluator, law, noise, budget.rms));
    }
  }
  const auto structure =
      plant::structure_response(problem.plant.structure, evaluator.response().frequency);
  section.encoder_held_rms = design::beam_rms_at_speed(
      problem, evaluator, structure.beam_per_wind.abs2(), 0.0, problem.wind.mean_speed);
  section.supply_wind_speed = supply_wind_speed(antenna, problem);
  section.static_bending = static_bending(problem);
  for (const auto& band : make_bands(antenna)) {
    section.losses.push_back(
        {band,
         design::pointing_loss_db(section.design.beam_rms, band.beamwidth,
                                  design::LossConvention::mean_loss_two_axes),
         design::pointing_loss_db(section.static_bending, band.beamwidth,
                                  design::LossConvention::mean_loss_one_axis)});
  }
  for (const auto& budget : make_budgets(antenna)) {
    section.budgets.push_back(
        {budget, design::wind_speed_limit(problem, evaluator, law, noise, budget.rms)});
  }
}

// The figures of a design that was tuned over the climate, at one wind speed as everywhere here.
void at_one_speed(const design::TrackingProblem& problem, TuningSection& section) {
  auto judged = design::assess(problem, section.design.tuning.law, section.goals);
  judged.tuning = std::move(section.design.tuning);
  section.design = std::move(judged);
}

TuningSection tuning_section(const io::Case& antenna, const StudyOptions& options,
                             const TunedLaw& row, const std::vector<design::Design>& repeated) {
  TuningSection section;
  section.structure = row.design.tuning.law.structure;
  section.name = row.structure;
  section.tuned_for = row.tuned_for;
  section.design = row.design;
  section.goals = make_goals(antenna);
  for (std::size_t i = 0; i < repeated.size(); ++i) {
    section.seeds.push_back(
        {options.seed + i, repeated[i].beam_rms, repeated[i].verification.passed});
    if (repeated[i].verification.passed && repeated[i].beam_rms < 1.01 * row.design.beam_rms) {
      ++section.seeds_within_1_percent;
    }
  }

  section.problem = make_problem(antenna);
  section.problem.wind.mean_speed = row.wind_speed;
  const design::TrackingProblem& problem = section.problem;
  section.design_speed = problem.wind.mean_speed;
  section.wind_model = problem.wind.model;
  section.wind_site = problem.wind.site;
  section.wind_attitude = antenna.wind.attitude;
  section.wind_mast = antenna.wind.mast;
  section.climate = antenna.wind.climate_parts;
  section.demand_assumption = io::demand_assumption(antenna);
  for (const auto& [name, law] : present_controllers(antenna)) {
    section.present.push_back({law.structure.name(), design::assess(problem, law, section.goals)});
  }
  if (row.stable()) {
    if (antenna.goals.over_climate) at_one_speed(problem, section);
    judge_in_wind(antenna, problem, section);
    section.trade = row.trade;
    section.gain_units = io::GainUnits(antenna);
    constexpr std::size_t most_effects = 10;
    section.input_effects = input_effects(antenna, section.design.tuning.law, section.goals,
                                          section.design.beam_rms, most_effects, options.threads);
  }
  return section;
}

std::vector<LoopStructure> matched_structures(const io::Case& antenna) {
  std::vector<std::string> names = antenna.tuning.structures;
  if (names.empty()) names = {"PI", "PI-0"};
  std::vector<LoopStructure> structures;
  for (const auto& name : names) structures.push_back(io::loop_structure(antenna, name));
  return structures;
}

// Every series of the matching study is one task a row.
struct MatchingPlan {
  MatchingSection section;
  std::vector<design::DesignTask> tasks;
};

MatchingPlan plan_matching(const io::Case& antenna, const StudyOptions& options) {
  MatchingPlan plan;
  std::vector<double> disks = antenna.matching_disks;
  const double as_built = antenna.motor.flywheel_disks;
  if (std::find(disks.begin(), disks.end(), as_built) == disks.end()) disks.push_back(as_built);
  const double load = gear_train_inertia(antenna) + antenna_inertia(antenna);
  std::vector<std::pair<double, std::string>> points;
  points.reserve(disks.size() + 1 + antenna.antenna.alternatives.size());
  for (const double count : disks) {
    points.emplace_back(count, fmt::format("{:g} {}", count, count == 1.0 ? "disk" : "disks"));
  }
  if (const auto unit = disks_at_unit_ratio(antenna, load)) {
    points.emplace_back(*unit, "ratio 1");
  }
  for (const auto& alternative : antenna.antenna.alternatives) {
    const double other = gear_train_inertia(antenna) + antenna_inertia(antenna, alternative);
    if (const auto unit = disks_at_unit_ratio(antenna, other)) {
      points.emplace_back(*unit, "ratio 1 by " + alternative.name);
    }
  }
  std::stable_sort(points.begin(), points.end(),
                   [](const auto& x, const auto& y) { return x.first < y.first; });
  for (const auto& [count, label] : points) {
    MatchingRow row;
    row.disks = count;
    row.label = label;
    row.as_built = count == as_built && !label.starts_with("ratio");
    row.motor_inertia = motor_inertia(antenna, count);
    const auto problem = make_problem(antenna, {plant::set_to("motor.flywheel_disks", count)});
    row.reflected_inertia = plant::reflected_inertia(problem.plant);
    row.motor_to_load_ratio = ratio_of(antenna, problem, count);
    plan.section.rows.push_back(std::move(row));
  }
  const double linear = antenna.drive.viscous_friction.value;
  const double tracking = io::tracking_friction(antenna);
  std::vector<std::pair<double, std::string>> frictions{{linear, "linear plant"},
                                                        {tracking, "slope at tracking rate"}};
  // Twice the same study would tell nothing.
  if (std::abs(tracking - linear) <= 1e-9 * std::max(tracking, linear)) {
    frictions = {{linear, ""}};
  }
  for (const auto& [friction, name] : frictions) {
    for (const auto& structure : matched_structures(antenna)) {
      plan.section.series.push_back({name, friction, structure, {}});
      for (const auto& row : plan.section.rows) {
        plan.tasks.push_back(make_task(
            antenna, options, row.label,
            changed(io::antenna_of(antenna), {plant::set_to("motor.flywheel_disks", row.disks),
                                              plant::set_to("drive.viscous_friction", friction)}),
            structure));
      }
    }
  }
  return plan;
}

MatchingSection finish_matching(MatchingPlan plan, std::vector<design::Design>::iterator design,
                                unsigned threads) {
  const std::size_t rows = plan.section.rows.size();
  for (auto& series : plan.section.series) {
    series.designs.assign(std::make_move_iterator(design),
                          std::make_move_iterator(design + static_cast<std::ptrdiff_t>(rows)));
    design += static_cast<std::ptrdiff_t>(rows);
  }
  numerics::for_each_index(plan.section.series.size(), threads, [&](std::size_t s) {
    const auto first = plan.tasks.begin() + static_cast<std::ptrdiff_t>(s * rows);
    design::improve_along({first, first + static_cast<std::ptrdiff_t>(rows)},
                          plan.section.series[s].designs);
  });
  return std::move(plan.section);
}

// Wind speeds (m/s) up to which a law keeps the budgets on its own plant.
std::optional<std::vector<double>> speed_limits(const io::Case& antenna,
                                                const design::TrackingProblem& problem,
                                                const design::Design& design) {
  if (design.tuning.status == design::TuningStatus::unstable) return std::nullopt;
  control::LoopEvaluator evaluator = design::make_evaluator(problem);
  std::vector<double> limits;
  for (const auto& budget : make_budgets(antenna)) {
    limits.push_back(design::wind_speed_limit(problem, evaluator, design.tuning.law,
                                              design.tuning.evaluation.noise_variance, budget.rms));
  }
  return limits;
}

std::vector<design::DesignTask> choice_tasks(const io::Case& antenna, const StudyOptions& options,
                                             const std::vector<PlantChoice>& choices,
                                             const LoopStructure& structure) {
  std::vector<design::DesignTask> tasks;
  for (const auto& choice : choices) {
    if (!choice.antenna) continue;
    tasks.push_back(make_task(antenna, options, choice.result.name, *choice.antenna, structure));
  }
  return tasks;
}

}  // namespace

void redesign(const DesignedAntenna& designed, const StudyOptions& options, Report& report) {
  const io::Case& antenna = designed.antenna;
  design::TuneOptions how;
  how.seed = options.seed;
  how.threads = options.threads;
  how.progress = options.progress;
  design::ControllerStudy study =
      study_controllers(designed.mission, designed.ensemble, how, design::ChoiceDetail::verified);
  const TunedLaw& recommended = recommended_or_first(study);
  const auto tuning = seed_tasks(designed, recommended, options);
  std::vector<PlantChoice> choices = plant_choices(antenna);
  const auto chosen_tasks =
      choice_tasks(antenna, options, choices, recommended.design.tuning.law.structure);
  MatchingPlan matching = plan_matching(antenna, options);

  std::vector<design::DesignTask> tasks = tuning;
  tasks.insert(tasks.end(), chosen_tasks.begin(), chosen_tasks.end());
  tasks.insert(tasks.end(), matching.tasks.begin(), matching.tasks.end());
  auto designs = design::solve_all(tasks, options.threads, options.progress);

  const auto first_choice = designs.begin() + static_cast<std::ptrdiff_t>(tuning.size());
  const auto first_match = first_choice + static_cast<std::ptrdiff_t>(chosen_tasks.size());
  report.tuning = tuning_section(antenna, options, recommended, {designs.begin(), first_choice});
  std::vector<design::Design> chosen(first_choice, first_match);
  design::improve_along(chosen_tasks, chosen);
  auto design = chosen.begin();
  for (auto& choice : choices) {
    if (choice.antenna) {
      choice.result.design = std::move(*design++);
      choice.result.speed_limits =
          speed_limits(antenna, make_problem(antenna, *choice.antenna), *choice.result.design);
    }
    report.choices.push_back(std::move(choice.result));
  }
  report.matching = finish_matching(std::move(matching), first_match, options.threads);
  if (study.time_domain && study.time_domain->law == description_of(recommended)) {
    report.time_domain = section_of(antenna, std::move(study.time_domain));
  } else if (recommended.goals_met) {
    report.time_domain = section_of(
        antenna,
        verify_in_time_domain(designed.mission, report.tuning->problem,
                              recommended.design.tuning.law, description_of(recommended),
                              options.seed, options.threads, design::SecondIntegrator::cvodes));
  }
}

}  // namespace boresight::app
