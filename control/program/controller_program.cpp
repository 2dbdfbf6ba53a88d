#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include <boresight/control/program/controller_program.hpp>
#include <boresight/control/program/feedback_statements.hpp>
#include <boresight/control/program/feedforward_statements.hpp>
#include <boresight/control/program/preprocessor_statements.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::control::program {
namespace {

constexpr double degrees = 180.0 / std::numbers::pi;
// Beyond these a target is no position or rate of an antenna, and a command no number.
constexpr double largest_target = 1e4;   // deg, deg/s
constexpr double largest_command = 1e9;  // rad/s
// A manual command beyond so many times the full stroke is no command.
constexpr double manual_factor = 10.0;
// While running, an encoder that jumps by more than the largest rate makes in so many samples has
// lost its reading.
constexpr double movement_samples = 25.0;
// Of the command's limit: below such a rate the motors rest, but for the tachometer's noise.
constexpr double rest_fraction = 1e-3;

void require_positive(const char* what, double value) {
  if (value > 0.0 && std::isfinite(value)) return;
  throw InvalidInput(
      fmt::format("controller program: expected a positive finite {}, found {}", what, value));
}

void validate(const ControllerProgramOptions& options) {
  const ComputerSignals& signals = options.signals;
  require_positive("command limit", options.command_limit);
  require_positive("gear ratio", options.gear_ratio);
  require_positive("rate limit", options.limits.rate);
  require_positive("acceleration limit", options.limits.acceleration);
  require_positive("tachometer scale", signals.tachometer.scale);
  require_positive("motor torque scale", signals.motor_torque.scale);
  require_positive("valve command scale", signals.valve_command.scale);
  require_positive("largest rate", signals.largest_rate);
  require_positive("largest torque", signals.largest_torque);
  if (signals.encoder_counts < 2 ||
      signals.encoder_counts > std::numeric_limits<std::int32_t>::max() ||
      !std::isfinite(signals.encoder_zero) || !std::isfinite(signals.encoder_centre)) {
    throw InvalidInput(fmt::format(
        "controller program: expected 2 to 2147483647 encoder counts and finite angles, found {}",
        signals.encoder_counts));
  }
}

class ProgramWriter {
 public:
  ProgramWriter(const Controller& controller, double sample_time,
                const ControllerProgramOptions& options)
      : options_(options),
        builder_(fmt::format("Antenna servo controller: {}", controller.structure.name()),
                 sample_time),
        reads_torque_(controller.structure.feeds_torque_back()),
        is_state_space_(controller.structure.state_space() != nullptr) {
    // Checks controller and options, and finds the fraction of back calculation that is stable.
    const AntennaController checked(
        controller, sample_time,
        {.feedforward = options.feedforward, .command_limit = options.command_limit});
    declare_inputs();
    declare_parameters(sample_time);
    using MotionTorque = FeedforwardStatements::MotionTorque;
    feedforward_.emplace(builder_, options.feedforward, sample_time,
                         !reads_torque_    ? MotionTorque::unused
                         : is_state_space_ ? MotionTorque::whole
                                           : MotionTorque::friction_only);
    feedback_ =
        is_state_space_
            ? state_space_feedback(builder_, *controller.structure.state_space())
            : loop_feedback(builder_, controller, sample_time, checked.back_calculation_fraction());
  }

  Program write() {
    builder_.note(
        "Call the step once per sample time with samples taken now; put valve_command out at the "
        "next sample.");
    builder_.note(
        "target_angle and target_rate are those of the next sample. A target that jumps is "
        "approached within the limits of rate and acceleration.");
    builder_.note(
        "run false: standby, the valve follows manual_command. run true: the loop takes over with "
        "the valve command as it is.");
    builder_.note(
        "fault other than 0: valve_command is 0, the safe output. A fault is not latched: the next "
        "good sample is a start. Latch it outside if the antenna must stay stopped.");
    builder_.note(
        "encoder_error is 0 unless running. On source: running, and position near the target.");
    builder_.note(
        "Encoder, tachometer, pressure difference and valve command have the same positive "
        "direction: check every sign in standby before the loop is closed.");
    builder_.note(
        "The watchdog needs comparisons with NaN to be false, as IEEE 754 has it: no compiler "
        "option such as -ffast-math.");
    builder_.remark("Counts since the last good sample, across the wrap of the encoder.");
    unwrap();
    builder_.remark("Inputs out of range or not finite: valve command 0.");
    builder_.assign(demand_, zero_);
    builder_.assign(error_, wide_number(0.0));
    builder_.assign(running_, no_);
    check_inputs();
    builder_.begin_if(complement(good_));
    builder_.assign(fault_, constant(1.0, Type::integer));
    builder_.assign(started_, no_);
    builder_.otherwise();
    builder_.assign(fault_, constant(0.0, Type::integer));
    read_sensors();
    builder_.begin_if(complement(run_));
    builder_.remark("Standby: the valve follows the manual command, the reference the axis.");
    builder_.assign(started_, no_);
    builder_.assign(demand_, manual_ / valve_scale_);
    preprocessor_->rest(builder_, last_position_);
    builder_.otherwise();
    control();
    builder_.end_if();
    builder_.remark("A command that is not finite.");
    builder_.begin_if(complement(absolute(demand_) <= largest_demand_));
    builder_.assign(fault_, constant(2.0, Type::integer));
    builder_.assign(started_, no_);
    builder_.assign(running_, no_);
    builder_.assign(demand_, zero_);
    builder_.assign(error_, wide_number(0.0));
    builder_.end_if();
    builder_.end_if();
    builder_.assign(command_, limited(demand_, command_limit_));
    builder_.assign(valve_command_, command_ * valve_scale_);
    builder_.assign(position_, last_position_);
    builder_.assign(encoder_error_, error_);
    builder_.assign(reference_, preprocessor_->angle());
    builder_.assign(reference_rate_, preprocessor_->rate());
    return builder_.finish();
  }

 private:
  void declare_inputs() {
    const ComputerSignals& signals = options_.signals;
    run_ = builder_.input("run", Type::boolean, "", "close the loop; else standby");
    target_angle_ = builder_.input("target_angle", Type::wide, "deg",
                                   "where the axis is to be at the next sample");
    target_rate_ = builder_.input("target_rate", Type::wide, "deg/s", "of the target then");
    manual_ = builder_.input("manual_command", Type::real, signals.valve_command.unit,
                             "valve command in standby");
    counts_ = builder_.input("encoder_counts", Type::integer, "counts", "absolute, in one turn");
    tachometer_ =
        builder_.input("tachometer", Type::real, signals.tachometer.unit, "rate of the motors");
    if (reads_torque_) {
      torque_ = builder_.input("pressure_difference", Type::real, signals.motor_torque.unit,
                               "between the motors' ports, mean of all motors");
    }
    valve_command_ = builder_.output("valve_command", Type::real, signals.valve_command.unit,
                                     "to be put out at the next sample");
    fault_ = builder_.output("fault", Type::integer, "",
                             "0 none, 1 input out of range or not finite, 2 command not finite; "
                             "valve_command is then 0, the safe output");
    running_ = builder_.output("running", Type::boolean, "", "the loop is closed");
    position_ = builder_.output("position", Type::wide, "deg", "of the axis, by its encoder");
    encoder_error_ = builder_.output("encoder_error", Type::wide, "deg",
                                     "encoder less reference; 0 unless running");
    reference_ = builder_.output("reference", Type::wide, "deg", "command at the next sample");
    reference_rate_ =
        builder_.output("reference_rate", Type::wide, "deg/s", "command at the next sample");
  }

  Expression wide(const char* name, double value, const char* unit, const char* comment) {
    return builder_.parameter(name, Type::wide, value, unit, comment);
  }
  Expression real(const char* name, double value, const std::string& unit, const char* comment) {
    return builder_.parameter(name, Type::real, value, unit, comment);
  }

  void declare_parameters(double sample_time) {
    const ComputerSignals& signals = options_.signals;
    const auto counts = static_cast<double>(signals.encoder_counts);
    sample_time_ = wide("sample_time", sample_time, "s", "of every call");
    counts_per_turn_ =
        builder_.parameter("counts_per_turn", Type::integer, counts, "counts", "of the encoder");
    degrees_per_count_ = wide("degrees_per_count", 360.0 / counts, "deg", "of the encoder");
    encoder_zero_ =
        wide("encoder_zero", signals.encoder_zero * degrees, "deg", "angle of the axis at count 0");
    encoder_centre_ = wide("encoder_centre", signals.encoder_centre * degrees, "deg",
                           "middle of the travel: the turn at the start is nearest to it");
    motor_per_degree_ = wide("motor_angle_per_degree", options_.gear_ratio / degrees, "rad/deg",
                             "gear ratio times pi/180");
    rate_per_tachometer_ =
        real("rate_per_tachometer", 1.0 / signals.tachometer.scale,
             fmt::format("rad/s per {}", signals.tachometer.unit), "rate of the motors");
    if (reads_torque_) {
      torque_per_signal_ =
          real("torque_per_pressure", 1.0 / signals.motor_torque.scale,
               fmt::format("N.m per {}", signals.motor_torque.unit), "torque of all motors");
    }
    valve_scale_ = real("valve_scale", signals.valve_command.scale,
                        fmt::format("{} per rad/s", signals.valve_command.unit),
                        "valve command per no-load rate of the motors");
    command_limit_ = real("command_limit", options_.command_limit, "rad/s",
                          "largest magnitude of the valve command");
    largest_tachometer_ =
        real("largest_tachometer", signals.largest_rate * signals.tachometer.scale,
             signals.tachometer.unit, "a fault beyond");
    if (reads_torque_) {
      largest_torque_ =
          real("largest_pressure_difference", signals.largest_torque * signals.motor_torque.scale,
               signals.motor_torque.unit, "a fault beyond");
    }
    largest_manual_ = real("largest_manual_command",
                           manual_factor * options_.command_limit * signals.valve_command.scale,
                           signals.valve_command.unit, "a fault beyond, in standby");
    largest_movement_ = wide("largest_movement",
                             movement_samples * sample_time * signals.largest_rate /
                                 options_.gear_ratio / (2.0 * std::numbers::pi) * counts,
                             "counts", "since the last good sample; a fault beyond, while running");
    start_rest_rate_ = real("start_rest_rate", rest_fraction * options_.command_limit, "rad/s",
                            "a rate of the motors below is rest at the start");
    largest_target_ = wide("largest_target", largest_target, "deg, deg/s", "a fault beyond");
    largest_demand_ = real("largest_demand", largest_command, "rad/s", "a fault beyond");
    preprocessor_.emplace(builder_, options_.limits.rate * degrees,
                          options_.limits.acceleration * degrees, sample_time_);
    started_ =
        builder_.state("started", Type::boolean, "", "the loop was closed at the last sample");
    encoder_known_ = builder_.state("encoder_known", Type::boolean, "", "the turn is known");
    last_counts_ =
        builder_.state("last_counts", Type::wide, "counts", "encoder's at the last sample");
    last_position_ =
        builder_.state("last_position", Type::wide, "deg", "of the axis at the last good sample");
    turns_ = builder_.state("turns", Type::wide, "", "whole turns from the encoder's zero");
    command_ = builder_.state("command", Type::real, "rad/s", "valve command of the last sample");
    demand_ = builder_.local("demand", Type::real, "rad/s", "valve command before its limit");
    error_ = builder_.local("position_error", Type::wide, "deg", "encoder less reference");
    moved_ = builder_.local("moved", Type::wide, "counts", "since the last sample");
    rate_ = builder_.local("rate", Type::real, "rad/s", "of the motors, by the tachometer");
    if (reads_torque_) {
      measured_torque_ = builder_.local("measured_torque", Type::real, "N.m", "of all motors");
      excess_torque_ = builder_.local("excess_torque", Type::real, "N.m",
                                      "measured torque less that of the commanded motion");
    }
    wrapped_ = builder_.local("wrapped", Type::wide, "", "turns since the last sample");
    good_ = builder_.local("good", Type::boolean, "", "the inputs can be used");
    start_rate_ = builder_.local("start_rate", Type::real, "rad/s", "of the motors at the start");
    motor_rate_ = builder_.local("motor_rate", Type::real, "rad/s", "commanded, at this sample");
    motor_acceleration_ = builder_.local("motor_acceleration", Type::real, "rad/s2", "commanded");
    next_motor_rate_ =
        builder_.local("next_motor_rate", Type::real, "rad/s", "commanded, at the next sample");
    angle_error_ = builder_.local("angle_error", Type::real, "rad", "of the motors");
    cut_ = builder_.local("cut", Type::real, "rad/s", "what the limit takes off the command");
  }

  Expression within(const Expression& value, const Expression& largest) const {
    return absolute(value) <= largest;
  }

  static Expression wide_number(double value) { return constant(value, Type::wide); }

  void unwrap() {
    const Expression half = wide_number(0.5) * to_wide(counts_per_turn_);
    builder_.assign(moved_, to_wide(counts_) - last_counts_);
    builder_.assign(wrapped_, wide_number(0.0));
    builder_.begin_if(half < moved_);
    builder_.assign(wrapped_, wide_number(-1.0));
    builder_.end_if();
    builder_.begin_if(moved_ < -half);
    builder_.assign(wrapped_, wide_number(1.0));
    builder_.end_if();
    builder_.assign(moved_, moved_ + wrapped_ * to_wide(counts_per_turn_));
  }

  void check_inputs() {
    Expression sensors = both(constant(0.0, Type::integer) <= counts_, counts_ < counts_per_turn_);
    sensors = both(sensors, within(tachometer_, largest_tachometer_));
    if (reads_torque_) sensors = both(sensors, within(torque_, largest_torque_));
    builder_.assign(good_, sensors);
    builder_.begin_if(run_);
    builder_.assign(good_, both(good_, both(within(target_angle_, largest_target_),
                                            within(target_rate_, largest_target_))));
    builder_.begin_if(both(encoder_known_, largest_movement_ < absolute(moved_)));
    builder_.assign(good_, no_);
    builder_.end_if();
    builder_.otherwise();
    builder_.assign(good_, both(good_, within(manual_, largest_manual_)));
    builder_.end_if();
  }

  void read_sensors() {
    builder_.remark(
        "Turn of the encoder: at first, or after a jump in standby, nearest to the centre.");
    const Expression in_turn = encoder_zero_ + to_wide(counts_) * degrees_per_count_;
    builder_.begin_if(both(encoder_known_, absolute(moved_) <= largest_movement_));
    builder_.assign(turns_, turns_ + wrapped_);
    builder_.otherwise();
    // Rounded to the nearest: truncation of a positive number.
    constexpr double many = 1024.0;
    builder_.assign(turns_,
                    wide_number(many) - truncated((in_turn - encoder_centre_) / wide_number(360.0) +
                                                  wide_number(many + 0.5)));
    builder_.assign(encoder_known_, yes_);
    builder_.end_if();
    builder_.assign(last_counts_, to_wide(counts_));
    builder_.assign(last_position_, in_turn + wide_number(360.0) * turns_);
    builder_.remark("Sensors in SI at the motors.");
    builder_.assign(rate_, tachometer_ * rate_per_tachometer_);
    if (reads_torque_) builder_.assign(measured_torque_, torque_ * torque_per_signal_);
  }

  FeedbackInputs feedback_inputs() const {
    return {angle_error_, rate_, feedforward_->rate_feedforward(), excess_torque_};
  }

  void subtract_motion_torque() {
    if (!reads_torque_) return;
    builder_.assign(excess_torque_, feedforward_->has_motion_torque()
                                        ? measured_torque_ - feedforward_->motion_torque()
                                        : measured_torque_);
  }

  // The reference keeps its rate in the first sample, so that the valve command is what it was.
  void start() {
    builder_.remark("Start: the steady state with the valve command in force.");
    builder_.assign(start_rate_, rate_);
    builder_.begin_if(absolute(rate_) <= start_rest_rate_);
    builder_.assign(start_rate_, zero_);
    builder_.end_if();
    feedforward_->start(builder_, start_rate_);
    subtract_motion_torque();
    const Expression error =
        feedback_->start(builder_, command_ - feedforward_->valve_feedforward(), feedback_inputs());
    builder_.assign(angle_error_, error);
    preprocessor_->start(builder_, last_position_ - to_wide(angle_error_) / motor_per_degree_,
                         to_wide(start_rate_) / motor_per_degree_);
    builder_.assign(started_, yes_);
  }

  void control() {
    builder_.assign(running_, yes_);
    builder_.begin_if(complement(started_));
    start();
    builder_.otherwise();
    builder_.remark("Command preprocessor: the reference now, and at the next sample.");
    preprocessor_->plan(builder_, target_angle_, target_rate_);
    builder_.end_if();
    builder_.remark("Feedforward of the commanded motion.");
    builder_.assign(motor_rate_, to_real(preprocessor_->rate() * motor_per_degree_));
    builder_.assign(motor_acceleration_,
                    to_real(preprocessor_->acceleration() * motor_per_degree_));
    builder_.assign(next_motor_rate_, to_real(preprocessor_->next_rate() * motor_per_degree_));
    feedforward_->compute(builder_, motor_rate_, motor_acceleration_, next_motor_rate_);
    builder_.remark("Feedback.");
    builder_.assign(error_, last_position_ - preprocessor_->angle());
    builder_.assign(angle_error_, to_real(error_ * motor_per_degree_));
    subtract_motion_torque();
    builder_.assign(demand_, feedforward_->valve_feedforward() +
                                 feedback_->feedback(builder_, feedback_inputs()));
    builder_.remark("States, with what the valve's limit leaves of the command.");
    builder_.assign(cut_, demand_ - limited(demand_, command_limit_));
    feedback_->advance(builder_, feedback_inputs(), cut_);
    feedforward_->advance(builder_);
    preprocessor_->advance(builder_);
  }

  const ControllerProgramOptions& options_;
  Builder builder_;
  bool reads_torque_, is_state_space_;
  Expression zero_ = constant(0.0);
  Expression yes_ = constant(1.0, Type::boolean), no_ = constant(0.0, Type::boolean);
  Expression run_, target_angle_, target_rate_, manual_, counts_, tachometer_, torque_;
  Expression valve_command_, fault_, running_, position_, encoder_error_, reference_,
      reference_rate_;
  Expression sample_time_, counts_per_turn_, degrees_per_count_, encoder_zero_, encoder_centre_,
      motor_per_degree_, rate_per_tachometer_, torque_per_signal_, valve_scale_, command_limit_,
      largest_tachometer_, largest_torque_, largest_target_, largest_demand_, largest_manual_,
      largest_movement_, start_rest_rate_;
  Expression started_, encoder_known_, last_counts_, last_position_, turns_, command_;
  Expression demand_, error_, moved_, wrapped_, good_, start_rate_, rate_, measured_torque_,
      excess_torque_, motor_rate_, motor_acceleration_, next_motor_rate_, angle_error_, cut_;
  std::optional<PreprocessorStatements> preprocessor_;
  std::optional<FeedforwardStatements> feedforward_;
  std::unique_ptr<FeedbackStatements> feedback_;
};

}  // namespace

Program controller_program(const Controller& controller, double sample_time,
                           const ControllerProgramOptions& options) {
  control::validate(controller);
  validate(options);
  return ProgramWriter(controller, sample_time, options).write();
}

}  // namespace boresight::control::program
