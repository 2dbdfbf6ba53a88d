#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <boresight/app/match/match_study.hpp>
#include <boresight/app/simulate/nonlinear_model.hpp>
#include <boresight/app/tune/structure_option.hpp>
#include <boresight/design/problem/drive_reach.hpp>
#include <boresight/io/case/antenna_of.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/mission_of.hpp>
#include <boresight/io/case/plant_numbers.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/parallel_loop.hpp>
#include <boresight/plant/antenna/antenna_change.hpp>
#include <boresight/plant/nonlinear/antenna_parameters.hpp>

namespace boresight::app {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// Evenly spaced disks, and between them ratio 1 and as built.
std::vector<MatchPoint> points_of(const io::Case& antenna, const MatchOptions& options) {
  if (options.points < 4) {
    throw InvalidInput(fmt::format("match: expected at least 4 points, found {}", options.points));
  }
  double most = options.most_disks;
  if (most == 0.0) most = antenna.matching_disks.back();
  if (!(most > 0.0) || !std::isfinite(most)) {
    throw InvalidInput(fmt::format("match: expected more than 0 disks at most, found {:g}", most));
  }
  std::vector<MatchPoint> points;
  for (int i = 0; i < options.points; ++i) {
    points.push_back({.disks = most * i / (options.points - 1)});
  }
  const auto add = [&](double disks, const char* label) {
    const auto same = std::ranges::find_if(
        points, [&](const auto& point) { return std::abs(point.disks - disks) < 1e-6 * most; });
    if (same != points.end()) {
      same->label = same->label.empty() ? label : same->label + ", " + label;
    } else {
      points.push_back({.disks = disks, .label = label, .on_grid = false});
    }
  };
  const double load = gear_train_inertia(antenna) + antenna_inertia(antenna);
  if (const auto unit = disks_at_unit_ratio(antenna, load)) add(*unit, "ratio 1");
  add(antenna.motor.flywheel_disks, "as built");
  std::ranges::sort(points, {}, &MatchPoint::disks);
  return points;
}

// Rate and acceleration at the motor with whatever acceleration the drive has reserve for.
control::CommandLimits reach_of(const io::Case& antenna, double inertia) {
  constexpr double any_acceleration = std::numeric_limits<double>::infinity();
  return design::within_reach(
      make_nonlinear_antenna(antenna), inertia,
      {antenna.drive.slew_rate.value * gear_ratio(antenna), any_acceleration});
}

// The case's slew rate, or four fifths of the highest that the supply holds against friction if
// that is less (as design::within_reach has it): on the nonlinear antenna, or without a simulation
// by the torque and by what the valve lets through without load.
double rate_within_reach(const io::Case& antenna) {
  const double ratio = io::gear_ratio(antenna);
  if (antenna.simulation) {
    return reach_of(antenna, plant::reflected_inertia(make_plant(antenna))).rate / ratio;
  }
  // At the motor, where the two are equal to the last bit if the case states no stroke.
  const double wanted = antenna.drive.slew_rate.value * ratio;
  const double open = io::largest_demand(antenna);
  const auto curve = io::friction_curve(antenna);
  const double supply = io::supply_torque(antenna);
  if (wanted <= open && plant::friction_torque(curve, wanted) < supply) {
    return antenna.drive.slew_rate.value;
  }
  double low = 0.0, high = std::min(wanted, open);
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (plant::friction_torque(curve, middle) < supply ? low : high) = middle;
  }
  return 0.8 * low / ratio;
}

void describe(const io::Case& antenna, const MatchSection& section, MatchPoint& point) {
  const auto plant = make_plant(antenna, {plant::set_to("motor.flywheel_disks", point.disks)});
  point.motor_inertia = motor_inertia(antenna, point.disks);
  point.reflected_inertia = plant::reflected_inertia(plant);
  point.motor_to_load_ratio =
      plant::motor_to_load_ratio(point.motor_inertia, point.reflected_inertia);
  const auto modes = plant::plant_modes(plant);
  point.hydraulic = plant::hydraulic_mode(modes);
  point.oil_mode = plant::mode_of_oil(modes);
  const double ratio = io::gear_ratio(antenna);
  if (section.slew_by_simulation) {
    point.acceleration = reach_of(antenna, point.reflected_inertia).acceleration / ratio;
  } else {
    const double left =
        io::supply_torque(antenna) -
        plant::friction_torque(io::friction_curve(antenna), section.slew_rate * ratio);
    point.acceleration = left / point.reflected_inertia / ratio;
  }
  point.slew_time = std::numeric_limits<double>::infinity();
  if (point.acceleration > 0.0) {
    // Up to the slew rate and down again; what does not get there turns half way.
    const double full = section.slew_rate * section.slew_rate / point.acceleration;
    point.slew_time =
        full <= section.slew_distance
            ? section.slew_distance / section.slew_rate + section.slew_rate / point.acceleration
            : 2.0 * std::sqrt(section.slew_distance / point.acceleration);
  }
  point.two_mass_damping = 0.5 / std::sqrt(point.motor_to_load_ratio);
  point.acceleration_of_best_ratio =
      2.0 * std::sqrt(point.motor_to_load_ratio) / (1.0 + point.motor_to_load_ratio);
}

void look_at_position_loop(const design::TrackingProblem& problem, const control::ControlLaw& law,
                           const plant::PointResponse& response, MatchValue& value) {
  const auto loop = [&](double w) {
    return control::loop_gain(response(w), w, law, problem.delay,
                              control::LoopBreak::position_loop);
  };
  const auto band = design::analysis_band(problem);
  // At the lowest frequency the loop is that of a double integrator.
  const double lowest = two_pi * band.lowest;
  value.acceleration_error = 1.0 / (lowest * lowest * std::abs(loop(lowest)));
  constexpr double step = 1.02;
  value.bandwidth = nan;
  for (double w = lowest; w < two_pi * band.highest; w *= step) {
    if (std::norm(1.0 + loop(w)) < 2.0) continue;
    if (std::norm(1.0 + loop(w * step)) >= 2.0) continue;
    double inside = w, outside = w * step;
    for (int i = 0; i < 30; ++i) {
      const double middle = std::sqrt(inside * outside);
      (std::norm(1.0 + loop(middle)) >= 2.0 ? inside : outside) = middle;
    }
    value.bandwidth = inside / two_pi;
    break;
  }
}

MatchValue look_at(const io::Case& antenna, const MatchSection& section, const MatchPoint& point,
                   const design::MatchedLaw& law, const design::WindTable& wind) {
  MatchValue value;
  value.beam_rms = value.wind_rms = value.noise_rms = value.valve_effort = nan;
  value.found = law.status == design::TuningStatus::optimal;
  if (law.status == design::TuningStatus::unstable) return value;
  auto problem = make_problem(antenna, {plant::set_to("motor.flywheel_disks", point.disks)});
  problem.points_per_decade = 100;
  auto evaluator = design::make_adaptive_evaluator(problem, wind);
  evaluator.look_at_gusts(true);
  const auto evaluation = evaluator.evaluate(law.law, false);
  value.wind_rms = std::sqrt(evaluation.wind_variance) / problem.gear_ratio;
  value.noise_rms = std::sqrt(evaluation.noise_variance) / problem.gear_ratio;
  value.beam_rms = std::hypot(value.wind_rms, value.noise_rms);
  value.valve_effort = std::sqrt(evaluation.effort_variance);
  const auto& drive = problem.plant.drive;
  const double mean =
      plant::mean_wind_torque(problem.wind.site, problem.wind.mean_speed) / problem.gear_ratio;
  value.gust_torque =
      std::abs(mean) + section.goals.crest_factor * std::sqrt(evaluation.wind_torque_variance);
  value.gust_demand = std::abs(mean) * drive.leakage_rate / drive.oil_stiffness +
                      section.goals.crest_factor * std::sqrt(evaluation.wind_demand_variance);
  const plant::PointResponse response(problem.plant);
  const Eigen::ArrayXd grid = design::analysis_grid(problem);
  for (std::size_t b = 0; b < control::loop_breaks.size(); ++b) {
    value.margins.at(b) = control::margins(
        [&](double w) {
          return control::loop_gain(response(w), w, law.law, problem.delay,
                                    control::loop_breaks.at(b));
        },
        grid);
  }
  look_at_position_loop(problem, law.law, response, value);
  value.verification = design::verify(problem, law.law, section.goals);
  return value;
}

// In still air: the linear figures say what wind does.
MatchTimeDomain run_in_time(const io::Case& antenna, const MatchPoint& point,
                            const control::ControlLaw& law) {
  const auto problem = make_problem(antenna, {plant::set_to("motor.flywheel_disks", point.disks)});
  const auto nonlinear =
      plant::with_parameter(make_nonlinear_antenna(antenna), plant::AntennaParameter::motor_inertia,
                            problem.plant.drive.motor_inertia);
  auto loop = design::make_simulated_loop(problem, nonlinear, law);
  loop.encoder_resolution =
      std::sqrt(12.0) * antenna.sensors.encoder_noise.value * problem.gear_ratio;
  design::NonlinearVerificationOptions options;
  options.wind_duration = 1.0;
  options.explain = false;
  options.hunting_duration = 120.0;
  options.tracking_rate = antenna.drive.tracking_rate.value;
  options.limits = {antenna.drive.slew_rate.value, 0.2 * degree};
  auto result = design::verify_in_time(problem, loop, options);
  return {std::move(result.hunting), std::move(result.reversal)};
}

bool is_chosen(const MatchPoint& point, MatchTimeRuns runs) {
  return runs == MatchTimeRuns::all ||
         (runs == MatchTimeRuns::few && (point.disks == 0.0 || !point.label.empty()));
}

void find_best(const std::vector<MatchPoint>& points, MatchSeries& series) {
  std::vector<double> disks, rms;
  std::vector<std::size_t> grid;
  for (std::size_t i = 0; i < points.size(); ++i) {
    disks.push_back(points[i].disks);
    rms.push_back(series.values[i].found ? series.values[i].beam_rms : nan);
    if (points[i].on_grid) grid.push_back(i);
  }
  series.smoothness = design::smoothness(series.curve, grid);
  series.best = least_of(rms);
  if (!series.best) return;
  series.within_1_percent = flat_range(disks, rms, 0.01);
  series.within_5_percent = flat_range(disks, rms, 0.05);
  series.best_at_end = *series.best == 0 || *series.best + 1 == points.size();
}

}  // namespace

std::optional<std::size_t> least_of(const std::vector<double>& values) {
  std::optional<std::size_t> least;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isfinite(values[i]) && (!least || values[i] < values[*least])) least = i;
  }
  return least;
}

FlatRange flat_range(const std::vector<double>& axis, const std::vector<double>& values,
                     double share) {
  const auto least = least_of(values);
  if (!least) return {nan, nan};
  const double level = values[*least] * (1.0 + share);
  const auto reach = [&](auto next) {
    std::size_t i = *least;
    for (auto other = next(i); other; other = next(i)) {
      if (!std::isfinite(values[*other])) break;
      if (values[*other] > level) {
        const double part = (level - values[i]) / (values[*other] - values[i]);
        return axis[i] + part * (axis[*other] - axis[i]);
      }
      i = *other;
    }
    return axis[i];
  };
  using Next = std::optional<std::size_t>;
  return {reach([](std::size_t i) { return i > 0 ? Next(i - 1) : Next(); }),
          reach([&](std::size_t i) { return i + 1 < axis.size() ? Next(i + 1) : Next(); })};
}

MatchSection match_motors(const io::Case& antenna,
                          const std::vector<design::EnsembleMember>& members,
                          const MatchOptions& options) {
  const auto structures = structure_option(antenna, options.structures);
  MatchSection section;
  section.slew_rate = rate_within_reach(antenna);
  section.slew_by_simulation = antenna.simulation.has_value();
  section.slew_distance = 10.0 * degree;
  section.tracking_rate = antenna.drive.tracking_rate.value;
  section.tracking_friction = io::tracking_friction(antenna);
  section.friction = antenna.drive.viscous_friction.value;
  section.tightest_budget = tightest_budget(antenna);
  section.points = points_of(antenna, options);
  for (auto& point : section.points) describe(antenna, section, point);
  section.goals = make_goals(antenna);
  section.soft_goal = make_soft_goal(antenna);
  section.members = members.size();
  section.starts = options.starts;

  design::MatchingTask task;
  task.problem = make_problem(antenna);
  section.wind_speed = task.problem.wind.mean_speed;
  section.wind_model = task.problem.wind.model;
  section.wind_mast = antenna.wind.mast;
  task.members = members;
  task.goals = section.goals;
  task.soft_goal = section.soft_goal;
  for (const auto& point : section.points) {
    task.motor_inertia.push_back(
        make_plant(antenna, {plant::set_to("motor.flywheel_disks", point.disks)})
            .drive.motor_inertia);
  }
  for (const auto& one : structures) task.structures.push_back(one.structure);
  design::MatchingOptions how;
  how.starts = options.starts;
  how.seed = options.seed;
  how.threads = options.threads;
  how.stop = options.interrupted;
  if (options.progress) {
    how.progress = [&](std::size_t done, std::size_t all) {
      options.progress("tuning", done, all);
    };
  }
  auto curves = design::match_motors(task, how);
  section.tolerance = curves.tolerance;
  section.rounds = curves.rounds;
  section.settled = curves.settled;
  section.evaluations = curves.evaluations;

  for (std::size_t s = 0; s < structures.size(); ++s) {
    section.series.push_back(
        {structures[s].name, std::move(curves.curves[s]), {}, {}, {}, {}, {}, false});
    section.series.back().values.resize(section.points.size());
  }
  const design::WindTable wind(task.problem);
  const std::size_t all = section.points.size() * structures.size();
  numerics::StepCounter counter(all, [&](std::size_t done, std::size_t of) {
    if (options.progress) options.progress("checking", done, of);
  });
  numerics::for_each_index(all, options.threads, [&](std::size_t i) {
    MatchSeries& series = section.series[i % structures.size()];
    const std::size_t p = i / structures.size();
    const MatchPoint& point = section.points[p];
    const auto& law = series.curve.laws[p];
    series.values[p] = look_at(antenna, section, point, law, wind);
    const bool stopped = options.interrupted && options.interrupted();
    if (antenna.simulation && !stopped && law.status != design::TuningStatus::unstable &&
        is_chosen(point, options.time_runs)) {
      series.values[p].time_domain = run_in_time(antenna, point, law.law);
    }
    counter.step();
  });
  for (auto& series : section.series) find_best(section.points, series);
  section.rules = judge_rules(antenna, section);
  if (options.variants && !(options.interrupted && options.interrupted())) {
    vary(antenna, options, section);
  }
  return section;
}

}  // namespace boresight::app
