#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <boresight/design/decisions/sample_information.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::design {
namespace {

constexpr Eigen::Index folds = 10;
constexpr std::array<std::size_t, 5> curved_columns{0, 1, 2, 4, 6};

double error_of_mean(const Eigen::ArrayXd& values) {
  const auto count = static_cast<double>(values.size());
  return std::sqrt((values - values.mean()).square().sum() / (count * (count - 1.0)));
}

// Knots of a natural cubic spline with `curved` columns besides the straight line: two more than
// these, at even quantiles from 5 % to 95 % (Harrell's choice), equal ones left out.
std::vector<double> knots_of(const std::vector<double>& sorted, std::size_t curved) {
  std::vector<double> knots;
  if (curved == 0) return knots;
  for (std::size_t k = 0; k < curved + 2; ++k) {
    const double fraction = 0.05 + 0.9 * static_cast<double>(k) / static_cast<double>(curved + 1);
    const double knot =
        sorted[static_cast<std::size_t>(fraction * static_cast<double>(sorted.size() - 1))];
    if (knots.empty() || knot > knots.back()) knots.push_back(knot);
  }
  return knots;
}

// Columns 1, x and the truncated cubes that are straight beyond the outer knots; x is scaled to
// the range of the samples, so that the columns are of one size.
Eigen::MatrixXd spline_columns(const Eigen::ArrayXd& x, std::vector<double> knots, double low,
                               double high) {
  const auto scaled = [&](double value) { return (value - low) / (high - low); };
  for (double& knot : knots) knot = scaled(knot);
  const std::size_t curved = knots.size() < 3 ? 0 : knots.size() - 2;
  Eigen::MatrixXd columns(x.size(), static_cast<Eigen::Index>(curved) + 2);
  const auto cube = [](double value) { return value > 0.0 ? value * value * value : 0.0; };
  for (Eigen::Index n = 0; n < x.size(); ++n) {
    const double at = scaled(x[n]);
    columns(n, 0) = 1.0;
    columns(n, 1) = at;
    for (std::size_t k = 0; k < curved; ++k) {
      const double last = knots[curved + 1];
      const double before = knots[curved];
      columns(n, static_cast<Eigen::Index>(k) + 2) =
          cube(at - knots[k]) - cube(at - before) * (last - knots[k]) / (last - before) +
          cube(at - last) * (before - knots[k]) / (last - before);
    }
  }
  return columns;
}

// Least squares by Gram and Schmidt's orthogonalisation, done twice, over the rows chosen; applied
// to all rows. A column that the ones before it explain is left out.
struct Regression {
  Eigen::MatrixXd fitted;  // of every row, by target
  std::size_t rank = 0;
};

Regression regress(Eigen::MatrixXd columns, const Eigen::MatrixXd& targets,
                   const Eigen::ArrayXd& chosen) {
  Regression result{Eigen::MatrixXd::Zero(targets.rows(), targets.cols())};
  Eigen::MatrixXd rest = chosen.matrix().asDiagonal() * targets;
  std::vector<Eigen::Index> kept;
  const auto inner = [&](Eigen::Index a, Eigen::Index b) {
    return (columns.col(a).array() * columns.col(b).array() * chosen).sum();
  };
  for (Eigen::Index j = 0; j < columns.cols(); ++j) {
    const double before = std::sqrt(inner(j, j));
    for (int pass = 0; pass < 2; ++pass) {
      for (const Eigen::Index k : kept) columns.col(j) -= inner(k, j) * columns.col(k);
    }
    const double norm = std::sqrt(inner(j, j));
    if (!(norm > 1e-9 * before)) continue;
    columns.col(j) /= norm;
    kept.push_back(j);
    const Eigen::RowVectorXd coefficients = columns.col(j).transpose() * rest;
    result.fitted += columns.col(j) * coefficients;
    rest -= (columns.col(j).array() * chosen).matrix() * coefficients;
  }
  result.rank = kept.size();
  return result;
}

// The option that a row of fitted differences promises the least loss of.
Eigen::Index choice_in(const Eigen::MatrixXd& fitted, Eigen::Index row) {
  Eigen::Index best = 0;
  fitted.row(row).minCoeff(&best);
  return best;
}

// Losses less those of the choice made without knowing more; column `choice` is 0.
Eigen::MatrixXd differences(const Eigen::MatrixXd& losses, Eigen::Index choice) {
  return losses.colwise() - losses.col(choice);
}

// What each sample gains if the choice follows the fit.
Eigen::ArrayXd gains(const Eigen::MatrixXd& differences, const Eigen::MatrixXd& fitted) {
  Eigen::ArrayXd result(differences.rows());
  for (Eigen::Index n = 0; n < result.size(); ++n) {
    result[n] = -differences(n, choice_in(fitted, n));
  }
  return result;
}

InputValue value_of(const Eigen::ArrayXd& input, const Eigen::MatrixXd& difference) {
  InputValue result;
  const double low = input.minCoeff();
  const double high = input.maxCoeff();
  if (!(high > low)) return result;
  std::vector<double> sorted(input.begin(), input.end());
  std::sort(sorted.begin(), sorted.end());
  const auto count = static_cast<double>(input.size());
  const Eigen::ArrayXd everything = Eigen::ArrayXd::Ones(input.size());
  // Generalised cross-validation, the targets' errors added up: mean square over (1 - rank/n)^2.
  Eigen::MatrixXd columns = Eigen::MatrixXd::Ones(input.size(), 1);
  Regression best = regress(columns, difference, everything);
  const auto score = [&](const Regression& one) {
    const double left = 1.0 - static_cast<double>(one.rank) / count;
    return (difference - one.fitted).squaredNorm() / (left * left);
  };
  double minimum = score(best);
  for (const std::size_t curved : curved_columns) {
    const Eigen::MatrixXd tried = spline_columns(input, knots_of(sorted, curved), low, high);
    Regression one = regress(tried, difference, everything);
    const double its = score(one);
    if (its < minimum) {
      minimum = its;
      best = std::move(one);
      columns = tried;
    }
  }
  result.coefficients = best.rank;
  // The fitted losses have the same mean gain as the samples' own losses, and less variance.
  result.fitted.gain = std::max(0.0, -best.fitted.rowwise().minCoeff().mean());
  result.fitted.standard_error = error_of_mean(gains(difference, best.fitted));

  Eigen::MatrixXd unseen(difference.rows(), difference.cols());
  for (Eigen::Index fold = 0; fold < folds; ++fold) {
    Eigen::ArrayXd chosen = everything;
    for (Eigen::Index n = fold; n < chosen.size(); n += folds) chosen[n] = 0.0;
    const Regression part = regress(columns, difference, chosen);
    for (Eigen::Index n = fold; n < chosen.size(); n += folds) unseen.row(n) = part.fitted.row(n);
  }
  const Eigen::ArrayXd honest = gains(difference, unseen);
  result.held_out_gain = honest.mean();
  result.held_out_error = error_of_mean(honest);
  return result;
}

void check(const Eigen::MatrixXd& inputs, const Eigen::MatrixXd& losses) {
  if (losses.rows() < 100 || losses.cols() < 2) {
    throw InvalidInput(
        fmt::format("sample_information: expected at least 100 samples (rows) of at least 2 "
                    "options (columns), found {} x {}",
                    losses.rows(), losses.cols()));
  }
  if (inputs.rows() != losses.rows()) {
    throw InvalidInput(
        fmt::format("sample_information: expected as many samples of the inputs as of the "
                    "losses, {}, found {}",
                    losses.rows(), inputs.rows()));
  }
  if (!inputs.allFinite() || !losses.allFinite()) {
    throw InvalidInput(
        "sample_information: expected finite inputs and losses: give a failed option the loss that "
        "its "
        "failure would cost");
  }
}

}  // namespace

SampleInformation sample_information(const Eigen::MatrixXd& inputs, const Eigen::MatrixXd& losses) {
  check(inputs, losses);
  SampleInformation result;
  const Eigen::RowVectorXd means = losses.colwise().mean();
  result.mean_loss.assign(means.begin(), means.end());
  Eigen::Index choice = 0;
  means.minCoeff(&choice);
  result.choice = static_cast<std::size_t>(choice);
  const Eigen::MatrixXd difference = differences(losses, choice);
  const Eigen::ArrayXd perfect = -difference.rowwise().minCoeff();
  result.perfect = {perfect.mean(), error_of_mean(perfect)};
  for (Eigen::Index i = 0; i < inputs.cols(); ++i) {
    result.inputs.push_back(value_of(inputs.col(i), difference));
  }
  return result;
}

}  // namespace boresight::design
