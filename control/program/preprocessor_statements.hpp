#pragma once

#include <boresight/control/program/program.hpp>

namespace boresight::control::program {

/// CommandPreprocessor as statements, in deg at the sky and double precision.
class PreprocessorStatements {
 public:
  /// Declares parameters and states. Limits in deg/s and deg/s2; `sample_time`: a parameter.
  PreprocessorStatements(Builder& builder, double rate_limit, double acceleration_limit,
                         Expression sample_time);

  /// The reference begins at an angle (deg), with a rate (deg/s), and keeps that rate to the next
  /// sample. A rate beyond the limit is reduced from then on.
  void start(Builder& builder, const Expression& angle, const Expression& rate) const;
  /// The reference rests at an angle (deg), out of use.
  void rest(Builder& builder, const Expression& angle) const;
  /// CommandPreprocessor::advance to a target (deg, deg/s), without the step itself.
  void plan(Builder& builder, const Expression& target_angle, const Expression& target_rate) const;
  /// To the sample planned.
  void advance(Builder& builder) const;

  /// The reference now (deg, deg/s), and its acceleration until the next sample (deg/s2).
  const Expression& angle() const { return angle_; }
  const Expression& rate() const { return rate_; }
  const Expression& acceleration() const { return acceleration_; }
  const Expression& next_rate() const { return next_rate_; }

 private:
  Expression sample_time_, rate_limit_, acceleration_limit_;
  Expression angle_, rate_;
  Expression next_angle_, next_rate_, acceleration_;
  Expression step_, lowest_, highest_, remaining_, known_, steps_, approach_;
};

}  // namespace boresight::control::program
