#pragma once

#include <string_view>
#include <vector>

#include <Eigen/Core>

namespace boresight::design {

struct DecisionOptions {
  double confidence = 0.95;
  /// Two outcomes differing by no more than this are a tie (unit of the outcomes).
  double tie_tolerance = 0.0;
  /// Shares at which quantiles are wanted.
  std::vector<double> quantile_shares{0.05, 0.5, 0.95};
};

/// A probability estimated from draws, with its interval.
struct Probability {
  double value = 0.0, lower = 0.0, upper = 0.0;
};

/// The mean of independent scores within [0, 1] (1 a win, 0 a loss, between: a tie shared) and
/// Jeffreys's interval for it: that of a binomial share (L. D. Brown, T. T. Cai, A. DasGupta,
/// Statist. Sci. 16(2), 2001), of as many trials as have the scores' variance, so that ties narrow
/// it as they should. At mean 0 or 1 the interval ends there.
/// @throws InvalidInput without scores, for one outside [0, 1], or a confidence outside (0, 1).
Probability mean_score(const Eigen::ArrayXd& scores, double confidence);

/// Which of two distributions of a loss nobody, or nobody who dislikes risk, would choose. Of the
/// draws as they are: not a test.
enum class Dominance {
  none,
  second_order,   // of every share of worst draws the mean is no greater: any risk-averse chooser
  first_order,    // every quantile is no greater: whoever prefers less
  in_every_draw,  // no greater draw by draw
};
std::string_view to_string(Dominance dominance);

/// `first` against `second`, by column.
struct PairComparison {
  std::size_t first = 0, second = 0;
  std::size_t wins = 0, ties = 0, losses = 0;  // draws in which the first is less
  /// That the first is less than the second, ties counted half.
  Probability better;
  /// Of second less first, over the draws (positive: the first is better), and the standard error
  /// of that mean; NaN where an outcome is infinite.
  double mean_gain = 0.0, gain_error = 0.0;
  Dominance first_over_second = Dominance::none, second_over_first = Dominance::none;
};

/// A quantile (linear between order statistics) and the interval by order statistics, which assumes
/// nothing of the distribution; infinite where so few draws give no bound.
struct Quantile {
  double share = 0.0, value = 0.0, lower = 0.0, upper = 0.0;
};

struct OptionStatistics {
  double mean = 0.0, standard_error = 0.0;
  std::vector<Quantile> quantiles;  // at DecisionOptions::quantile_shares
  /// That it is the least of all; those tied for it share it.
  Probability best;
  /// Mean of what it loses against the best option of each draw, and its standard error.
  double expected_regret = 0.0, regret_error = 0.0;
};

struct DecisionStatistics {
  std::vector<OptionStatistics> options;  // by column
  std::vector<PairComparison> pairs;      // (0, 1), (0, 2), ... (1, 2), ...
  std::size_t draws = 0;
};

/// Compares options by outcomes of which less is better (an rms, a loss): `outcomes(draw, option)`,
/// all options of a row on the same draw of what is uncertain, rows independent. +infinity stands
/// for an option that failed: worse than any number, tied with itself; means and regrets are then
/// infinite. What is said holds for the distribution the draws came from, and is as sure as the
/// intervals say.
/// @throws InvalidInput for fewer than 2 draws, no options, NaN or -infinity among the outcomes, or
/// options out of range.
DecisionStatistics compare_options(const Eigen::MatrixXd& outcomes,
                                   const DecisionOptions& options = {});

}  // namespace boresight::design
