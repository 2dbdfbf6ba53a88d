#pragma once

#include <string_view>
#include <vector>

#include <Eigen/Core>

namespace boresight::design {

struct DecisionOptions {
  double confidence = 0.95;
  /// Two outcomes differing by no more than this are a tie (unit of the outcomes).
  double tie_tolerance = 0.0;
  /// Probabilities of the quantiles to compute.
  std::vector<double> quantile_fractions{0.05, 0.5, 0.95};
};

/// A probability estimated from samples, with its interval.
struct Probability {
  double value = 0.0, lower = 0.0, upper = 0.0;
};

/// The mean of independent scores within [0, 1] (1 a win, 0 a loss, between: a tie) and its
/// Jeffreys interval. The interval is that of a binomial fraction (L. D. Brown, T. T. Cai, A.
/// DasGupta, Statist. Sci. 16(2), 2001). The number of trials matches the scores' variance, so that
/// ties narrow the interval correctly. At mean 0 or 1 the interval ends there.
/// @throws InvalidInput without scores, for one outside [0, 1], or a confidence outside (0, 1).
Probability mean_score(const Eigen::ArrayXd& scores, double confidence);

/// Stochastic dominance between two distributions of a loss. It describes the samples; it is not a
/// statistical test.
enum class Dominance {
  none,
  second_order,     // mean of any worst fraction no greater: every risk-averse chooser
  first_order,      // every quantile is no greater: everyone who prefers smaller losses
  in_every_sample,  // no greater in every sample
};
std::string_view to_string(Dominance dominance);

/// `first` against `second`, by column.
struct PairComparison {
  std::size_t first = 0, second = 0;
  std::size_t wins = 0, ties = 0, losses = 0;  // samples in which the first is less
  /// Probability that the first is less than the second, ties counted half.
  Probability better;
  /// Mean over the samples of second less first (positive: the first is better), and its standard
  /// error. NaN where an outcome is infinite.
  double mean_gain = 0.0, gain_error = 0.0;
  Dominance first_over_second = Dominance::none, second_over_first = Dominance::none;
};

/// A quantile (linear between order statistics) and its distribution-free interval by order
/// statistics. Infinite where the samples are too few for a bound.
struct Quantile {
  double fraction = 0.0, value = 0.0, lower = 0.0, upper = 0.0;
};

struct OptionStatistics {
  double mean = 0.0, standard_error = 0.0;
  std::vector<Quantile> quantiles;  // at DecisionOptions::quantile_fractions
  /// Probability that it is the least of all; a tie counts in equal parts.
  Probability best;
  /// Mean loss relative to the best option of each sample, and its standard error.
  double expected_regret = 0.0, regret_error = 0.0;
};

struct DecisionStatistics {
  std::vector<OptionStatistics> options;  // by column
  std::vector<PairComparison> pairs;      // (0, 1), (0, 2), ... (1, 2), ...
  std::size_t random_samples = 0;
};

/// Compares options by outcomes of which less is better (an rms, a loss): `outcomes(sample,
/// option)`. All options of a row have the same sample of the uncertain inputs; rows are
/// independent. +infinity marks an option that failed: worse than any number, tied with itself.
/// Means and regrets are then infinite. The statistics hold for the distribution that was sampled,
/// within their intervals.
/// @throws InvalidInput for fewer than 2 samples, no options, NaN or -infinity among the outcomes,
/// or options out of range.
DecisionStatistics compare_options(const Eigen::MatrixXd& outcomes,
                                   const DecisionOptions& options = {});

}  // namespace boresight::design
