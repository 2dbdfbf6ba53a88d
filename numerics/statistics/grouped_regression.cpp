#include <algorithm>
#include <cmath>
#include <cstddef>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include <boresight/numerics/error.hpp>
#include <boresight/numerics/statistics/grouped_regression.hpp>
#include <boresight/numerics/statistics/order_statistics.hpp>

namespace boresight::numerics {
namespace {

using Index = Eigen::Index;

constexpr Index fewest_groups = 8;
constexpr double rank_tolerance = 1e-11;

/// Sums of one group, or of all: weighted normal matrix and right-hand side.
struct NormalEquations {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd product;
};

class Regression {
 public:
  Regression(const Eigen::MatrixXd& regressors, const Eigen::VectorXd& response,
             const std::vector<Index>& group, const Eigen::VectorXd& noise_variance)
      : regressors_(regressors),
        response_(response),
        group_(group),
        noise_(noise_variance.size() > 0 ? noise_variance
                                         : Eigen::VectorXd::Zero(regressors.cols())),
        weight_(Eigen::VectorXd::Ones(response.size())) {}

  GroupedRegression fit() {
    GroupedRegression result;
    result.coefficients = solve(sum(all_groups()));
    constexpr double huber = 1.345, bisquare = 6.0;
    const auto inside = [](double r) { return 1.0 - std::min(1.0, std::pow(r / bisquare, 2)); };
    reweight(result, [](double r) { return r <= huber ? 1.0 : huber / r; });
    const Eigen::VectorXd distance =
        reweight(result, [&](double r) { return std::pow(inside(r), 2); });
    // Weights stay as they are where a group is left out, but depend on the residuals.
    const double slope =
        distance.unaryExpr([&](double r) { return inside(r) * (5.0 * inside(r) - 4.0); }).mean();
    const double growth = weight_.mean() / std::max(0.1, slope);
    const std::vector<NormalEquations> groups = all_groups();
    const NormalEquations all = sum(groups);
    result.determined = determined(all);
    Eigen::MatrixXd without(regressors_.cols(), static_cast<Index>(groups.size()));
    for (std::size_t g = 0; g < groups.size(); ++g) {
      without.col(static_cast<Index>(g)) =
          solve({all.matrix - groups[g].matrix, all.product - groups[g].product});
    }
    const Eigen::MatrixXd about = without.colwise() - without.rowwise().mean();
    const auto count = static_cast<double>(groups.size());
    result.covariance = growth * growth * (count - 1.0) / count * about * about.transpose();
    result.degrees_of_freedom = count - 1.0;
    return result;
  }

 private:
  // Absolute residuals in their standard deviation, of the last weights; zeros of an exact fit.
  template <typename WeightOf>
  Eigen::VectorXd reweight(GroupedRegression& result, const WeightOf& weight_of) {
    constexpr int rounds = 8;
    Eigen::VectorXd distance = Eigen::VectorXd::Zero(response_.size());
    for (int round = 0; round < rounds; ++round) {
      const Eigen::VectorXd residual = response_ - regressors_ * result.coefficients;
      const double deviation = median(Eigen::VectorXd(residual.cwiseAbs())) / 0.6745;
      if (!(deviation > 0.0)) break;
      distance = residual.cwiseAbs() / deviation;
      weight_ = distance.unaryExpr(weight_of);
      result.coefficients = solve(sum(all_groups()));
    }
    return distance;
  }

  std::vector<NormalEquations> all_groups() const {
    const Index columns = regressors_.cols();
    std::vector<NormalEquations> groups(
        static_cast<std::size_t>(group_.back()) + 1,
        {Eigen::MatrixXd::Zero(columns, columns), Eigen::VectorXd::Zero(columns)});
    for (Index first = 0; first < response_.size();) {
      Index last = first;
      while (last < response_.size() && of_row(last) == of_row(first)) ++last;
      const auto rows = regressors_.middleRows(first, last - first);
      const auto weights = weight_.segment(first, last - first);
      NormalEquations& own = groups[static_cast<std::size_t>(of_row(first))];
      own.matrix = rows.transpose() * weights.asDiagonal() * rows;
      own.matrix.diagonal() -= weights.sum() * noise_;
      own.product = rows.transpose() * weights.cwiseProduct(response_.segment(first, last - first));
      first = last;
    }
    return groups;
  }

  Index of_row(Index row) const { return group_[static_cast<std::size_t>(row)]; }

  static NormalEquations sum(const std::vector<NormalEquations>& groups) {
    NormalEquations all = groups.front();
    for (std::size_t g = 1; g < groups.size(); ++g) {
      all.matrix += groups[g].matrix;
      all.product += groups[g].product;
    }
    return all;
  }

  // Columns scaled to the same length.
  static Eigen::VectorXd scales(const NormalEquations& equations) {
    return equations.matrix.diagonal().unaryExpr(
        [](double square) { return square > 0.0 ? 1.0 / std::sqrt(square) : 0.0; });
  }

  static Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> directions(
      const NormalEquations& equations) {
    const Eigen::VectorXd scale = scales(equations);
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scale.asDiagonal() * equations.matrix *
                                                          scale.asDiagonal());
  }

  // Without the directions that the regressors do not move in.
  static Eigen::VectorXd solve(const NormalEquations& equations) {
    const Eigen::VectorXd scale = scales(equations);
    const auto solver = directions(equations);
    const double smallest = rank_tolerance * solver.eigenvalues().maxCoeff();
    const Eigen::VectorXd inverse = solver.eigenvalues().unaryExpr(
        [smallest](double value) { return value > smallest ? 1.0 / value : 0.0; });
    return scale.asDiagonal() *
           (solver.eigenvectors() * inverse.cwiseProduct(solver.eigenvectors().transpose() *
                                                         scale.cwiseProduct(equations.product)));
  }

  static std::vector<bool> determined(const NormalEquations& equations) {
    const auto solver = directions(equations);
    const double smallest = rank_tolerance * solver.eigenvalues().maxCoeff();
    std::vector<bool> found;
    for (Index column = 0; column < equations.matrix.cols(); ++column) {
      double beyond = 0.0;
      for (Index k = 0; k < solver.eigenvalues().size(); ++k) {
        if (solver.eigenvalues()(k) > smallest) continue;
        beyond += std::pow(solver.eigenvectors()(column, k), 2);
      }
      found.push_back(beyond < 1e-6);
    }
    return found;
  }

  const Eigen::MatrixXd& regressors_;
  const Eigen::VectorXd& response_;
  const std::vector<Index>& group_;
  Eigen::VectorXd noise_;
  Eigen::VectorXd weight_;
};

}  // namespace

GroupedRegression grouped_regression(const Eigen::MatrixXd& regressors,
                                     const Eigen::VectorXd& response,
                                     const std::vector<Index>& group,
                                     const Eigen::VectorXd& noise_variance) {
  const bool fits = regressors.rows() == response.size() &&
                    static_cast<Index>(group.size()) == response.size() &&
                    (noise_variance.size() == 0 || noise_variance.size() == regressors.cols());
  if (!fits || regressors.cols() == 0) {
    throw InvalidInput(fmt::format(
        "grouped_regression: expected a response and a group for each row and a noise variance for "
        "each column of {} x {} regressors, found {}, {} and {}",
        regressors.rows(), regressors.cols(), response.size(), group.size(),
        noise_variance.size()));
  }
  const bool rising = std::ranges::is_sorted(group) && (group.empty() || group.front() == 0);
  if (group.empty() || !rising || group.back() + 1 < fewest_groups) {
    throw InvalidInput(
        fmt::format("grouped_regression: expected rising groups from 0, at least {}, found {}",
                    fewest_groups, group.empty() ? 0 : group.back() + 1));
  }
  if (!regressors.allFinite() || !response.allFinite()) {
    throw InvalidInput("grouped_regression: expected finite numbers, found one that is not");
  }
  return Regression(regressors, response, group, noise_variance).fit();
}

}  // namespace boresight::numerics
