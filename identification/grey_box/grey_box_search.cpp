#include <cmath>
#include <limits>

#include <boresight/identification/grey_box/grey_box_search.hpp>
#include <boresight/numerics/normal_numbers.hpp>
#include <boresight/numerics/semidefinite_factor.hpp>

namespace boresight::identification {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

numerics::LeastSquaresResult search(const GreyBoxObjective& objective, const VectorXd& start,
                                    const numerics::LeastSquaresOptions& options) {
  const Index n = start.size();
  const auto model = [&](const VectorXd& point, VectorXd& residuals, MatrixXd* jacobian) {
    residuals.setZero(2 * n + 1);
    if (jacobian == nullptr) {
      residuals(0) = std::sqrt(objective.sum_of_squares(point) + point.squaredNorm());
      return;
    }
    // Rows with the products of the data's and the priors' rows, which keep them well apart from
    // singular.
    MatrixXd products = objective.products(point);
    products.topLeftCorner(n, n).diagonal().array() += 1.0;
    products.topRightCorner(n, 1) += point;
    products.bottomLeftCorner(1, n) += point.transpose();
    products(n, n) += point.squaredNorm();
    products = (0.5 * (products + products.transpose())).eval();
    jacobian->setZero(2 * n + 1, n);
    if (!products.allFinite()) {
      residuals.setConstant(std::numeric_limits<double>::quiet_NaN());
      return;
    }
    const MatrixXd rows =
        numerics::semidefinite_factor(products, "products of the prediction errors").transpose();
    residuals.head(rows.rows()) = rows.col(n);
    jacobian->topRows(rows.rows()) = rows.leftCols(n);
  };
  numerics::LeastSquaresOptions deriving = options;
  deriving.derive_when_trying = true;
  return numerics::least_squares(model, start, deriving);
}

numerics::LeastSquaresResult search_with_scales(GreyBoxObjective& objective,
                                                const VectorXd& start) {
  // While the scales still move, an optimum need not be found to the last digit.
  numerics::LeastSquaresOptions rough;
  rough.iterations = 40;
  rough.cost_tolerance = 1e-4;
  rough.step_tolerance = 1e-4;
  numerics::LeastSquaresOptions fine = rough;
  fine.cost_tolerance = fine.step_tolerance = 1e-6;
  objective.reweigh(start);
  auto result = search(objective, start, rough);
  int iterations = result.iterations;
  for (int turn = 0; turn < 8 && objective.reweigh(result.x) >= 0.03; ++turn) {
    result = search(objective, result.x, rough);
    iterations += result.iterations;
  }
  result = search(objective, result.x, fine);
  result.iterations += iterations;
  return result;
}

VectorXd drawn_start(const GreyBoxParameters& parameters, std::uint64_t seed,
                     std::uint64_t number) {
  const numerics::NormalNumbers numbers(seed, number);
  VectorXd point(parameters.size());
  for (Index i = 0; i < point.size(); ++i) {
    const auto& p = parameters.list()[static_cast<std::size_t>(i)];
    const bool guessed = !p.from_drawings && p.spread > 0.0 && p.logarithmic;
    point(i) = guessed ? 0.7 * numbers.pair(static_cast<std::uint64_t>(i)).real() : 0.0;
  }
  return point;
}

}  // namespace boresight::identification
