#pragma once

namespace boresight::numerics {

// Quantiles of common distributions, by Boost.Math, to 1e-12. `fraction`: probability, within (0,
// 1).
// @throws InvalidInput for a probability outside, or parameters that are not positive and finite.

/// 97.5 % quantile of the standard normal distribution; 95 % lie between it and its negative.
constexpr double normal_975 = 1.959963984540054;

/// Student's t of `freedom` degrees.
double student_quantile(double fraction, double freedom);
/// Beta(a, b): within (0, 1).
double beta_quantile(double fraction, double a, double b);
/// Fisher's F: the ratio of two mean squares of `numerator` and `denominator` degrees of freedom.
double f_quantile(double fraction, double numerator, double denominator);
/// Chi-squared of `freedom` degrees.
double chi_squared_quantile(double fraction, double freedom);

}  // namespace boresight::numerics
