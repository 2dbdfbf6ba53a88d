#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <boresight/control/controllers/sample_time.hpp>
#include <boresight/design/problem/drive_capability.hpp>
#include <boresight/design/simulation/position_run.hpp>
#include <boresight/design/tuning/design_study.hpp>
#include <boresight/design/verification/simulated_loop.hpp>
#include <boresight/design/verification/wind_course.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/nonlinear/nonlinear_drive.hpp>
#include <boresight/plant/nonlinear/simulation.hpp>
#include <boresight/plant/wind/wind_time_series.hpp>

namespace boresight::design {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr Index intervals_per_sample = 4;

// The antenna that runs, and what its controller was designed on.
struct SimulatedAxis {
  explicit SimulatedAxis(const Mission& mission)
      : problem(tracking_problem(mission)),
        antenna(plant::nonlinear_antenna(mission.antenna)),
        gear(plant::gear_ratio(mission.antenna)),
        sample_time(control::sample_time_of(mission.antenna.dead_time)) {}

  double interval() const { return sample_time / static_cast<double>(intervals_per_sample); }

  TrackingProblem problem;
  plant::NonlinearAntenna antenna;
  double gear;
  double sample_time;  // s, of the controller
};

// Boresight rms of the linear design in wind of that mean speed (rad at the sky); none of an
// unstable one.
std::optional<double> predicted_rms(const TrackingProblem& problem, const TuningResult& evaluated,
                                    double mean_speed) {
  if (mean_speed <= 0.0 || evaluated.status == TuningStatus::unstable) return std::nullopt;
  if (mean_speed == problem.wind.mean_speed) {
    return std::sqrt(evaluated.evaluation.boresight_variance()) / problem.gear_ratio;
  }
  control::LoopEvaluator evaluator = make_evaluator(problem);
  return boresight_rms_at_speed(problem, evaluator,
                                evaluator.wind_transmission(evaluated.controller),
                                evaluated.evaluation.noise_variance, mean_speed);
}

LoopRun run_position_loop(const SimulatedAxis& axis, const control::Controller& controller,
                          const ReferenceTrajectory& course, std::uint64_t seed,
                          const RunProgress& progress) {
  LoopRunOptions options;
  options.seed = seed;
  options.relative_tolerance = 1e-6;
  options.absolute_tolerance = 1e-8;
  if (progress) {
    options.progress = [&](Index done, Index all) {
      return progress(static_cast<double>(done) / static_cast<double>(all));
    };
  }
  auto run = run_loop(make_simulated_loop(axis.problem, axis.antenna, controller), course, options);
  if (run.status == RunStatus::failed) throw NumericalFailure(run.message);
  return run;
}

double rms_about_mean(const VectorXd& values) {
  return std::sqrt((values.array() - values.mean()).square().mean());
}

// The record without its errors.
PositionTestRecord describe(const SimulatedAxis& axis, const control::Controller& controller,
                            const LoopRun& run, const ReferenceTrajectory& course) {
  const auto& result = run.result;
  const double interval = course.interval;
  const Index samples = result.values.rows();
  PositionTestRecord record;
  record.controller = controller;
  record.complete = result.complete;
  record.events = plant::events_of(axis.antenna, result, column(result, "valve_command"), interval);
  record.sample_time = interval;
  record.duration = interval * static_cast<double>(samples - 1);
  record.planned_duration = interval * static_cast<double>(course.reference.size() - 1);
  record.channels = {{"time", "s", 6, VectorXd::LinSpaced(samples, 0.0, record.duration)},
                     {"reference", "deg", 7, run.reference / (axis.gear * degree)},
                     {"encoder_error", "mdeg", 5, run.encoder_error / millidegree},
                     {"boresight_error", "mdeg", 5, run.boresight_error / millidegree},
                     {"motor_rate", "rad/s", 5, column(result, "motor_rate")},
                     {"motor_torque", "N.m", 4, column(result, "motor_torque")},
                     {"valve_command", "rad/s", 5, column(result, "valve_command")},
                     {"wind_torque_at_motor", "N.m", 4, course.wind_torque.head(samples)}};
  return record;
}

// Errors at the sky from sample `settled` on; none without at least a second of them.
void evaluate(PositionTestRecord& record, Index settled) {
  const auto& channels = record.channels;
  const Index rest = channels.front().values.size() - settled;
  if (static_cast<double>(rest) * record.sample_time < 1.0) return;
  const VectorXd encoder = channels[2].values.tail(rest) * millidegree;
  const VectorXd boresight = channels[3].values.tail(rest) * millidegree;
  record.boresight_rms = rms_about_mean(boresight);
  record.boresight_mean = boresight.mean();
  record.encoder_rms = rms_about_mean(encoder);
}

// Wind at the samples of a run.
struct WindCourse {
  VectorXd torque;          // N m at the motor
  double mean_speed = 0.0;  // m/s
  std::optional<MeasuredGusts> measured;
};

WindCourse synthesised_wind(const WindCondition& wind, double gear, double duration,
                            double interval, std::uint64_t seed) {
  const auto gusts = plant::synthesise_wind_torque(wind.site, wind.model, wind.mean_speed, duration,
                                                   interval, seed);
  const double mean = plant::mean_wind_torque(wind.site, wind.mean_speed) / gear;
  return {((gusts.uniform + gusts.gradient).array() / gear + mean).matrix(), wind.mean_speed,
          std::nullopt};
}

// Straight between the samples of the record.
WindCourse measured_wind(const Mission& mission, const plant::WindRecord& record, double gear,
                         double interval, std::uint64_t seed) {
  const WindCondition& wind = mission.wind;
  const plant::RecordTorqueOptions options{wind.model, false};
  const VectorXd torque = mission.torque_table && mission.pointing
                              ? plant::wind_record_torque(record, wind.site, *mission.torque_table,
                                                          *mission.pointing, options)
                              : plant::wind_record_torque(record, wind.site, options);
  WindCourse course;
  course.mean_speed = record.speed.mean();
  const double duration = record.sample_time * static_cast<double>(record.speed.size() - 1);
  course.torque = VectorXd::Zero(static_cast<Index>(duration / interval * (1.0 + 1e-12)) + 1);
  if (wind.model == plant::WindModel::coherence) {
    const auto parts = plant::synthesise_wind_torque(
        wind.site, wind.model, course.mean_speed,
        interval * static_cast<double>(course.torque.size() + 1), interval, seed);
    course.torque = parts.gradient.head(course.torque.size()) / gear;
  }
  for (Index k = 0; k < course.torque.size(); ++k) {
    const double place = interval * static_cast<double>(k) / record.sample_time;
    const auto i = std::min(static_cast<Index>(place), torque.size() - 2);
    const double fraction = place - static_cast<double>(i);
    course.torque[k] += ((1.0 - fraction) * torque[i] + fraction * torque[i + 1]) / gear;
  }
  const double rms = std::sqrt((record.speed.array() - course.mean_speed).square().mean());
  course.measured = MeasuredGusts{rms, record.sample_time};
  return course;
}

}  // namespace

PositionTestRecord run_tracking(const Mission& mission, const control::Controller& controller,
                                std::uint64_t seed, const RunProgress& progress) {
  constexpr double settle = 60.0;
  constexpr double measured = 600.0;
  const SimulatedAxis axis(mission);
  const double interval = axis.interval();
  const double rate = mission.antenna.drive.tracking_rate * axis.gear;
  const WindCondition& wind = mission.wind;
  const WindCourse gusts =
      mission.wind_record ? measured_wind(mission, *mission.wind_record, axis.gear, interval, seed)
                          : synthesised_wind(wind, axis.gear, settle + measured, interval, seed);
  const ReferenceTrajectory course = steady_course(interval, rate, gusts.torque);
  const auto evaluated = assess(axis.problem, controller, constraints(mission)).tuning;
  const auto run = run_position_loop(axis, controller, course, seed, progress);
  PositionTestRecord record = describe(axis, controller, run, course);
  record.test = "tracking";
  record.tracking = TrackingCourse{mission.antenna.drive.tracking_rate, gusts.mean_speed,
                                   wind.model, plant::site_gusts(wind.site).kind, gusts.measured};
  evaluate(record, static_cast<Index>(std::llround(settle / interval)));
  record.predicted_rms = predicted_rms(axis.problem, evaluated, gusts.mean_speed);
  return record;
}

PositionTestRecord run_slew(const Mission& mission, const control::Controller& controller,
                            std::uint64_t seed, const RunProgress& progress) {
  constexpr double distance = 1.0 * degree;
  constexpr double still = 5.0;  // s before
  constexpr double hold = 60.0;  // s after
  const SimulatedAxis axis(mission);
  const double gear = axis.gear;
  const double wanted = mission.antenna.drive.slew_rate;
  const double attainable = attainable_rate(axis.antenna, wanted * gear) / gear;
  const auto limits = achievable_limits(axis.antenna, plant::reflected_inertia(axis.problem.plant),
                                        {wanted * gear, slew_acceleration * gear});
  constexpr double longest = 3600.0;  // s
  if (!(limits.rate > 0.0) || !(limits.acceleration > 0.0) ||
      control::min_move_time(limits, distance * gear) >= longest) {
    throw InfeasibleRequirement(
        fmt::format("the supply cannot slew this antenna: against friction it holds {:.3g} deg/s",
                    attainable / degree));
  }
  const double moving = control::min_move_time(limits, distance * gear);
  const auto moved = static_cast<Index>(std::ceil((still + moving) / axis.sample_time)) + 2;
  const auto samples = moved + static_cast<Index>(std::ceil(hold / axis.sample_time));
  const ReferenceTrajectory course =
      shaped_course(limits, axis.sample_time, samples, intervals_per_sample, [&](double t) {
        return control::CommandSample{t > still ? distance * gear : 0.0, 0.0, 0.0};
      });
  const auto run = run_position_loop(axis, controller, course, seed, progress);
  const Index end = moved * intervals_per_sample;
  const double interval = course.interval;
  PositionTestRecord record = describe(axis, controller, run, course);
  record.test = "slew";
  record.slew = SlewCourse{distance, course.reference_rate.maxCoeff() / gear,
                           limits.acceleration / gear, wanted, attainable};
  const VectorXd error = record.channels[2].values * millidegree;
  if (end >= error.size()) return record;  // ended before the command did
  Index settled = end;
  for (Index k = end; k < error.size(); ++k) {
    if (std::abs(error[k]) > millidegree) settled = k + 1;
  }
  record.overshoot = error.tail(error.size() - end).cwiseAbs().maxCoeff();
  constexpr double long_enough = 10.0;  // s within the bound
  if (static_cast<double>(error.size() - settled) * interval >= long_enough) {
    record.settling_time = interval * static_cast<double>(settled - end);
    evaluate(record, settled);
  }
  return record;
}

}  // namespace boresight::design
