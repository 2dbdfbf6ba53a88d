#include <cmath>

#include <boresight/control/program/feedforward_statements.hpp>

namespace boresight::control::program {

FeedforwardStatements::FeedforwardStatements(Builder& builder, const Feedforward& feedforward,
                                             double sample_time, MotionTorque motion_torque)
    : has_friction_(feedforward.friction_to_valve_command != 0.0 ||
                    feedforward.friction_change_to_valve_command != 0.0),
      has_supply_(std::isfinite(feedforward.supply_torque)),
      motion_(motion_torque) {
  const auto gain = [&](const char* name, double value, const char* unit, const char* comment) {
    return builder.parameter(name, Type::real, value, unit, comment);
  };
  const Feedforward& f = feedforward;
  rate_to_rate_ = gain("feedforward_rate_to_rate_command", f.rate_to_rate_command, "",
                       "commanded rate to rate command");
  acceleration_to_rate_ = gain("feedforward_acceleration_to_rate_command",
                               f.acceleration_to_rate_command, "s", "tachometer's lag");
  rate_to_valve_ = gain("feedforward_rate_to_valve", f.rate_to_valve_command, "",
                        "commanded rate to valve command");
  acceleration_to_valve_ =
      gain("feedforward_acceleration_to_valve", f.acceleration_to_valve_command, "s",
           "commanded acceleration to valve command");
  rate_to_torque_ = gain("feedforward_rate_to_torque", f.rate_to_motor_torque, "N.m.s/rad",
                         "torque of the commanded motion");
  acceleration_to_torque_ =
      gain("feedforward_acceleration_to_torque", f.acceleration_to_motor_torque, "kg.m2",
           "torque of the commanded motion");
  if (has_supply_) {
    supply_torque_ = gain("supply_torque", f.supply_torque, "N.m",
                          "at the supply pressure less the return pressure");
    largest_load_ = gain("largest_load", max_feedforward_load, "",
                         "largest fraction of supply_torque that is compensated");
  }
  torque_ = builder.local("commanded_torque", Type::real, "N.m", "of the commanded motion");
  flow_ = builder.local("commanded_flow", Type::real, "rad/s", "valve command without load");
  rate_command_ = builder.local("rate_feedforward", Type::real, "rad/s", "added rate command");
  valve_command_ = builder.local("valve_feedforward", Type::real, "rad/s", "added valve command");
  if (has_supply_)
    load_ = builder.local("relative_load", Type::real, "", "torque over the supply's");
  if (!has_friction_) return;
  const plant::FrictionCurve& curve = f.friction;
  sample_time_ = gain("friction_sample_time", sample_time, "s", "sample time");
  coulomb_ = gain("friction_coulomb", curve.coulomb_torque, "N.m", "fed forward");
  bump_ = gain("friction_breakaway_less_coulomb", curve.breakaway_torque - curve.coulomb_torque,
               "N.m", "fed forward");
  stribeck_rate_ = gain("friction_stribeck_rate", curve.stribeck_rate, "rad/s", "");
  saturating_ = gain("friction_saturating", curve.saturating_torque, "N.m", "fed forward");
  saturating_rate_ = gain("friction_saturating_rate", curve.saturating_rate, "rad/s", "");
  viscous_ = gain("friction_viscous", curve.viscous_friction, "N.m.s/rad", "fed forward");
  friction_to_valve_ = gain("friction_to_valve", f.friction_to_valve_command, "rad/s per N.m",
                            "friction torque to valve command");
  change_to_valve_ = gain("friction_change_to_valve", f.friction_change_to_valve_command,
                          "rad per N.m", "friction torque's change to valve command");
  rest_ = gain("friction_rest", friction_rest_rate, "rad/s", "a commanded rate below is rest");
  last_friction_ = builder.state("last_friction", Type::real, "N.m", "fed forward last");
  if (motion_ != MotionTorque::unused) {
    built_friction_ =
        builder.state("built_friction", Type::real, "N.m",
                      "fed forward two samples ago, which the measured torque contains now");
  }
  friction_ = builder.local("friction", Type::real, "N.m", "of the commanded rate");
  speed_ = builder.local("speed", Type::real, "rad/s", "magnitude of the commanded rate");
}

// plant::friction_torque, and 0 at rest.
void FeedforwardStatements::friction(Builder& builder, const Expression& rate) const {
  builder.assign(speed_, absolute(rate));
  builder.assign(friction_, constant(0.0));
  builder.begin_if(rest_ <= speed_);
  const Expression relative = speed_ / stribeck_rate_;
  builder.assign(friction_,
                 coulomb_ + bump_ * exponential(-(relative * relative)) +
                     saturating_ * (constant(1.0) - exponential(-(speed_ / saturating_rate_))));
  builder.begin_if(rate < constant(0.0));
  builder.assign(friction_, -friction_);
  builder.end_if();
  builder.assign(friction_, friction_ + viscous_ * rate);
  builder.end_if();
}

// `flow`, `torque`: of the motion, without friction.
void FeedforwardStatements::valve(Builder& builder, Expression flow, Expression torque) const {
  builder.assign(torque_, torque);
  torque = torque_;
  if (has_friction_) torque = torque + friction_;
  builder.assign(flow_, flow);
  if (!has_supply_) {
    builder.assign(valve_command_, flow_);
    return;
  }
  builder.assign(load_, absolute(torque) / supply_torque_);
  builder.begin_if(torque * flow_ < constant(0.0));
  builder.assign(load_, -load_);
  builder.end_if();
  builder.assign(valve_command_,
                 flow_ / square_root(constant(1.0) - smaller(load_, largest_load_)));
}

void FeedforwardStatements::start(Builder& builder, const Expression& rate) const {
  Expression flow = rate_to_valve_ * rate;
  if (has_friction_) {
    friction(builder, rate);
    builder.assign(last_friction_, friction_);
    if (motion_ != MotionTorque::unused) builder.assign(built_friction_, friction_);
    flow = flow + friction_to_valve_ * friction_;
  }
  builder.assign(rate_command_, rate_to_rate_ * rate);
  valve(builder, flow, rate_to_torque_ * rate);
}

void FeedforwardStatements::compute(Builder& builder, const Expression& rate,
                                    const Expression& acceleration,
                                    const Expression& next_rate) const {
  builder.assign(rate_command_, rate_to_rate_ * rate + acceleration_to_rate_ * acceleration);
  Expression flow = rate_to_valve_ * rate + acceleration_to_valve_ * acceleration;
  if (has_friction_) {
    friction(builder, next_rate);
    flow = flow + friction_to_valve_ * friction_ +
           change_to_valve_ * ((friction_ - last_friction_) / sample_time_);
  }
  valve(builder, flow, rate_to_torque_ * rate + acceleration_to_torque_ * acceleration);
}

void FeedforwardStatements::advance(Builder& builder) const {
  if (!has_friction_) return;
  if (motion_ != MotionTorque::unused) builder.assign(built_friction_, last_friction_);
  builder.assign(last_friction_, friction_);
}

bool FeedforwardStatements::has_motion_torque() const {
  return motion_ == MotionTorque::whole ||
         (motion_ == MotionTorque::friction_only && has_friction_);
}

Expression FeedforwardStatements::motion_torque() const {
  if (motion_ != MotionTorque::whole) return built_friction_;
  return has_friction_ ? torque_ + built_friction_ : torque_;
}

}  // namespace boresight::control::program
