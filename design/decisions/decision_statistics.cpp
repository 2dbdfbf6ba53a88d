#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <boresight/design/decisions/decision_statistics.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/statistics/distribution_quantiles.hpp>
#include <boresight/numerics/statistics/order_statistics.hpp>

namespace boresight::design {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

bool within_unit(double fraction) {
  return fraction > 0.0 && fraction < 1.0;
}

void check_confidence(const char* function, double confidence) {
  if (!within_unit(confidence)) {
    throw InvalidInput(
        fmt::format("{}: expected a confidence within (0, 1), found {}", function, confidence));
  }
}

void check(const Eigen::MatrixXd& outcomes, const DecisionOptions& options) {
  if (outcomes.rows() < 2 || outcomes.cols() < 1) {
    throw InvalidInput(
        fmt::format("compare_options: expected at least 2 samples (rows) of at least "
                    "one option (columns), found {} x {}",
                    outcomes.rows(), outcomes.cols()));
  }
  for (Eigen::Index j = 0; j < outcomes.cols(); ++j) {
    for (Eigen::Index n = 0; n < outcomes.rows(); ++n) {
      if (!(outcomes(n, j) > -infinity)) {
        throw InvalidInput(
            fmt::format("compare_options: expected numbers or +infinity (failed) as outcomes, "
                        "found {} in sample "
                        "{} of option {}",
                        outcomes(n, j), n, j));
      }
    }
  }
  check_confidence("compare_options", options.confidence);
  const bool tolerable = options.tie_tolerance >= 0.0 && options.tie_tolerance < infinity;
  if (!tolerable) {
    throw InvalidInput(
        fmt::format("compare_options: expected a tie tolerance of at least 0, found {}",
                    options.tie_tolerance));
  }
  for (const double fraction : options.quantile_fractions) {
    if (!within_unit(fraction)) {
      throw InvalidInput(fmt::format(
          "compare_options: expected quantile fractions within (0, 1), found {}", fraction));
    }
  }
}

// Infinite outcomes, too, tie with one another.
bool tied(double a, double b, double tolerance) {
  return a == b || std::abs(a - b) <= tolerance;
}

double error_of_mean(const Eigen::ArrayXd& values) {
  const auto count = static_cast<double>(values.size());
  return std::sqrt((values - values.mean()).square().sum() / (count * (count - 1.0)));
}

std::vector<double> sorted(const Eigen::ArrayXd& values) {
  std::vector<double> result(values.begin(), values.end());
  std::sort(result.begin(), result.end());
  return result;
}

Quantile quantile_of(const std::vector<double>& values, double fraction, double confidence) {
  Quantile result{fraction, numerics::quantile(values, fraction), -infinity, infinity};
  const double probability = 0.5 * (1.0 - confidence);
  const auto low = numerics::rank_below_quantile(values.size(), fraction, probability);
  const auto high = numerics::rank_below_quantile(values.size(), 1.0 - fraction, probability);
  if (low >= 0) result.lower = values[static_cast<std::size_t>(low)];
  if (high >= 0) result.upper = values[values.size() - 1 - static_cast<std::size_t>(high)];
  return result;
}

// Sums of the largest k of `first` and `second`, k from 1: none of the first greater.
bool averages_no_worse(const std::vector<double>& first, const std::vector<double>& second) {
  double first_sum = 0.0;
  double second_sum = 0.0;
  for (std::size_t k = first.size(); k-- > 0;) {
    first_sum += first[k];
    second_sum += second[k];
    if (first_sum > second_sum) return false;
  }
  return true;
}

Dominance dominance(const Eigen::ArrayXd& first, const Eigen::ArrayXd& second,
                    const std::vector<double>& first_sorted,
                    const std::vector<double>& second_sorted) {
  if (first_sorted == second_sorted) return Dominance::none;
  if ((first <= second).all()) return Dominance::in_every_sample;
  if (std::equal(first_sorted.begin(), first_sorted.end(), second_sorted.begin(),
                 [](double a, double b) { return a <= b; })) {
    return Dominance::first_order;
  }
  return averages_no_worse(first_sorted, second_sorted) ? Dominance::second_order : Dominance::none;
}

PairComparison compare(const Eigen::MatrixXd& outcomes, std::size_t i, std::size_t j,
                       const std::vector<std::vector<double>>& order,
                       const DecisionOptions& options) {
  const Eigen::ArrayXd first = outcomes.col(static_cast<Eigen::Index>(i));
  const Eigen::ArrayXd second = outcomes.col(static_cast<Eigen::Index>(j));
  PairComparison pair;
  pair.first = i;
  pair.second = j;
  Eigen::ArrayXd scores(first.size());
  for (Eigen::Index n = 0; n < first.size(); ++n) {
    const bool tie = tied(first[n], second[n], options.tie_tolerance);
    const bool win = !tie && first[n] < second[n];
    scores[n] = tie ? 0.5 : (win ? 1.0 : 0.0);
    pair.ties += tie ? 1 : 0;
    pair.wins += win ? 1 : 0;
    pair.losses += !tie && !win ? 1 : 0;
  }
  pair.better = mean_score(scores, options.confidence);
  const bool finite = first.isFinite().all() && second.isFinite().all();
  pair.mean_gain = finite ? (second - first).mean() : no_number;
  pair.gain_error = finite ? error_of_mean(second - first) : no_number;
  pair.first_over_second = dominance(first, second, order[i], order[j]);
  pair.second_over_first = dominance(second, first, order[j], order[i]);
  return pair;
}

OptionStatistics describe(const Eigen::MatrixXd& outcomes, Eigen::Index option,
                          const std::vector<double>& order, const DecisionOptions& options) {
  const Eigen::ArrayXd own = outcomes.col(option);
  Eigen::ArrayXd scores(own.size());
  Eigen::ArrayXd regrets(own.size());
  for (Eigen::Index n = 0; n < own.size(); ++n) {
    const double best = outcomes.row(n).minCoeff();
    const auto sharing =
        std::count_if(outcomes.row(n).begin(), outcomes.row(n).end(),
                      [&](double other) { return tied(other, best, options.tie_tolerance); });
    const bool among = tied(own[n], best, options.tie_tolerance);
    scores[n] = among ? 1.0 / static_cast<double>(sharing) : 0.0;
    regrets[n] = own[n] == best ? 0.0 : own[n] - best;
  }
  OptionStatistics result;
  result.best = mean_score(scores, options.confidence);
  result.mean = own.mean();
  result.standard_error = std::isfinite(result.mean) ? error_of_mean(own) : no_number;
  result.expected_regret = regrets.mean();
  result.regret_error = std::isfinite(result.expected_regret) ? error_of_mean(regrets) : no_number;
  for (const double fraction : options.quantile_fractions) {
    result.quantiles.push_back(quantile_of(order, fraction, options.confidence));
  }
  return result;
}

}  // namespace

std::string_view to_string(Dominance dominance) {
  static constexpr std::array names{"none", "second order", "first order", "in every sample"};
  return names.at(static_cast<std::size_t>(dominance));
}

Probability mean_score(const Eigen::ArrayXd& scores, double confidence) {
  check_confidence("mean_score", confidence);
  if (scores.size() == 0 || !((scores >= 0.0) && (scores <= 1.0)).all()) {
    throw InvalidInput(
        fmt::format("mean_score: expected at least one score, all within [0, 1], "
                    "found {} scores",
                    scores.size()));
  }
  const auto count = static_cast<double>(scores.size());
  Probability result;
  result.value = scores.mean();
  // Jeffreys's prior is worth one trial, half won and half lost. With it in the mean square, too,
  // scores that are all equal are not taken for certain.
  const double prior_mean = (scores.sum() + 0.5) / (count + 1.0);
  const double mean_square = (scores.square().sum() + 0.5) / (count + 1.0);
  const double binomial_variance = prior_mean * (1.0 - prior_mean);
  const double trials = count * binomial_variance / (mean_square - prior_mean * prior_mean);
  const double a = result.value * trials + 0.5;
  const double b = (1.0 - result.value) * trials + 0.5;
  const double probability = 0.5 * (1.0 - confidence);
  result.lower = result.value == 0.0 ? 0.0 : numerics::beta_quantile(probability, a, b);
  result.upper = result.value == 1.0 ? 1.0 : numerics::beta_quantile(1.0 - probability, a, b);
  return result;
}

DecisionStatistics compare_options(const Eigen::MatrixXd& outcomes,
                                   const DecisionOptions& options) {
  check(outcomes, options);
  std::vector<std::vector<double>> order;
  for (Eigen::Index j = 0; j < outcomes.cols(); ++j) order.push_back(sorted(outcomes.col(j)));
  DecisionStatistics result;
  result.random_samples = static_cast<std::size_t>(outcomes.rows());
  for (std::size_t i = 0; i < order.size(); ++i) {
    result.options.push_back(describe(outcomes, static_cast<Eigen::Index>(i), order[i], options));
    for (std::size_t j = i + 1; j < order.size(); ++j) {
      result.pairs.push_back(compare(outcomes, i, j, order, options));
    }
  }
  return result;
}

}  // namespace boresight::design
