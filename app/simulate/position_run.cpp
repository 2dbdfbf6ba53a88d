#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <boresight/app/simulate/nonlinear_model.hpp>
#include <boresight/app/simulate/position_run.hpp>
#include <boresight/control/controllers/sample_time.hpp>
#include <boresight/design/problem/drive_reach.hpp>
#include <boresight/design/tuning/design_study.hpp>
#include <boresight/design/tuning/tuner.hpp>
#include <boresight/design/verification/simulated_loop.hpp>
#include <boresight/io/case/antenna_of.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/mission_of.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/nonlinear/simulation.hpp>
#include <boresight/plant/wind/wind_time_series.hpp>

namespace boresight::app {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double millidegree_at_sky = 1e-3 * degree;
constexpr Index intervals_per_sample = 4;
constexpr double largest_acceleration = 0.2 * degree;  // rad/s2, of a command

// What the loop is told and what acts on it.
struct Course {
  design::LoopCourse loop;
  double mean_wind_speed = 0.0;  // m/s, of the linear prediction; 0: none
};

struct PositionRun {
  design::LoopRun loop;
  std::optional<double> predicted_rms;  // rad at the sky
};

double controller_sample_time(const io::Case& antenna) {
  return control::sample_time_of(antenna.controller_delay.value);
}

double run_interval(const io::Case& antenna) {
  return controller_sample_time(antenna) / static_cast<double>(intervals_per_sample);
}

// Beam rms of the linear design in wind of that mean speed (rad at the sky); none of an unstable
// one.
std::optional<double> predicted_rms(const design::TrackingProblem& problem,
                                    const design::TuningResult& judged, double mean_speed) {
  if (mean_speed <= 0.0 || judged.status == design::TuningStatus::unstable) return std::nullopt;
  if (mean_speed == problem.wind.mean_speed) {
    return std::sqrt(judged.evaluation.beam_variance()) / problem.gear_ratio;
  }
  control::LoopEvaluator evaluator = design::make_evaluator(problem);
  return design::beam_rms_at_speed(problem, evaluator, evaluator.wind_transmission(judged.law),
                                   judged.evaluation.noise_variance, mean_speed);
}

PositionRun run_position_loop(const io::Case& antenna, const SimulatedController& controller,
                              const Course& course, std::uint64_t seed,
                              const RunProgress& progress) {
  const auto problem = make_problem(antenna);
  const auto judged = design::assess(problem, controller.law, make_goals(antenna)).tuning;
  const auto loop =
      design::make_simulated_loop(problem, make_nonlinear_antenna(antenna), controller.law);
  design::LoopRunOptions options;
  options.seed = seed;
  options.relative_tolerance = 1e-6;
  options.absolute_tolerance = 1e-8;
  if (progress) {
    options.progress = [&](Index done, Index all) {
      return progress(static_cast<double>(done) / static_cast<double>(all));
    };
  }
  auto run = design::run_loop(loop, course.loop, options);
  if (run.status == design::RunStatus::failed) throw NumericalFailure(run.message);
  return {std::move(run), predicted_rms(problem, judged, course.mean_wind_speed)};
}

std::string described(const SimulatedController& controller) {
  return fmt::format("by {}, {}", controller.law.structure.name(), controller.source);
}

double rms_about_mean(const VectorXd& values) {
  return std::sqrt((values.array() - values.mean()).square().mean());
}

// The record without its errors.
PositionRecord describe(const io::Case& antenna, const PositionRun& run, const Course& course) {
  const double gear = io::gear_ratio(antenna);
  const auto& result = run.loop.result;
  const double interval = course.loop.interval;
  const Index samples = result.values.rows();
  PositionRecord record;
  record.complete = result.complete;
  record.events =
      events_of(make_nonlinear_antenna(antenna), result, column(result, "valve_command"), interval);
  record.sample_time = interval;
  record.duration = interval * static_cast<double>(samples - 1);
  if (!record.complete) {
    record.record.comments.push_back(
        fmt::format("incomplete: interrupted after {:.3f} s of {:.3f} s", record.duration,
                    interval * static_cast<double>(course.loop.reference.size() - 1)));
  }
  record.record.columns = {
      {"time", "s", 6, VectorXd::LinSpaced(samples, 0.0, record.duration)},
      {"reference", "deg", 7, run.loop.reference / (gear * degree)},
      {"encoder_error", "mdeg", 5, run.loop.encoder_error / millidegree_at_sky},
      {"beam_error", "mdeg", 5, run.loop.beam_error / millidegree_at_sky},
      {"motor_rate", "rad/s", 5, column(result, "motor_rate")},
      {"motor_torque", "N.m", 4, column(result, "motor_torque")},
      {"valve_command", "rad/s", 5, column(result, "valve_command")},
      {"wind_torque_at_motor", "N.m", 4, course.loop.wind_torque.head(samples)}};
  return record;
}

// Errors at the sky from sample `settled` on; none without at least a second of them.
void judge(PositionRecord& record, Index settled) {
  const auto& columns = record.record.columns;
  const Index rest = columns.front().values.size() - settled;
  if (static_cast<double>(rest) * record.sample_time < 1.0) return;
  const VectorXd encoder = columns[2].values.tail(rest) * millidegree_at_sky;
  const VectorXd beam = columns[3].values.tail(rest) * millidegree_at_sky;
  record.beam_rms = rms_about_mean(beam);
  record.beam_mean = beam.mean();
  record.encoder_rms = rms_about_mean(encoder);
}

}  // namespace

namespace {

// Wind torque at the motor at the samples of a run (N m), and what it is.
struct WindCourse {
  VectorXd torque;
  double mean_speed = 0.0;  // m/s
  std::string description;
};

WindCourse synthesised_wind(const design::WindCondition& wind, double gear, double duration,
                            double interval, std::uint64_t seed) {
  const auto gusts = plant::synthesise_wind_torque(wind.site, wind.model, wind.mean_speed, duration,
                                                   interval, seed);
  const double mean = plant::mean_wind_torque(wind.site, wind.mean_speed) / gear;
  return {((gusts.uniform + gusts.gradient).array() / gear + mean).matrix(), wind.mean_speed,
          fmt::format("wind of {:.3g} m/s ({} model, {} spectrum)", wind.mean_speed,
                      plant::to_string(wind.model),
                      plant::to_string(plant::site_gusts(wind.site).kind))};
}

// Straight between the samples of the record. The gradient over the dish, which an anemometer does
// not see, is drawn from the site's spectrum at the record's mean speed.
WindCourse recorded_wind(const io::Case& antenna, const plant::WindRecord& record,
                         const design::WindCondition& wind, double gear, double interval,
                         std::uint64_t seed) {
  const plant::RecordTorqueOptions options{wind.model, false};
  const auto& pointing = antenna.antenna;
  const VectorXd torque =
      antenna.wind.torque_table && pointing.azimuth && pointing.elevation
          ? plant::wind_record_torque(record, wind.site, *antenna.wind.torque_table,
                                      {pointing.azimuth->value, pointing.elevation->value}, options)
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
    const double share = place - static_cast<double>(i);
    course.torque[k] += ((1.0 - share) * torque[i] + share * torque[i + 1]) / gear;
  }
  const double rms = std::sqrt((record.speed.array() - course.mean_speed).square().mean());
  course.description = fmt::format(
      "the measured wind {}, mean {:.3g} m/s, gusts {:.3g} m/s rms, sampled every "
      "{:.3g} s ({} model; the linear prediction takes its mean speed and the {} "
      "spectrum)",
      antenna.wind.record_path, course.mean_speed, rms, record.sample_time,
      plant::to_string(wind.model), plant::to_string(plant::site_gusts(wind.site).kind));
  return course;
}

}  // namespace

PositionRecord run_tracking(const io::Case& antenna, const SimulatedController& controller,
                            std::uint64_t seed, const RunProgress& progress) {
  constexpr double settle = 60.0;
  constexpr double measured = 600.0;
  const auto wind = make_problem(antenna).wind;
  const double gear = io::gear_ratio(antenna);
  const double interval = run_interval(antenna);
  const double rate = antenna.drive.tracking_rate.value * gear;
  const WindCourse gusts =
      antenna.wind.record ? recorded_wind(antenna, *antenna.wind.record, wind, gear, interval, seed)
                          : synthesised_wind(wind, gear, settle + measured, interval, seed);
  const Index samples = gusts.torque.size();
  Course course;
  course.mean_wind_speed = gusts.mean_speed;
  course.loop = {
      interval,
      VectorXd::LinSpaced(samples, 0.0, rate * interval * static_cast<double>(samples - 1)),
      VectorXd::Constant(samples, rate), VectorXd::Zero(samples), gusts.torque};
  const auto run = run_position_loop(antenna, controller, course, seed, progress);
  PositionRecord record = describe(antenna, run, course);
  judge(record, static_cast<Index>(std::llround(settle / interval)));
  record.predicted_rms = run.predicted_rms;
  record.test = "tracking";
  record.controller = controller.law;
  record.description = fmt::format("tracking at {:.3g} mdeg/s {} in {}",
                                   antenna.drive.tracking_rate.value / millidegree_at_sky,
                                   described(controller), gusts.description);
  return record;
}

PositionRecord run_slew(const io::Case& antenna, const SimulatedController& controller,
                        std::uint64_t seed, const RunProgress& progress) {
  constexpr double distance = 1.0 * degree;
  constexpr double still = 5.0;  // s before
  constexpr double hold = 60.0;  // s after
  const double gear = io::gear_ratio(antenna);
  const auto model = make_nonlinear_antenna(antenna);
  const double wanted = antenna.drive.slew_rate.value;
  const double attainable = design::attainable_rate(model, wanted * gear) / gear;
  const auto limits = design::within_reach(model, plant::reflected_inertia(make_plant(antenna)),
                                           {wanted * gear, largest_acceleration * gear});
  constexpr double longest = 3600.0;  // s
  if (!(limits.rate > 0.0) || !(limits.acceleration > 0.0) ||
      control::least_move_time(limits, distance * gear) >= longest) {
    throw InfeasibleRequirement(fmt::format(
        "{}: the supply cannot slew this antenna: against friction it holds {:.3g} deg/s",
        antenna.path, attainable / degree));
  }
  const double sample_time = controller_sample_time(antenna);
  const double moving = control::least_move_time(limits, distance * gear);
  const auto moved = static_cast<Index>(std::ceil((still + moving) / sample_time)) + 2;
  const auto samples = moved + static_cast<Index>(std::ceil(hold / sample_time));
  Course course;
  course.loop =
      design::shaped_course(limits, sample_time, samples, intervals_per_sample, [&](double t) {
        return control::CommandSample{t > still ? distance * gear : 0.0, 0.0, 0.0};
      });
  const auto run = run_position_loop(antenna, controller, course, seed, progress);
  const Index end = moved * intervals_per_sample;
  const double interval = course.loop.interval;
  PositionRecord record = describe(antenna, run, course);
  record.test = "slew";
  record.controller = controller.law;
  record.description =
      fmt::format("{:.3g} deg {} at up to {:.3g} deg/s and {:.2g} deg/s2", distance / degree,
                  described(controller), course.loop.reference_rate.maxCoeff() / (gear * degree),
                  limits.acceleration / (gear * degree));
  if (attainable < wanted) {
    record.description += fmt::format(
        "; the case's slew rate of {:.3g} deg/s is out of reach: against this friction the supply "
        "holds at most {:.3g} deg/s",
        wanted / degree, attainable / degree);
  }
  const VectorXd error = record.record.columns[2].values * millidegree_at_sky;
  if (end >= error.size()) return record;  // ended before the command did
  Index settled = end;
  for (Index k = end; k < error.size(); ++k) {
    if (std::abs(error[k]) > millidegree_at_sky) settled = k + 1;
  }
  record.overshoot = error.tail(error.size() - end).cwiseAbs().maxCoeff();
  constexpr double long_enough = 10.0;  // s within the bound
  if (static_cast<double>(error.size() - settled) * interval >= long_enough) {
    record.settling_time = interval * static_cast<double>(settled - end);
    judge(record, settled);
  }
  return record;
}

}  // namespace boresight::app
