#include <limits>
#include <utility>

#include <boresight/control/program/preprocessor_statements.hpp>

namespace boresight::control::program {
namespace {

Expression number(double value) {
  return constant(value, Type::wide);
}

}  // namespace

PreprocessorStatements::PreprocessorStatements(Builder& builder, double rate_limit,
                                               double acceleration_limit, Expression sample_time)
    : sample_time_(std::move(sample_time)),
      rate_limit_(builder.parameter("rate_limit", Type::wide, rate_limit, "deg/s",
                                    "of the commanded motion")),
      acceleration_limit_(builder.parameter("acceleration_limit", Type::wide, acceleration_limit,
                                            "deg/s2", "of the commanded motion")),
      angle_(builder.state("reference_angle", Type::wide, "deg", "commanded angle at this sample")),
      rate_(builder.state("commanded_rate", Type::wide, "deg/s", "commanded rate at this sample")),
      next_angle_(builder.local("next_angle", Type::wide, "deg", "commanded at the next sample")),
      next_rate_(builder.local("next_rate", Type::wide, "deg/s", "commanded at the next sample")),
      acceleration_(builder.local("commanded_acceleration", Type::wide, "deg/s2",
                                  "from this sample to the next")),
      step_(builder.local("rate_step", Type::wide, "deg/s", "largest change of the rate")),
      lowest_(builder.local("lowest_rate", Type::wide, "deg/s", "at the next sample")),
      highest_(builder.local("highest_rate", Type::wide, "deg/s", "at the next sample")),
      remaining_(
          builder.local("remaining_distance", Type::wide, "deg",
                        "to the target, beyond this sample's if it ends at the target's rate")),
      known_(builder.local("angle_rounding", Type::wide, "deg", "of the sum of angles")),
      steps_(builder.local("stopping_samples", Type::wide, "", "samples that a stop takes")),
      approach_(builder.local("approach_rate", Type::wide, "deg/s",
                              "from which the remaining distance still permits a stop")) {}

void PreprocessorStatements::start(Builder& builder, const Expression& angle,
                                   const Expression& rate) const {
  builder.assign(angle_, angle);
  builder.assign(rate_, rate);
  builder.assign(next_rate_, rate_);
  builder.assign(next_angle_, angle_ + sample_time_ * rate_);
  builder.assign(acceleration_, number(0.0));
}

void PreprocessorStatements::rest(Builder& builder, const Expression& angle) const {
  builder.assign(angle_, angle);
  builder.assign(rate_, number(0.0));
}

void PreprocessorStatements::plan(Builder& builder, const Expression& target_angle,
                                  const Expression& target_rate) const {
  constexpr double rounding = 64.0 * std::numeric_limits<double>::epsilon();
  const Expression t = sample_time_;
  builder.assign(step_, acceleration_limit_ * t);
  // A rate beyond the limit, as a start may have it, is reduced by the acceleration limit.
  builder.assign(lowest_, smaller(larger(rate_ - step_, -rate_limit_), rate_ + step_));
  builder.assign(highest_, larger(smaller(rate_ + step_, rate_limit_), rate_ - step_));
  builder.assign(remaining_, target_angle - angle_ - number(0.5) * t * (rate_ + target_rate));
  // The start comes from an encoder, whose angles have the rounding of a turn.
  constexpr double turn = 360.0;
  builder.assign(known_, number(rounding) * (absolute(target_angle) + absolute(angle_) + step_ * t +
                                             number(turn)));
  const Expression slack = number(1e-10) * step_;
  builder.begin_if(both(absolute(remaining_) <= known_,
                        both(lowest_ - slack <= target_rate, target_rate <= highest_ + slack)));
  builder.assign(next_angle_, target_angle);
  builder.assign(next_rate_, target_rate);
  builder.otherwise();
  builder.assign(
      approach_,
      number(0.5) * (square_root(number(1.0) + number(8.0) * (absolute(remaining_) / (step_ * t))) -
                     number(1.0)));
  builder.assign(steps_, truncated(approach_));
  builder.begin_if(steps_ < approach_);
  builder.assign(steps_, steps_ + number(1.0));
  builder.end_if();
  builder.assign(steps_, larger(steps_, number(1.0)));
  builder.assign(approach_, absolute(remaining_) / (steps_ * t) +
                                number(0.5) * step_ * (steps_ - number(1.0)));
  builder.begin_if(remaining_ < number(0.0));
  builder.assign(approach_, -approach_);
  builder.end_if();
  builder.assign(next_rate_, larger(smaller(target_rate + approach_, highest_), lowest_));
  builder.assign(next_angle_, angle_ + number(0.5) * t * (rate_ + next_rate_));
  builder.end_if();
  builder.assign(acceleration_, (next_rate_ - rate_) / t);
}

void PreprocessorStatements::advance(Builder& builder) const {
  builder.assign(angle_, next_angle_);
  builder.assign(rate_, next_rate_);
}

}  // namespace boresight::control::program
