#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/format.h>

#include <boresight/control/controllers/antenna_controller.hpp>
#include <boresight/design/verification/simulated_loop.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/nonlinear/antenna_channels.hpp>
#include <boresight/plant/nonlinear/operating_point.hpp>

namespace boresight::design {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// The antenna's channels with flows straight in the port's opening.
class StraightFlow final : public plant::NonlinearChannels {
 public:
  StraightFlow(std::shared_ptr<const plant::NonlinearChannels> rest, plant::ServoValve valve,
               double null_flow)
      : rest_(std::move(rest)), valve_(valve), null_flow_(null_flow) {}

  Index inputs() const override { return rest_->inputs(); }
  Index outputs() const override { return rest_->outputs(); }
  void evaluate(const Eigen::Ref<const VectorXd>& z, Eigen::Ref<VectorXd> n,
                Eigen::Ref<Eigen::MatrixXd> dn_dz) const override {
    using Channel = plant::AntennaChannels;
    rest_->evaluate(z, n, dn_dz);
    const double spool = z[Channel::spool];
    const numerics::ValueAndDerivative port =
        plant::port_opening(valve_, spool + valve_.null_offset);
    dn_dz.row(Channel::flow_1).setZero();
    dn_dz.row(Channel::flow_2).setZero();
    n[Channel::flow_1] = port.value - spool + null_flow_;
    n[Channel::flow_2] = spool - port.value + null_flow_;
    dn_dz(Channel::flow_1, Channel::spool) = port.derivative - 1.0;
    dn_dz(Channel::flow_2, Channel::spool) = 1.0 - port.derivative;
  }

 private:
  std::shared_ptr<const plant::NonlinearChannels> rest_;
  plant::ServoValve valve_;
  double null_flow_;
};

bool contains(std::span<const Influence> without, Influence influence) {
  return std::ranges::find(without, influence) != without.end();
}

plant::NonlinearAntenna antenna_without(const SimulatedLoop& loop, const LoopRunOptions& options) {
  plant::NonlinearAntenna antenna = loop.antenna;
  if (contains(options.without, Influence::friction)) {
    antenna.friction = {};
    antenna.viscous_friction = loop.linear.drive.viscous_friction;
  }
  if (contains(options.without, Influence::limits)) {
    antenna.valve.stroke_limit = std::numeric_limits<double>::infinity();
    antenna.valve.slew_limit = std::numeric_limits<double>::infinity();
  }
  if (contains(options.without, Influence::gear)) {
    antenna.gear.backlash = std::numeric_limits<double>::infinity();
  }
  return antenna;
}

// Where a run begins.
struct Start {
  VectorXd state;
  control::SteadyMotion motion;
  double encoder = 0.0;  // rad of motor
};

// With straight flows the spool carries what the orifice's square root took off.
void straighten(const plant::NonlinearAntenna& antenna, const plant::FeedbackSystem& orifice,
                plant::OperatingPoint& point) {
  const auto matrices = plant::feedback_matrices(orifice);
  const VectorXd z =
      matrices.channel_output * point.state + matrices.input_to_channels * point.input;
  VectorXd n(orifice.channel_outputs);
  Eigen::MatrixXd slope(orifice.channel_outputs, orifice.channel_inputs);
  orifice.channels->evaluate(z, n, slope);
  using Channel = plant::AntennaChannels;
  double& spool = point.state[plant::AntennaStates::spool];
  spool += 0.5 * (n[Channel::flow_1] - n[Channel::flow_2]) - antenna.valve.null_offset;
  point.input[0] = spool;
}

Start steady_start(const plant::NonlinearAntenna& antenna, const plant::FeedbackSystem& orifice,
                   const ReferenceTrajectory& course, bool straight) {
  const auto winds = static_cast<Index>(orifice.linear.inputs.size()) - orifice.channel_outputs - 1;
  VectorXd wind = VectorXd::Zero(winds);
  if (winds == 1) wind[0] = course.wind_torque[0];
  auto point = plant::trim(antenna, {course.reference_rate[0], 0.0, wind});
  const auto output = [&](const char* name) {
    return plant::output_index(orifice.linear, name) - orifice.channel_inputs;
  };
  const VectorXd seen = plant::observed(orifice, point.state, point.input);
  if (straight) straighten(antenna, orifice, point);
  return {point.state,
          {point.input[0], seen[output("tachometer")], seen[output("motor_torque")]},
          seen[output("encoder")]};
}

void check(const SimulatedLoop& loop, const ReferenceTrajectory& course) {
  const Index steps = course.reference.size();
  if (steps < 2 || course.reference_rate.size() != steps ||
      course.reference_acceleration.size() != steps || course.wind_torque.size() != steps) {
    throw InvalidInput(
        fmt::format("run_loop: expected references and wind torque of one length of at least 2, "
                    "found {}, {}, {} and {}",
                    steps, course.reference_rate.size(), course.reference_acceleration.size(),
                    course.wind_torque.size()));
  }
  if (!(loop.gear_ratio > 0.0) || !(loop.sample_time > 0.0) || !(course.interval > 0.0)) {
    throw InvalidInput(fmt::format(
        "run_loop: expected a gear ratio, sample time and interval above 0, found {}, {} s and {} "
        "s",
        loop.gear_ratio, loop.sample_time, course.interval));
  }
}

// Noise besides the rounding to steps of `resolution`, which is part of the noise of that rms.
double beyond_rounding(double rms, double resolution) {
  return std::sqrt(std::max(0.0, rms * rms - resolution * resolution / 12.0));
}

// Encoder, tachometer and torque as the controller samples them: the densities of the linear
// design up to half the sampling rate.
std::vector<plant::Sensor> sensors(const SimulatedLoop& loop, bool reads_torque, double sample_time,
                                   const LoopRunOptions& options, bool quantised) {
  const double folded = options.noise ? std::sqrt(0.5 / (sample_time * loop.noise.bandwidth)) : 0.0;
  std::vector<plant::Sensor> result(2);
  result[0].noise = folded * loop.noise.tachometer_rms;
  result[1].noise = folded * loop.noise.encoder_rms;
  if (quantised) {
    result[0].resolution = loop.tachometer_resolution;
    result[1].resolution = loop.encoder_resolution;
    for (auto& sensor : result) sensor.noise = beyond_rounding(sensor.noise, sensor.resolution);
  }
  if (reads_torque) {
    result.emplace_back();
    result.back().noise = folded * loop.noise.torque_rms;
  }
  return result;
}

void finish(LoopRun& run, const SimulatedLoop& loop, double interval) {
  const Index steps = run.result.values.rows();
  run.reference.conservativeResize(steps);
  run.boresight_error = (plant::column(run.result, "beam") -
                         plant::boresight_factor(loop.linear.structure) * run.reference) /
                        loop.gear_ratio;
  run.encoder_error = (plant::column(run.result, "encoder") - run.reference) / loop.gear_ratio;
  if (!run.result.complete) {
    run.status = RunStatus::interrupted;
    run.message = "interrupted";
    return;
  }
  for (Index k = 0; k < steps; ++k) {
    if (std::abs(run.encoder_error[k]) <= lost_error) continue;
    run.status = RunStatus::lost;
    run.message = fmt::format("the encoder is more than {:.3g} rad off after {:.3g} s", lost_error,
                              interval * static_cast<double>(k));
    return;
  }
}

}  // namespace

std::string_view to_string(Influence influence) {
  switch (influence) {
    case Influence::friction:
      return "friction";
    case Influence::limits:
      return "limits";
    case Influence::quantisation:
      return "quantisation";
    case Influence::orifice:
      return "orifice";
    case Influence::gear:
      return "gear";
  }
  throw InvalidInput("influence: not one of those there are");
}

std::string_view to_string(RunStatus status) {
  switch (status) {
    case RunStatus::complete:
      return "complete";
    case RunStatus::interrupted:
      return "interrupted";
    case RunStatus::lost:
      return "lost";
    case RunStatus::failed:
      return "failed";
  }
  throw InvalidInput("run status: not one of those there are");
}

SimulatedLoop make_simulated_loop(const TrackingProblem& problem,
                                  const plant::NonlinearAntenna& antenna,
                                  const control::Controller& controller) {
  SimulatedLoop loop;
  loop.antenna = antenna;
  loop.linear = problem.plant;
  loop.controller = controller;
  loop.gear_ratio = problem.gear_ratio;
  loop.sample_time = problem.delay / 1.5;
  loop.noise = problem.noise;
  return loop;
}

control::Feedforward feedforward_of(const SimulatedLoop& loop, std::span<const Influence> without) {
  if (!loop.feedforward) return {};
  const bool friction = !contains(without, Influence::friction);
  plant::AntennaPlant plant = loop.linear;
  if (friction) plant.drive.viscous_friction = 0.0;
  control::Feedforward forward =
      control::plant_feedforward(plant, loop.controller, 1.5 * loop.sample_time);
  if (friction) {
    plant::FrictionCurve curve = loop.stated_friction.value_or(loop.antenna.friction.curve);
    curve.viscous_friction += loop.antenna.viscous_friction;
    forward = control::with_friction(forward, plant, curve, loop.friction_feedforward);
  }
  if (!contains(without, Influence::orifice)) {
    forward.supply_torque = loop.antenna.oil.supply_torque - loop.antenna.oil.return_torque;
  }
  return forward;
}

bool has(const SimulatedLoop& loop, Influence influence) {
  switch (influence) {
    case Influence::quantisation:
      return loop.encoder_resolution > 0.0 || loop.tachometer_resolution > 0.0;
    case Influence::gear:
      return std::isfinite(loop.antenna.gear.backlash);
    case Influence::friction:
    case Influence::limits:
    case Influence::orifice:
      return true;
  }
  throw InvalidInput("influence: not one of those there are");
}

Index whole_samples(double duration, double sample_time) {
  return static_cast<Index>(std::llround(duration / sample_time));
}

ReferenceTrajectory shaped_course(
    const control::CommandLimits& limits, double sample_time, Index samples, Index steps,
    const std::function<control::CommandSample(double time)>& target) {
  if (samples < 1 || steps < 1) {
    throw InvalidInput(
        fmt::format("shaped_course: expected at least 1 sample of at least 1 step, found {} of {}",
                    samples, steps));
  }
  control::CommandSample start = target(0.0);
  start.rate = std::clamp(start.rate, -limits.rate, limits.rate);
  control::CommandPreprocessor command(limits, sample_time, start);
  ReferenceTrajectory course;
  course.interval = sample_time / static_cast<double>(steps);
  const Index all = samples * steps + 1;
  course.reference.resize(all);
  course.reference_rate.resize(all);
  course.reference_acceleration = course.wind_torque = VectorXd::Zero(all);
  for (Index k = 0; k < samples; ++k) {
    const control::CommandSample before = command.now();
    const auto wanted = target(sample_time * static_cast<double>(k + 1));
    const double acceleration = command.advance(wanted.angle, wanted.rate).acceleration;
    for (Index step = 0; step < steps; ++step) {
      const double t = course.interval * static_cast<double>(step);
      course.reference[k * steps + step] =
          before.angle + t * (before.rate + 0.5 * t * acceleration);
      course.reference_rate[k * steps + step] = before.rate + t * acceleration;
      course.reference_acceleration[k * steps + step] = acceleration;
    }
  }
  course.reference[all - 1] = command.now().angle;
  course.reference_rate[all - 1] = command.now().rate;
  return course;
}

LoopRun run_loop(const SimulatedLoop& loop, const ReferenceTrajectory& course,
                 const LoopRunOptions& options) {
  check(loop, course);
  const bool straight = contains(options.without, Influence::orifice);
  const bool limited = !contains(options.without, Influence::limits);
  const auto antenna = antenna_without(loop, options);
  control::AntennaControllerOptions controller_options;
  controller_options.anti_windup = loop.anti_windup;
  if (limited) controller_options.command_limit = loop.antenna.valve.stroke_limit;
  controller_options.feedforward = feedforward_of(loop, options.without);
  control::AntennaController own(loop.controller, loop.sample_time, controller_options);
  control::StartedController& controller =
      options.controller != nullptr ? *options.controller : own;
  plant::FeedbackSystem system = plant::to_feedback_system(antenna);
  LoopRun run;
  plant::SimulationPlan plan;
  VectorXd reference = course.reference;
  try {
    const Start start = steady_start(antenna, system, course, straight);
    plan.state = start.state;
    const double lead = controller.start_from(start.motion);
    reference.array() += start.encoder - lead - course.reference[0];
  } catch (const NumericalFailure& failure) {
    run.status = RunStatus::failed;
    run.message = fmt::format(
        "no steady motion to start from at {:.3g} rad/s of motor against {:.4g} N m of "
        "wind: {}",
        course.reference_rate[0], course.wind_torque[0], failure.what());
    return run;
  }
  if (straight) {
    const auto& oil = antenna.oil;
    system.channels = std::make_shared<StraightFlow>(
        system.channels, antenna.valve, oil.null_leakage * (oil.supply_torque + oil.return_torque));
  }
  plan.interval = course.interval;
  plan.signals = {"reference", "reference_rate", "reference_acceleration", "wind_torque"};
  plan.values.resize(reference.size(), 4);
  plan.values << reference, course.reference_rate, course.reference_acceleration,
      course.wind_torque;
  plan.controller = &controller;
  plan.computation_delay = loop.sample_time;
  plan.sensors = sensors(loop, loop.controller.structure.feeds_torque_back(), loop.sample_time,
                         options, !contains(options.without, Influence::quantisation));
  plan.seed = options.seed;
  plan.integrator = options.integrator;
  plan.relative_tolerance = options.relative_tolerance;
  plan.absolute_tolerance = VectorXd::Constant(1, options.absolute_tolerance);
  plan.progress = options.progress;
  try {
    run.result = plant::simulate(system, plan);
  } catch (const NumericalFailure& failure) {
    run.status = RunStatus::failed;
    run.message = failure.what();
    return run;
  }
  run.reference = std::move(reference);
  finish(run, loop, course.interval);
  return run;
}

LoopRun run_linear_loop(const SimulatedLoop& loop, const ReferenceTrajectory& course, int finer,
                        const LoopRunOptions& options) {
  check(loop, course);
  if (finer < 1) {
    throw InvalidInput(fmt::format(
        "run_linear_loop: expected a sampling at least 1 times as fine, found {}", finer));
  }
  // The wind straight between its steps, the loop's clock a whole number of steps.
  const double sample_time = loop.sample_time / static_cast<double>(finer);
  const double delay = 1.5 * loop.sample_time - 0.5 * sample_time;
  const double step = finer == 1 ? course.interval : std::min(course.interval, 0.5 * sample_time);
  const auto parts = whole_samples(course.interval, step);
  const Index steps = (course.wind_torque.size() - 1) * parts + 1;
  control::AntennaController controller(loop.controller, sample_time);
  plant::SimulationPlan plan;
  plan.interval = course.interval / static_cast<double>(parts);
  plan.signals = {"reference", "reference_rate", "reference_acceleration", "wind_torque"};
  plan.values = Eigen::MatrixXd::Zero(steps, 4);
  for (Index k = 0; k < steps; ++k) {
    const Index i = k / parts;
    const double fraction = static_cast<double>(k % parts) / static_cast<double>(parts);
    double torque = course.wind_torque[i];
    if (k % parts != 0) torque += fraction * (course.wind_torque[i + 1] - torque);
    plan.values(k, 3) = torque - course.wind_torque[0];
  }
  plan.controller = &controller;
  plan.computation_delay = delay;
  plan.sensors =
      sensors(loop, loop.controller.structure.feeds_torque_back(), sample_time, options, false);
  plan.seed = options.seed;
  plan.integrator = options.integrator;
  plan.relative_tolerance = options.relative_tolerance;
  plan.absolute_tolerance = VectorXd::Constant(1, options.absolute_tolerance);
  plan.progress = options.progress;
  LoopRun run;
  try {
    run.result = plant::simulate({plant::to_state_space(loop.linear), 0, 0, nullptr}, plan);
  } catch (const NumericalFailure& failure) {
    run.status = RunStatus::failed;
    run.message = failure.what();
    return run;
  }
  // At the course's steps.
  if (parts > 1) {
    const Index kept = (run.result.values.rows() - 1) / parts + 1;
    Eigen::MatrixXd thinned(kept, run.result.values.cols());
    for (Index k = 0; k < kept; ++k) thinned.row(k) = run.result.values.row(k * parts);
    run.result.values = std::move(thinned);
  }
  run.reference = VectorXd::Zero(course.reference.size());
  finish(run, loop, course.interval);
  return run;
}

}  // namespace boresight::design
