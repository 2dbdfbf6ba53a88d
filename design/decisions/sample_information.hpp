#pragma once

#include <vector>

#include <Eigen/Core>

namespace boresight::design {

/// Reduction of the expected loss by information available before the choice (unit of the loss;
/// never below 0).
struct InformationGain {
  double gain = 0.0;
  double standard_error = 0.0;
};

/// Value of knowing one input exactly, and nothing else.
struct InputValue {
  /// From regressions evaluated on the samples they were fitted to. Biased high by overfitting,
  /// most where the true gain is 0.
  InformationGain fitted;
  /// From regressions evaluated on samples not used in their fit (ten folds). It is the true gain
  /// of such a rule, so biased low, and may be negative. The true value lies between the two,
  /// within their standard errors.
  double held_out_gain = 0.0, held_out_error = 0.0;
  /// Number of coefficients of the regression selected by generalised cross-validation. 1: the
  /// losses' differences do not depend on the input.
  std::size_t coefficients = 1;
};

struct SampleInformation {
  std::size_t choice = 0;  // without further information: the least mean loss
  std::vector<double> mean_loss;
  /// Expected value of perfect information: an upper bound on the value of any test. Biased low
  /// where options are nearly equal, by at most the standard error of their difference.
  InformationGain perfect;
  std::vector<InputValue> inputs;  // expected values of partial perfect information, by column
};

/// The value of information (H. Raiffa and R. Schlaifer, Applied Statistical Decision Theory, 1961)
/// from samples: `inputs(sample, input)` and `losses(sample, option)`, rows independent, smaller
/// losses better. The value of one input follows from regression of the losses' differences on it
/// (M. Strong, J. E. Oakley, A. Brennan, Med. Decis. Making 34(3), 2014). The regression functions
/// are natural cubic splines in the input with knots at its quantiles, straight beyond the outer
/// ones (F. E. Harrell, Regression Modeling Strategies, 2001): a constant, a straight line, or a
/// line and 1, 2, 4 or 6 curved columns. Standard errors are those of the gain of the fitted rule,
/// over the samples. Inputs that do not vary have the value 0. O(samples x inputs x options).
/// @throws InvalidInput for fewer than 100 samples, fewer than 2 options, sizes that differ, or
/// numbers that are not finite.
SampleInformation sample_information(const Eigen::MatrixXd& inputs, const Eigen::MatrixXd& losses);

}  // namespace boresight::design
