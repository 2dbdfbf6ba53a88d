#pragma once

#include <vector>

#include <Eigen/Core>

namespace boresight::design {

/// By how much the expected loss falls if something is known before the choice is made (unit of
/// the loss; never below 0).
struct InformationGain {
  double gain = 0.0;
  double standard_error = 0.0;
};

/// What knowing one input exactly, and nothing else, is worth.
struct InputValue {
  /// Of the fitted regressions on the very draws they were fitted to: biased high, by what the
  /// regressions take from chance; most where the true gain is 0.
  InformationGain fitted;
  /// Of choices by regressions that have not seen the draws they are judged on (ten folds): what
  /// such a rule would truly gain, so biased low, and may be negative. The truth lies between the
  /// two, but for their standard errors.
  double held_out_gain = 0.0, held_out_error = 0.0;
  /// Coefficients of the regression kept, of those tried the best by generalised cross-validation:
  /// 1 says that the losses' differences do not depend on the input.
  std::size_t coefficients = 1;
};

struct TestValue {
  std::size_t choice = 0;  // without further knowledge: the least mean loss
  std::vector<double> mean_loss;
  /// Of knowing everything (expected value of perfect information): no test is worth more. Biased
  /// low where options are nearly equal, by at most the standard error of their difference.
  InformationGain perfect;
  std::vector<InputValue> inputs;  // expected values of partial perfect information, by column
};

/// The value of information (H. Raiffa and R. Schlaifer, Applied Statistical Decision Theory, 1961)
/// from draws: `inputs(draw, input)` and `losses(draw, option)`, rows independent, less loss
/// better. The value of one input alone by regression of the losses' differences on it (M. Strong,
/// J. E. Oakley, A. Brennan, Med. Decis. Making 34(3), 2014): natural cubic splines in the input
/// with knots at its quantiles (straight beyond the outer ones; F. E. Harrell, Regression Modeling
/// Strategies, 2001): a constant, a straight line, or a line and 1, 2, 4 or 6 curved columns.
/// Standard errors are those of the gain of the rule found, over the draws. Inputs that do not vary
/// are worth 0. O(draws x inputs x options).
/// @throws InvalidInput for fewer than 100 draws, fewer than 2 options, sizes that differ, or
/// numbers that are not finite.
TestValue test_value(const Eigen::MatrixXd& inputs, const Eigen::MatrixXd& losses);

}  // namespace boresight::design
