#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include <boost/random/sobol.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/numerics/error.hpp>
#include <boresight/numerics/normal_numbers.hpp>
#include <boresight/numerics/parallel_loop.hpp>
#include <boresight/numerics/statistics/distribution_quantiles.hpp>
#include <boresight/numerics/statistics/sobol_indices.hpp>

namespace boresight::numerics {
namespace {

// Nested uniform scrambling of one coordinate: every binary digit is flipped or not by a coin that
// depends on the digits before it. Points tell one another apart by their first 24 digits at most;
// the rest is sampling error.
double scrambled(std::uint64_t digits, std::uint64_t stream) {
  constexpr int nested = 24;
  std::uint64_t result = 0;
  for (int k = 0; k < nested; ++k) {
    const std::uint64_t before = k == 0 ? 0 : digits >> (64 - k);
    // The leading 1 keeps 0, 00, 000 apart.
    const std::uint64_t coin = numerics::splitmix64(stream, (std::uint64_t{1} << k) | before) >> 63;
    result |= (((digits >> (63 - k)) & 1U) ^ coin) << (63 - k);
  }
  const std::uint64_t leaf = (std::uint64_t{1} << nested) | (digits >> (64 - nested));
  result |= numerics::splitmix64(stream, leaf) >> nested;
  return (static_cast<double>(result >> 12) + 0.5) * 0x1p-52;
}

void check_points(const char* function, std::size_t points, std::size_t minimum) {
  if (points < minimum || points > (std::size_t{1} << 24) || !std::has_single_bit(points)) {
    throw InvalidInput(
        fmt::format("{}: expected a power of two from {} to 2^24 as number of points, found {}",
                    function, minimum, points));
  }
}

void check(std::size_t inputs, std::size_t outputs, const SobolOptions& options) {
  check_points("sobol_indices", options.points, 16);
  if (inputs < 1 || inputs > 500 || outputs < 1) {
    throw InvalidInput(
        fmt::format("sobol_indices: expected 1 to 500 inputs and at least one "
                    "output, found {} and {}",
                    inputs, outputs));
  }
  if (options.randomisations < 4) {
    throw InvalidInput(
        fmt::format("sobol_indices: expected at least 4 randomisations, for an "
                    "interval from their scatter, found {}",
                    options.randomisations));
  }
  const bool within = options.confidence > 0.0 && options.confidence < 1.0;
  if (!within) {
    throw InvalidInput(fmt::format("sobol_indices: expected a confidence within (0, 1), found {}",
                                   options.confidence));
  }
}

// All values of one randomisation: rows points, columns outputs; A, B, A_B^1, A_B^2, ...
using Values = std::vector<Eigen::MatrixXd>;

Values evaluate(const Eigen::MatrixXd& points, Eigen::Index outputs,
                const QuantileFunction& function, unsigned threads) {
  const auto inputs = static_cast<std::size_t>(points.cols()) / 2;
  Values values(inputs + 2, Eigen::MatrixXd(points.rows(), outputs));
  for_each_index(static_cast<std::size_t>(points.rows()), threads, [&](std::size_t n) {
    const auto row = static_cast<Eigen::Index>(n);
    std::vector<double> fractions(inputs);
    Eigen::VectorXd out(outputs);
    const auto evaluate_into = [&](std::size_t matrix) {
      function(fractions, out);
      if (out.size() != outputs) {
        throw InvalidInput(
            fmt::format("sobol_indices: expected {} outputs of the function, found "
                        "{}",
                        outputs, out.size()));
      }
      if (!out.allFinite()) {
        throw NumericalFailure(
            fmt::format("sobol_indices: the function is not finite where the inputs stand at the "
                        "fractions {:.6g} of their distributions: indices need a value everywhere",
                        fmt::join(fractions, ", ")));
      }
      values[matrix].row(row) = out.transpose();
    };
    const auto fraction = [&](std::size_t column) {
      return points(row, static_cast<Eigen::Index>(column));
    };
    for (std::size_t i = 0; i < inputs; ++i) fractions[i] = fraction(inputs + i);
    evaluate_into(1);
    for (std::size_t i = 0; i < inputs; ++i) fractions[i] = fraction(i);
    evaluate_into(0);
    for (std::size_t i = 0; i < inputs; ++i) {
      fractions[i] = fraction(inputs + i);
      evaluate_into(i + 2);
      fractions[i] = fraction(i);
    }
  });
  return values;
}

// 1 - sum(numerator)/sum(denominator), or the ratio itself, over the randomisations; the error by
// the residuals of the ratio (the delta method).
EstimatedIndex ratio_estimate(const Eigen::ArrayXd& numerator, const Eigen::ArrayXd& denominator,
                              bool complement, double confidence) {
  const auto count = static_cast<double>(numerator.size());
  const double ratio = numerator.sum() / denominator.sum();
  const Eigen::ArrayXd residual = (numerator - ratio * denominator) / denominator.mean();
  EstimatedIndex index;
  index.value = complement ? 1.0 - ratio : ratio;
  index.standard_error = std::sqrt(residual.square().sum() / (count * (count - 1.0)));
  const double reach = student_quantile(0.5 + 0.5 * confidence, count - 1.0) * index.standard_error;
  index.lower = index.value - reach;
  index.upper = index.value + reach;
  return index;
}

double error_of_mean(const Eigen::ArrayXd& values) {
  const auto count = static_cast<double>(values.size());
  return std::sqrt((values - values.mean()).square().sum() / (count * (count - 1.0)));
}

// Moments of one output, by randomisation; about one centre for all, against cancellation.
struct Moments {
  Eigen::ArrayXd mean, variance;
  Eigen::ArrayXXd first_numerator, first_denominator, total_numerator;  // by input
  double largest = 0.0;

  Moments(Eigen::Index randomisations, Eigen::Index inputs)
      : mean(randomisations),
        variance(randomisations),
        first_numerator(randomisations, inputs),
        first_denominator(randomisations, inputs),
        total_numerator(randomisations, inputs) {}

  void take(Eigen::Index r, const Values& values, Eigen::Index output) {
    const Eigen::ArrayXd a = values[0].col(output);
    const Eigen::ArrayXd b = values[1].col(output);
    mean[r] = 0.5 * (a.mean() + b.mean());
    variance[r] = 0.5 * ((a - mean[r]).square().mean() + (b - mean[r]).square().mean());
    largest = std::max({largest, a.abs().maxCoeff(), b.abs().maxCoeff()});
    for (Eigen::Index i = 0; i < first_numerator.cols(); ++i) {
      const Eigen::ArrayXd mixed = values[static_cast<std::size_t>(i) + 2].col(output);
      const double centre = 0.5 * (b.mean() + mixed.mean());
      first_denominator(r, i) =
          0.5 * ((b - centre).square().mean() + (mixed - centre).square().mean());
      first_numerator(r, i) = 0.5 * (b - mixed).square().mean();
      total_numerator(r, i) = 0.5 * (a - mixed).square().mean();
      largest = std::max(largest, mixed.abs().maxCoeff());
    }
  }
};

SobolIndices indices_of(const Moments& moments, double confidence) {
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  SobolIndices result;
  result.mean = moments.mean.mean();
  result.mean_error = error_of_mean(moments.mean);
  result.variance = moments.variance.mean();
  result.variance_error = error_of_mean(moments.variance);
  const double varying =
      std::max(moments.variance.maxCoeff(), moments.first_denominator.maxCoeff());
  result.constant = std::sqrt(varying) <= 1e-12 * moments.largest;
  result.inputs.resize(static_cast<std::size_t>(moments.first_numerator.cols()));
  result.interactions = result.constant ? nothing : 1.0;
  Eigen::Index i = 0;
  for (InputIndices& input : result.inputs) {
    if (result.constant) {
      input.first_order = input.total = {nothing, nothing, nothing, nothing};
    } else {
      input.first_order = ratio_estimate(moments.first_numerator.col(i),
                                         moments.first_denominator.col(i), true, confidence);
      input.total =
          ratio_estimate(moments.total_numerator.col(i), moments.variance, false, confidence);
      result.interactions -= input.first_order.value;
    }
    ++i;
  }
  return result;
}

}  // namespace

Eigen::MatrixXd scrambled_sobol_points(std::size_t points, std::size_t dimensions,
                                       std::uint64_t seed) {
  check_points("scrambled_sobol_points", points, 1);
  if (dimensions < 1 || dimensions > 1000) {
    throw InvalidInput(
        fmt::format("scrambled_sobol_points: expected 1 to 1000 dimensions, found {}", dimensions));
  }
  boost::random::sobol sequence(dimensions);
  Eigen::MatrixXd result(static_cast<Eigen::Index>(points), static_cast<Eigen::Index>(dimensions));
  for (Eigen::Index n = 0; n < result.rows(); ++n) {
    for (Eigen::Index j = 0; j < result.cols(); ++j) {
      // Boost leaves out the sequence's first point, the origin; without it the others do not
      // balance.
      const std::uint64_t digits = n == 0 ? 0 : sequence();
      result(n, j) = scrambled(digits, numerics::splitmix64(seed, static_cast<std::uint64_t>(j)));
    }
  }
  return result;
}

SobolResult sobol_indices(std::size_t inputs, std::size_t outputs, const QuantileFunction& function,
                          const SobolOptions& options) {
  check(inputs, outputs, options);
  const auto rounds = static_cast<Eigen::Index>(options.randomisations);
  std::vector<Moments> moments(outputs, Moments(rounds, static_cast<Eigen::Index>(inputs)));
  for (Eigen::Index r = 0; r < rounds; ++r) {
    const Eigen::MatrixXd points =
        scrambled_sobol_points(options.points, 2 * inputs,
                               numerics::splitmix64(options.seed, static_cast<std::uint64_t>(r)));
    const Values values =
        evaluate(points, static_cast<Eigen::Index>(outputs), function, options.threads);
    for (std::size_t o = 0; o < outputs; ++o) {
      moments[o].take(r, values, static_cast<Eigen::Index>(o));
    }
  }
  SobolResult result;
  for (const Moments& one : moments) {
    result.outputs.push_back(indices_of(one, options.confidence));
  }
  result.evaluations = options.randomisations * options.points * (inputs + 2);
  return result;
}

}  // namespace boresight::numerics
