#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <utility>

#include <Eigen/QR>

#include <boresight/control/controllers/antenna_controller.hpp>
#include <boresight/control/controllers/sampled_controller.hpp>
#include <boresight/design/commissioning/stage_quantities.hpp>
#include <boresight/design/commissioning/stage_record.hpp>
#include <boresight/design/commissioning/stage_simulation.hpp>
#include <boresight/design/problem/drive_capability.hpp>
#include <boresight/design/problem/standstill.hpp>
#include <boresight/design/verification/simulated_loop.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/plant/nonlinear/nonlinear_drive.hpp>

namespace boresight::design {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr Index intervals = 1;  // in a sample; the integration takes shorter steps by its tolerance

std::vector<std::string> inputs_with_references(bool torque) {
  std::vector<std::string> inputs{"tachometer", "encoder"};
  if (torque) inputs.emplace_back("motor_torque");
  for (const char* one : {"reference", "reference_rate", "reference_acceleration"}) {
    inputs.emplace_back(one);
  }
  return inputs;
}

// The rate loop alone: its command is the reference's rate.
class RateController final : public control::StartedController {
 public:
  RateController(const control::Controller& controller, double sample_time, double limit)
      : system_(control::sampled_rate_loop_controller(controller, sample_time)),
        limit_(limit),
        inputs_(inputs_with_references(controller.structure.feeds_torque_back())),
        outputs_{"valve_command"},
        reads_torque_(controller.structure.feeds_torque_back()) {
    initial_ = state_ = VectorXd::Zero(system_.a.rows());
  }
  double sample_time() const override { return system_.sample_time; }
  const std::vector<std::string>& inputs() const override { return inputs_; }
  const std::vector<std::string>& outputs() const override { return outputs_; }
  void restart() override { state_ = initial_; }
  void update(double /*time*/, const Eigen::Ref<const VectorXd>& measured,
              Eigen::Ref<VectorXd> commands) override {
    const VectorXd input =
        in(measured[0] - measured[reads_torque_ ? 4 : 3], reads_torque_ ? measured[2] : 0.0);
    commands[0] =
        std::clamp(system_.c.row(0).dot(state_) + system_.d.row(0).dot(input), -limit_, limit_);
    state_ = (system_.a * state_ + system_.b * input).eval();
  }
  double start_from(const control::SteadyMotion& motion) override {
    const Index states = system_.a.rows();
    const VectorXd input = in(0.0, motion.motor_torque);
    Eigen::MatrixXd equations(states + 1, states);
    equations << Eigen::MatrixXd::Identity(states, states) - system_.a, system_.c;
    VectorXd right(states + 1);
    right << system_.b * input, motion.valve_command - system_.d.row(0).dot(input);
    initial_ = equations.completeOrthogonalDecomposition().solve(right);
    restart();
    return 0.0;
  }

 private:
  VectorXd in(double rate, double torque) const {
    VectorXd input(static_cast<Index>(system_.inputs.size()));
    for (Index i = 0; i < input.size(); ++i) {
      input[i] = system_.inputs[static_cast<std::size_t>(i)] == "motor_torque" ? torque : rate;
    }
    return input;
  }

  plant::StateSpace system_;
  double limit_;
  std::vector<std::string> inputs_, outputs_;
  bool reads_torque_;
  VectorXd initial_, state_;
};

// A controller behind signals of other scales, with a recorder of what it reads and commands.
class RecordedController final : public control::StartedController {
 public:
  enum Column : std::size_t { tachometer, encoder, reference, reference_rate, valve, columns };

  RecordedController(control::StartedController& controller, const SignalFactors& factors)
      : controller_(controller),
        factors_(factors),
        reads_torque_(std::ranges::count(controller.inputs(), "motor_torque") > 0) {}
  double sample_time() const override { return controller_.sample_time(); }
  const std::vector<std::string>& inputs() const override { return controller_.inputs(); }
  const std::vector<std::string>& outputs() const override { return controller_.outputs(); }
  void restart() override {
    controller_.restart();
    rows_.clear();
    start_.reset();
  }
  void update(double time, const Eigen::Ref<const VectorXd>& measured,
              Eigen::Ref<VectorXd> commands) override {
    VectorXd seen = measured;
    seen[0] *= factors_.tachometer;
    if (!start_) start_ = measured[1];
    seen[1] = *start_ + factors_.encoder * (measured[1] - *start_);
    if (reads_torque_) seen[2] *= factors_.torque;
    controller_.update(time, seen, commands);
    const Index references = reads_torque_ ? 3 : 2;
    rows_.push_back({seen[0], seen[1], seen[references], seen[references + 1], commands[0]});
    commands[0] *= factors_.valve;
  }
  double start_from(const control::SteadyMotion& motion) override {
    control::SteadyMotion seen = motion;
    seen.tachometer *= factors_.tachometer;
    seen.motor_torque *= factors_.torque;
    seen.valve_command /= factors_.valve;
    return controller_.start_from(seen);
  }
  Index samples() const { return static_cast<Index>(rows_.size()); }
  VectorXd column(Column place) const {
    VectorXd values(samples());
    for (Index k = 0; k < values.size(); ++k) values[k] = rows_[static_cast<std::size_t>(k)][place];
    return values;
  }

 private:
  control::StartedController& controller_;
  SignalFactors factors_;
  bool reads_torque_;
  std::optional<double> start_;  // rad of motor
  std::vector<std::array<double, columns>> rows_;
};

constexpr double still_time = 100.0;  // s

double slowest_settling(const StageExpectation& expected) {
  const double settled = expected.settling_time.upper;
  return std::max(std::isfinite(settled) ? 1.5 * settled : 0.0, 5.0 * expected.rise_time.upper);
}

ReferenceTrajectory steady_motion(double base_rate, Index samples, double sample_time) {
  ReferenceTrajectory course;
  course.interval = sample_time / static_cast<double>(intervals);
  const Index count = samples * intervals + 1;
  course.reference =
      VectorXd::LinSpaced(count, 0.0, base_rate * sample_time * static_cast<double>(samples));
  course.reference_rate = VectorXd::Constant(count, base_rate);
  course.reference_acceleration = course.wind_torque = VectorXd::Zero(count);
  return course;
}

ReferenceTrajectory still_course(const StageExperiment& experiment, double sample_time) {
  return steady_motion(experiment.base_rate,
                       whole_samples(experiment.step_time + still_time, sample_time), sample_time);
}

// The motion, a step up, and down again.
ReferenceTrajectory step_course(const CommissioningStage& stage, const StageExperiment& experiment,
                                double sample_time) {
  const Index samples = whole_samples(experiment.step_time, sample_time);
  auto course = steady_motion(experiment.base_rate, 3 * samples, sample_time);
  VectorXd& stepped = stage.controller.position_open ? course.reference_rate : course.reference;
  stepped.segment(samples * intervals, samples * intervals).array() += experiment.step;
  return course;
}

// The motion, the move, and the motion again.
ReferenceTrajectory move_course(const CommissioningStage& stage, const StageExperiment& experiment,
                                double sample_time) {
  const CommandedMove& move = experiment.move;
  const double ramp = move.rate / move.acceleration;
  const double wait = 30.0 / stage.expected.crossover.nominal;
  const double moved = 3.0 * ramp + 2.0 * wait;
  const double before = std::max(0.5 * moved, experiment.step_time);
  auto course =
      steady_motion(experiment.base_rate, whole_samples(before + moved, sample_time), sample_time);
  const double end = 2.0 * ramp + wait;
  for (Index k = 0; k < course.reference.size(); ++k) {
    const double t = course.interval * static_cast<double>(k) - before;
    const double up = std::clamp(t, 0.0, ramp);
    const double down = std::clamp(t - end, 0.0, ramp);
    course.reference_rate[k] += move.acceleration * (up - down);
    course.reference_acceleration[k] =
        move.acceleration *
        ((t >= 0.0 && t < ramp ? 1.0 : 0.0) - (t >= end && t < end + ramp ? 1.0 : 0.0));
    course.reference[k] +=
        move.acceleration * (0.5 * up * up + ramp * std::max(0.0, t - ramp) - 0.5 * down * down -
                             ramp * std::max(0.0, t - end - ramp));
  }
  return course;
}

SimulatedLoop loop_of_stage(const Mission& mission, const CommissioningStage& stage,
                            const StageSimulationOptions& options) {
  const TrackingProblem stated = tracking_problem(mission);
  auto loop = make_simulated_loop(
      stated, plant::nonlinear_antenna(plant::changed(mission.antenna, options.changes)),
      stage.controller.controller);
  loop.encoder_resolution = encoder_step(mission.antenna) * stated.gear_ratio;
  loop.feedforward = stage.controller.feedforward;
  auto& curve = loop.antenna.friction.curve;
  loop.stated_friction = plant::nonlinear_antenna(mission.antenna).friction.curve;
  for (double* torque : {&curve.coulomb_torque, &curve.breakaway_torque, &curve.saturating_torque,
                         &curve.viscous_friction}) {
    *torque *= options.friction;
  }
  return loop;
}

// Two digits in mdeg/s.
double rounded(double rate, double gear_ratio) {
  const double unit = gear_ratio * millidegree;
  const double digit = std::pow(10.0, std::floor(std::log10(rate / unit)) - 1.0);
  return std::round(rate / (unit * digit)) * unit * digit;
}

// At the controller's samples, with the noise that the sensor folds into them.
VectorXd recorded_torque(const LoopRun& run, const SimulatedLoop& loop, Index samples,
                         const StageSimulationOptions& options) {
  VectorXd torque = VectorXd::Zero(samples);
  if (run.status == RunStatus::failed) return torque;
  const VectorXd shown = plant::column(run.result, "motor_torque");
  std::mt19937_64 numbers(options.seed);
  std::normal_distribution<double> normal(
      0.0, loop.noise.torque_rms * std::sqrt(0.5 / (loop.sample_time * loop.noise.bandwidth)));
  for (Index k = 0; k < samples; ++k) {
    torque[k] = shown[std::min(k * intervals, shown.size() - 1)];
    if (options.noise) torque[k] += normal(numbers);
  }
  return options.factors.torque * torque;
}

const MeasuredQuantity* found_in(const StageMeasurement& measurement, StageQuantity quantity) {
  const auto found =
      std::ranges::find(measurement.quantities, quantity, &MeasuredQuantity::quantity);
  return found == measurement.quantities.end() ? nullptr : &*found;
}

}  // namespace

StageExperiment stage_experiment(const Mission& mission, const CommissioningStage& stage,
                                 double step, const CommandedMove& move) {
  constexpr double of_slew = 0.2;
  constexpr double of_attainable = 0.5;
  constexpr double rise_times = 3.0;
  const double gear = plant::gear_ratio(mission.antenna);
  const double slew = plant::sky_to_motor(mission.antenna, mission.antenna.drive.slew_rate);
  const double attainable = attainable_rate(plant::nonlinear_antenna(mission.antenna), slew);
  StageExperiment experiment;
  experiment.step = step;
  experiment.move = move;
  experiment.step_time = slowest_settling(stage.expected);
  double on_top = 0.0;
  if (stage.controller.feedforward) {
    experiment.base_rate = on_top = move.rate;
  } else if (stage.controller.position_open) {
    experiment.base_rate = on_top = step;
  } else {
    experiment.base_rate = rise_times * step / stage.expected.rise_time.nominal;
  }
  experiment.base_rate =
      std::min({experiment.base_rate, of_slew * slew, of_attainable * attainable - on_top});
  experiment.base_rate = experiment.base_rate > 0.0 ? rounded(experiment.base_rate, gear) : 0.0;
  return experiment;
}

FlowModel flow_model(const Mission& mission) {
  constexpr double periods = 3.0;
  const auto antenna = plant::nonlinear_antenna(mission.antenna);
  const TrackingProblem problem = tracking_problem(mission);
  const plant::Drive& drive = problem.plant.drive;
  const double period =
      two_pi * std::sqrt(plant::reflected_inertia(problem.plant) / drive.oil_stiffness);
  return {antenna.oil.supply_torque - antenna.oil.return_torque,
          problem.delay + 2.0 * drive.valve_damping / drive.valve_corner,
          1.0 / drive.tachometer_corner, periods * period};
}

identification::ServoRecord simulate_stage(const Mission& mission, const CommissioningStage& stage,
                                           const StageExperiment& experiment,
                                           const StageSimulationOptions& options) {
  const auto loop = loop_of_stage(mission, stage, options);
  const bool still = options.part == ExperimentPart::still_air;
  ReferenceTrajectory course;
  if (still) {
    course = still_course(experiment, loop.sample_time);
  } else if (stage.controller.feedforward) {
    course = move_course(stage, experiment, loop.sample_time);
  } else {
    course = step_course(stage, experiment, loop.sample_time);
  }
  control::AntennaControllerOptions controller_options;
  controller_options.command_limit = loop.antenna.valve.stroke_limit;
  controller_options.feedforward = feedforward_of(loop);
  control::AntennaController whole(loop.controller, loop.sample_time, controller_options);
  RateController rate(loop.controller, loop.sample_time, controller_options.command_limit);
  control::StartedController* acting = &whole;
  if (stage.controller.position_open) acting = &rate;
  RecordedController recorded(*acting, options.factors);
  LoopRunOptions run_options;
  run_options.noise = options.noise;
  run_options.seed = options.seed;
  run_options.controller = &recorded;
  const LoopRun run = run_loop(loop, course, run_options);
  const bool integrated = run.status != RunStatus::failed;
  const Index unsettled = still ? whole_samples(experiment.step_time, loop.sample_time) : 0;
  const Index kept = integrated ? std::max<Index>(recorded.samples() - unsettled, 0) : 0;
  const auto signal = [&](RecordedController::Column column, double origin, double scale) {
    return identification::Signal{
        ((recorded.column(column).tail(kept).array() - origin) * scale).matrix(), {}};
  };
  identification::ServoRecord record;
  record.name = "simulated";
  record.sample_time = loop.sample_time;
  using enum RecordedController::Column;
  record.motor_rate = signal(tachometer, 0.0, 1.0);
  record.valve_command = signal(valve, 0.0, 1.0);
  record.motor_torque = identification::Signal{
      recorded_torque(run, loop, recorded.samples(), options).tail(kept), {}};
  if (stage.controller.position_open) {
    record.rate_command = signal(reference_rate, 0.0, 1.0);
  } else {
    const double sky = 1.0 / loop.gear_ratio;
    const double origin = kept > 0 ? recorded.column(reference)[0] : 0.0;
    record.position_command = signal(reference, origin, sky);
    record.encoder = signal(encoder, origin, sky);
    record.position_error =
        identification::Signal{record.position_command->values - record.encoder->values, {}};
  }
  return record;
}

std::vector<ExperimentEffect> experiment_effects(const Mission& mission,
                                                 const CommissioningStage& stage,
                                                 const StageExperiment& experiment) {
  const bool steps = !stage.controller.feedforward;
  if (!stage.expected.all_stable() || (steps && !std::isfinite(experiment.step))) return {};
  // What is fed forward is least wrong where the friction is as large as that.
  const std::array frictions{1.0, 1.0 - friction_allowance, SimulatedLoop{}.friction_feedforward,
                             1.0 + friction_allowance};
  std::array<StageMeasurement, 4> shown;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    StageSimulationOptions options;
    options.friction = frictions.at(i);
    options.noise = false;
    const auto record = simulate_stage(mission, stage, experiment, options);
    if (record.motor_rate->values.size() > 0) {
      shown.at(i) = measure_stage(record, stage, plant::gear_ratio(mission.antenna));
    }
  }
  std::vector<ExperimentEffect> effects;
  for (const StageQuantity quantity : measured_quantities(stage)) {
    if (is_rms(quantity)) continue;
    const double linear = expected_of(quantity, stage.expected).nominal;
    std::array<double, 4> effect{};
    for (std::size_t i = 0; i < shown.size(); ++i) {
      const MeasuredQuantity* one = found_in(shown.at(i), quantity);
      effect.at(i) = one == nullptr ? std::numeric_limits<double>::quiet_NaN()
                     : quantity == StageQuantity::overshoot ? one->value - linear
                                                            : one->value / linear;
    }
    const bool all = std::ranges::all_of(effect, [](double one) { return std::isfinite(one); });
    const auto [least, largest] = std::ranges::minmax(effect);
    effects.push_back(all ? ExperimentEffect{quantity, effect[0], least, largest}
                          : ExperimentEffect{quantity, effect[0],
                                             std::numeric_limits<double>::quiet_NaN(),
                                             std::numeric_limits<double>::quiet_NaN()});
  }
  return effects;
}

}  // namespace boresight::design
