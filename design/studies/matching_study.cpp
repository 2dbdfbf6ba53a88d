#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <boresight/design/problem/drive_capability.hpp>
#include <boresight/design/problem/standstill.hpp>
#include <boresight/design/studies/controller_study.hpp>
#include <boresight/design/studies/matching_rules.hpp>
#include <boresight/design/studies/matching_study.hpp>
#include <boresight/design/studies/matching_variants.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/parallel_loop.hpp>
#include <boresight/plant/antenna/antenna_change.hpp>
#include <boresight/plant/nonlinear/antenna_parameters.hpp>
#include <boresight/plant/nonlinear/drive_capability.hpp>
#include <boresight/plant/nonlinear/nonlinear_drive.hpp>

namespace boresight::design {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// The mission's antenna with so many disks on each motor.
plant::Antenna with_disks(const Mission& mission, double disks) {
  return changed(mission.antenna, {plant::set_to("motor.flywheel_disks", disks)});
}

// Evenly spaced disks, and between them ratio 1 and as built.
std::vector<MatchPoint> points_of(const Mission& mission, const MatchOptions& options) {
  if (options.points < 4) {
    throw InvalidInput(fmt::format("match: expected at least 4 points, found {}", options.points));
  }
  double maximum = options.max_disks;
  if (maximum == 0.0) maximum = mission.max_disks;
  if (!(maximum > 0.0) || !std::isfinite(maximum)) {
    throw InvalidInput(
        fmt::format("match: expected more than 0 disks at most, found {:g}", maximum));
  }
  std::vector<MatchPoint> points;
  for (int i = 0; i < options.points; ++i) {
    points.push_back({.disks = maximum * i / (options.points - 1)});
  }
  const auto mark = [&](double disks, bool MatchPoint::*which) {
    auto same = std::ranges::find_if(
        points, [&](const auto& point) { return std::abs(point.disks - disks) < 1e-6 * maximum; });
    if (same == points.end()) {
      same = points.insert(points.end(), MatchPoint{.disks = disks, .on_grid = false});
    }
    (*same).*which = true;
  };
  const plant::Antenna& antenna = mission.antenna;
  const double load = gear_train_inertia(antenna) + antenna_inertia(antenna);
  if (const auto unit = disks_at_unit_ratio(antenna, load)) mark(*unit, &MatchPoint::unit_ratio);
  mark(antenna.flywheels.disks, &MatchPoint::as_built);
  std::ranges::sort(points, {}, &MatchPoint::disks);
  return points;
}

// Rate and acceleration at the motor with whatever acceleration the drive has reserve for.
control::CommandLimits reach_of(const plant::Antenna& antenna, double inertia) {
  constexpr double any_acceleration = std::numeric_limits<double>::infinity();
  return achievable_limits(nonlinear_antenna(antenna), inertia,
                           {antenna.drive.slew_rate * gear_ratio(antenna), any_acceleration});
}

// The mission's slew rate, or four fifths of the highest that the supply holds against friction if
// that is less (as design::achievable_limits has it): on the nonlinear antenna, or without one by
// the torque and by what the valve lets through without load.
double achievable_rate(const plant::Antenna& antenna) {
  const double ratio = gear_ratio(antenna);
  if (antenna.nonlinear) {
    return reach_of(antenna, plant::reflected_inertia(linear_plant(antenna))).rate / ratio;
  }
  // At the motor, where the two are equal to the last bit if nothing is known of the stroke.
  const double wanted = antenna.drive.slew_rate * ratio;
  const double open = plant::largest_demand(antenna);
  const plant::FrictionCurve& curve = antenna.friction_curve;
  const double supply = plant::supply_torque(antenna);
  if (wanted <= open && plant::friction_torque(curve, wanted) < supply) {
    return antenna.drive.slew_rate;
  }
  double low = 0.0, high = std::min(wanted, open);
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (plant::friction_torque(curve, middle) < supply ? low : high) = middle;
  }
  return 0.8 * low / ratio;
}

void describe(const Mission& mission, const MatchingStudy& study, MatchPoint& point) {
  const plant::Antenna& antenna = mission.antenna;
  const plant::Antenna other = with_disks(mission, point.disks);
  const auto plant = linear_plant(other);
  point.motor_inertia = plant::motor_inertia(other);
  point.reflected_inertia = plant::reflected_inertia(plant);
  point.motor_to_load_ratio =
      plant::motor_to_load_ratio(point.motor_inertia, point.reflected_inertia);
  const auto modes = plant::plant_modes(plant);
  point.hydraulic = plant::hydraulic_mode(modes);
  point.oil_mode = plant::mode_of_oil(modes);
  const double ratio = gear_ratio(antenna);
  if (study.slew_by_simulation) {
    point.acceleration = reach_of(antenna, point.reflected_inertia).acceleration / ratio;
  } else {
    const double left = plant::supply_torque(antenna) -
                        plant::friction_torque(antenna.friction_curve, study.slew_rate * ratio);
    point.acceleration = left / point.reflected_inertia / ratio;
  }
  point.slew_time = std::numeric_limits<double>::infinity();
  if (point.acceleration > 0.0) {
    // Up to the slew rate and down again; what does not get there turns half way.
    const double full = study.slew_rate * study.slew_rate / point.acceleration;
    point.slew_time =
        full <= study.slew_distance
            ? study.slew_distance / study.slew_rate + study.slew_rate / point.acceleration
            : 2.0 * std::sqrt(study.slew_distance / point.acceleration);
  }
  point.two_mass_damping = 0.5 / std::sqrt(point.motor_to_load_ratio);
  point.acceleration_of_best_ratio =
      2.0 * std::sqrt(point.motor_to_load_ratio) / (1.0 + point.motor_to_load_ratio);
}

void look_at_position_loop(const TrackingProblem& problem, const control::Controller& controller,
                           const plant::PointResponse& response, MatchValue& value) {
  const auto loop = [&](double w) {
    return control::loop_gain(response(w), w, controller, problem.delay,
                              control::LoopBreak::position_loop);
  };
  const auto band = analysis_band(problem);
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

MatchValue look_at(const Mission& mission, const MatchingStudy& study, const MatchPoint& point,
                   const MatchedController& controller, const WindTable& wind) {
  MatchValue value;
  value.boresight_rms = value.wind_rms = value.noise_rms = value.control_effort = nan;
  value.found = controller.status == TuningStatus::optimal;
  if (controller.status == TuningStatus::unstable) return value;
  auto problem = tracking_problem(mission, with_disks(mission, point.disks));
  problem.points_per_decade = 100;
  auto evaluator = make_adaptive_evaluator(problem, wind);
  evaluator.look_at_gusts(true);
  const auto evaluation = evaluator.evaluate(controller.controller, false);
  value.wind_rms = std::sqrt(evaluation.wind_variance) / problem.gear_ratio;
  value.noise_rms = std::sqrt(evaluation.noise_variance) / problem.gear_ratio;
  value.boresight_rms = std::hypot(value.wind_rms, value.noise_rms);
  value.control_effort = std::sqrt(evaluation.effort_variance);
  const auto& drive = problem.plant.drive;
  const double mean =
      plant::mean_wind_torque(problem.wind.site, problem.wind.mean_speed) / problem.gear_ratio;
  value.gust_torque =
      std::abs(mean) + study.goals.crest_factor * std::sqrt(evaluation.wind_torque_variance);
  value.gust_demand = std::abs(mean) * drive.leakage_rate / drive.oil_stiffness +
                      study.goals.crest_factor * std::sqrt(evaluation.wind_demand_variance);
  const plant::PointResponse response(problem.plant);
  const Eigen::ArrayXd grid = analysis_grid(problem);
  for (std::size_t b = 0; b < control::loop_breaks.size(); ++b) {
    value.margins.at(b) = control::margins(
        [&](double w) {
          return control::loop_gain(response(w), w, controller.controller, problem.delay,
                                    control::loop_breaks.at(b));
        },
        grid);
  }
  look_at_position_loop(problem, controller.controller, response, value);
  value.verification = verify(problem, controller.controller, study.goals);
  return value;
}

// Of the members with the motors of a problem.
double over_ensemble(const TrackingProblem& problem, const PlantEnsemble& ensemble,
                     double inertia_factor, const control::Controller& controller,
                     const Constraints& goals) {
  std::vector<EnsembleMember> members = ensemble.members;
  for (auto& member : members) member.plant.drive.motor_inertia *= inertia_factor;
  return rms_over_members(evaluate(problem, members, controller, goals, 1));
}

MatchTimeDomain run_in_time(const Mission& mission, const PlantEnsemble& ensemble,
                            const MatchingStudy& study, const MatchOptions& how,
                            const MatchPoint& point, const MatchValue& value,
                            const control::Controller& controller,
                            const std::shared_ptr<SharedWinds>& winds) {
  const plant::Antenna& antenna = mission.antenna;
  const auto problem = tracking_problem(mission, with_disks(mission, point.disks));
  const auto nonlinear =
      plant::with_parameter(nonlinear_antenna(antenna), plant::AntennaParameter::motor_inertia,
                            problem.plant.drive.motor_inertia);
  auto loop = make_simulated_loop(problem, nonlinear, controller);
  loop.encoder_resolution = encoder_step(antenna) * problem.gear_ratio;
  NonlinearVerificationOptions options;
  options.wind_duration = 1.0;
  options.explain = false;
  options.limit_cycle_duration = 120.0;
  options.tracking_rate = antenna.drive.tracking_rate;
  options.limits = {antenna.drive.slew_rate, slew_acceleration};
  options.winds = winds;
  auto result = verify_in_time(problem, loop, options);
  MatchTimeDomain run{std::move(result.limit_cycles), std::move(result.reversal)};
  if (!value.found || !is_limit_cycle_free(run.limit_cycles, study.allowed_limit_cycle)) return run;
  // The records of wind of verify_in_time_domain.
  const NonlinearVerificationOptions records;
  run.expected = simulated_rms(problem, loop,
                               {.settling = records.settling,
                                .duration = records.wind_duration,
                                .tracking_rate = options.tracking_rate,
                                .seed = how.seed,
                                .shared = winds});
  const double factor =
      problem.plant.drive.motor_inertia / linear_plant(antenna).drive.motor_inertia;
  run.member_rms = study.members == 0
                       ? value.boresight_rms
                       : over_ensemble(problem, ensemble, factor, controller, study.goals);
  return run;
}

bool is_chosen(const MatchPoint& point, MatchTimeRuns runs) {
  return runs == MatchTimeRuns::all ||
         (runs == MatchTimeRuns::few && (point.disks == 0.0 || point.unit_ratio || point.as_built));
}

void find_best(const std::vector<MatchPoint>& points, MatchSeries& series) {
  std::vector<double> disks, rms;
  std::vector<std::size_t> grid;
  for (std::size_t i = 0; i < points.size(); ++i) {
    disks.push_back(points[i].disks);
    rms.push_back(series.values[i].found ? series.values[i].boresight_rms : nan);
    if (points[i].on_grid) grid.push_back(i);
  }
  series.smoothness = smoothness(series.curve, grid);
  series.best = least_of(rms);
  if (!series.best) return;
  series.within_1_percent = flat_range(disks, rms, 0.01);
  series.within_5_percent = flat_range(disks, rms, 0.05);
  series.best_at_end = *series.best == 0 || *series.best + 1 == points.size();
}

void tune_curves(const Mission& mission, const PlantEnsemble& ensemble, const MatchOptions& options,
                 const std::vector<NamedStructure>& structures, MatchingStudy& study) {
  MatchingTask task;
  task.problem = tracking_problem(mission);
  study.wind_speed = task.problem.wind.mean_speed;
  study.wind_model = task.problem.wind.model;
  if (options.robust) task.members = ensemble.members;
  study.members = task.members.size();
  task.goals = study.goals;
  task.objective = study.objective;
  for (const auto& point : study.points) {
    task.motor_inertia.push_back(
        linear_plant(with_disks(mission, point.disks)).drive.motor_inertia);
  }
  for (const auto& one : structures) task.structures.push_back(one.structure);
  MatchingOptions how;
  how.starts = options.starts;
  how.seed = options.seed;
  how.threads = options.threads;
  how.stop = options.interrupted;
  if (options.progress) {
    how.progress = [&](std::size_t done, std::size_t all) {
      options.progress("tuning", done, all);
    };
  }
  auto curves = match_motors(task, how);
  study.tolerance = curves.tolerance;
  study.rounds = curves.rounds;
  study.settled = curves.settled;
  study.evaluations = curves.evaluations;
  for (std::size_t s = 0; s < structures.size(); ++s) {
    study.series.push_back(
        {structures[s].name, std::move(curves.curves[s]), {}, {}, {}, {}, {}, false});
    study.series.back().values.resize(study.points.size());
  }
}

// As every study does it, on the whole ensemble.
void tune_as_built(const Mission& mission, const PlantEnsemble& ensemble,
                   const MatchOptions& options, MatchingStudy& study) {
  TuneOptions tuning;
  tuning.structures = options.structures;
  tuning.seed = options.seed;
  tuning.threads = options.threads;
  tuning.interrupted = options.interrupted;
  if (options.progress) {
    tuning.progress = [&](std::size_t done, std::size_t all) {
      options.progress("tuning as built", done, all);
    };
  }
  ControllerStudy controllers = study_controllers(mission, ensemble, tuning);
  if (options.interrupted && options.interrupted()) return;
  study.tuned_as_built = std::move(controllers.tuned);
}

}  // namespace

MatchingStudy study_matching(const Mission& mission, const PlantEnsemble& ensemble,
                             const MatchOptions& options) {
  const auto& structures =
      (options.structures.empty() ? mission.structures : options.structures).loops;
  const auto stopped = [&] { return options.interrupted && options.interrupted(); };
  const plant::Antenna& antenna = mission.antenna;
  MatchingStudy study;
  study.slew_rate = achievable_rate(antenna);
  study.slew_by_simulation = antenna.nonlinear.has_value();
  study.slew_distance = 10.0 * degree;
  study.tracking_rate = antenna.drive.tracking_rate;
  study.tracking_friction = plant::tracking_friction(antenna);
  study.friction = antenna.drive.viscous_friction;
  study.allowed_limit_cycle = allowed_limit_cycle(mission);
  study.points = points_of(mission, options);
  for (auto& point : study.points) describe(mission, study, point);
  study.goals = constraints(mission);
  study.objective = mission.objective;
  study.starts = options.starts;
  tune_curves(mission, ensemble, options, structures, study);

  const WindTable wind(tracking_problem(mission));
  const auto winds = std::make_shared<SharedWinds>();
  const std::size_t all = study.points.size() * structures.size();
  numerics::StepCounter counter(all, [&](std::size_t done, std::size_t of) {
    if (options.progress) options.progress("checking", done, of);
  });
  numerics::for_each_index(all, options.threads, [&](std::size_t i) {
    MatchSeries& series = study.series[i % structures.size()];
    const std::size_t p = i / structures.size();
    const MatchPoint& point = study.points[p];
    const auto& controller = series.curve.controllers[p];
    series.values[p] = look_at(mission, study, point, controller, wind);
    if (antenna.nonlinear && !stopped() && controller.status != TuningStatus::unstable &&
        is_chosen(point, options.time_runs)) {
      series.values[p].time_domain = run_in_time(mission, ensemble, study, options, point,
                                                 series.values[p], controller.controller, winds);
    }
    counter.step();
  });
  for (auto& series : study.series) find_best(study.points, series);
  study.rules = evaluate_rules(mission, study);
  if (options.variants && !stopped()) vary(mission, options, study);
  if (options.tune_as_built && !stopped()) tune_as_built(mission, ensemble, options, study);
  return study;
}

}  // namespace boresight::design
