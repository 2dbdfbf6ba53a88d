#include <algorithm>
#include <cmath>

#include <boresight/identification/grey_box/record_influence.hpp>
#include <boresight/numerics/semidefinite_factor.hpp>
#include <boresight/numerics/statistics/lognormal_interval.hpp>

namespace boresight::identification {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

std::vector<RecordInfluence> record_influences(const GreyBoxObjective& objective,
                                               const std::vector<GreyBoxRecord>& records,
                                               const GreyBoxParameters& parameters,
                                               const GreyBoxPosterior& posterior) {
  const Index n = posterior.point.size();
  const MatrixXd identity = MatrixXd::Identity(n, n);
  const VectorXd gradient = log_gradient(parameters, posterior.point, &DriveEstimate::inertia);
  const VectorXd as_recorded =
      log_gradient(parameters, posterior.point, &DriveEstimate::inertia_as_recorded);
  const double inertia = drive_estimate(parameters, posterior.point).inertia;
  const double formal = gradient.dot(posterior.formal * gradient);
  const double variance = gradient.dot(posterior.covariance * gradient);
  const double inflation = variance / formal;
  std::vector<MatrixXd> products(records.size(), MatrixXd::Zero(n + 1, n + 1));
  MatrixXd all = MatrixXd::Zero(n, n);
  for (std::size_t c = 0; c < objective.channels().size(); ++c) {
    const MatrixXd own = objective.products(posterior.point, c);
    products[objective.channels()[c].record] += own;
    all += own.topLeftCorner(n, n);
  }
  std::vector<RecordInfluence> influences;
  for (std::size_t k = 0; k < records.size(); ++k) {
    MatrixXd information = all - products[k].topLeftCorner(n, n) + identity;
    information = (0.5 * (information + information.transpose())).eval();
    const MatrixXd without =
        numerics::positive_definite_solve(information, identity, "information without a record");
    const double shift = gradient.dot(without * products[k].col(n).head(n));
    const double more = std::max(0.0, gradient.dot(without * gradient) - formal);
    RecordInfluence influence;
    influence.record = records[k].name;
    influence.inertia = numerics::lognormal_interval(
        inertia * std::exp(shift),
        std::hypot(std::sqrt(variance + inflation * more), posterior.torque_discrepancy));
    influence.change = std::expm1(-shift);
    influence.information = 1.0 - as_recorded.dot(posterior.formal * as_recorded) /
                                      as_recorded.dot(without * as_recorded);
    influences.push_back(influence);
  }
  return influences;
}

}  // namespace boresight::identification
