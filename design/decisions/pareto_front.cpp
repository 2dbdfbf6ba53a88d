#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

#include <fmt/format.h>

#include <boresight/design/decisions/pareto_front.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::design {

std::vector<std::size_t> pareto_front(const std::vector<CostPoint>& points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (std::isnan(points[i].cost) || std::isnan(points[i].quantity)) {
      throw InvalidInput(fmt::format("pareto_front: expected numbers, found NaN in point {}", i));
    }
  }
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::tie(points[a].cost, points[a].quantity, a) <
           std::tie(points[b].cost, points[b].quantity, b);
  });
  std::vector<std::size_t> front;
  for (const std::size_t i : order) {
    const bool first = front.empty() || points[i].quantity < points[front.back()].quantity;
    const bool equal = !front.empty() && points[i].quantity == points[front.back()].quantity &&
                       points[i].cost == points[front.back()].cost;
    if (first || equal) front.push_back(i);
  }
  return front;
}

std::vector<double> front_fractions(const std::vector<double>& costs,
                                    const Eigen::MatrixXd& quantities) {
  if (quantities.rows() < 1 || static_cast<std::size_t>(quantities.cols()) != costs.size()) {
    throw InvalidInput(fmt::format(
        "front_fractions: expected at least one sample (rows) of {} options (columns), as "
        "many as costs, found {} x {}",
        costs.size(), quantities.rows(), quantities.cols()));
  }
  std::vector<double> fractions(costs.size(), 0.0);
  std::vector<CostPoint> points(costs.size());
  for (Eigen::Index n = 0; n < quantities.rows(); ++n) {
    for (std::size_t i = 0; i < costs.size(); ++i) {
      points[i] = {costs[i], quantities(n, static_cast<Eigen::Index>(i))};
    }
    for (const std::size_t i : pareto_front(points)) fractions[i] += 1.0;
  }
  for (double& fraction : fractions) fraction /= static_cast<double>(quantities.rows());
  return fractions;
}

}  // namespace boresight::design
