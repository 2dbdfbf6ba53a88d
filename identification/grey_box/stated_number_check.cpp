#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <boresight/identification/grey_box/stated_number_check.hpp>
#include <boresight/numerics/statistics/lognormal_interval.hpp>

namespace boresight::identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using P = GreyBoxParameters;

constexpr double nearly_as_well = 0.5;  // of a standard uncertainty
constexpr double gross_errors = 0.02;   // one number of fifty
constexpr double gross_size = 10.0;     // times the stated uncertainty

StatedNumberCheck stated(const std::string& name, VectorXd direction, double spread) {
  StatedNumberCheck check;
  check.name = name;
  check.stated_uncertainty = spread;
  check.direction = std::move(direction);
  return check;
}

std::vector<StatedNumberCheck> stated_numbers(const P& parameters) {
  std::vector<StatedNumberCheck> numbers;
  const Index n = parameters.size();
  const auto& list = parameters.list();
  for (Index i = 0; i < n; ++i) {
    const GreyBoxParameter& one = list[static_cast<std::size_t>(i)];
    if (!one.from_drawings || !(one.spread > 0.0)) continue;
    numbers.push_back(stated(one.name, VectorXd::Unit(n, i), one.spread));
  }
  const double torque = list[P::torque_factor].spread;
  const double flow = list[P::flow_factor].spread;
  if (torque > 0.0 && flow > 0.0) {
    VectorXd both = VectorXd::Zero(n);
    both(P::torque_factor) = 1.0 / torque;
    both(P::flow_factor) = 1.0 / flow;
    const double size = both.norm();
    numbers.push_back(stated("displacement", both / size, 1.0 / size));
  }
  return numbers;
}

double deviation(const MatrixXd& covariance, const VectorXd& direction) {
  return std::sqrt(std::max(0.0, direction.dot(covariance * direction)));
}

}  // namespace

GreyBoxPosterior without_stated_number(const GreyBoxPosterior& posterior,
                                       const VectorXd& direction) {
  // The records' information of the number in that of its prior; none counts as an uncertainty of
  // a hundred times the stated one.
  constexpr double no_information = 1e-4;
  const VectorXd moved = posterior.formal * direction;
  const double information = std::max(1.0 - direction.dot(moved), no_information);
  // By rank-one updates of the normal equations: where the optimum goes, the answer of any shift of
  // the optimum, and the prior's own scatter out of the covariance.
  const VectorXd formal = moved / information;
  const MatrixXd answer =
      MatrixXd::Identity(direction.size(), direction.size()) + formal * direction.transpose();
  GreyBoxPosterior without = posterior;
  without.point += formal * direction.dot(posterior.point);
  without.formal += formal * moved.transpose();
  without.misfit = answer * posterior.misfit * answer.transpose();
  without.covariance =
      answer * posterior.covariance * answer.transpose() - formal * formal.transpose();
  without.covariance = (0.5 * (without.covariance + without.covariance.transpose())).eval();
  return without;
}

std::vector<StatedNumberCheck> check_stated_numbers(const P& parameters,
                                                    const GreyBoxPosterior& posterior) {
  const VectorXd gradient = log_gradient(parameters, posterior.point, &DriveEstimate::inertia);
  const double inertia = drive_estimate(parameters, posterior.point).inertia;
  const double of_inertia =
      std::hypot(deviation(posterior.covariance, gradient), posterior.torque_discrepancy);
  std::vector<StatedNumberCheck> checks = stated_numbers(parameters);
  for (StatedNumberCheck& check : checks) {
    const VectorXd& u = check.direction;
    const double relative = check.stated_uncertainty;
    const GreyBoxPosterior without = without_stated_number(posterior, u);
    const double distance = u.dot(without.point);
    const double spread = deviation(without.covariance, u);
    const double both = std::hypot(spread, 1.0);
    check.by_others =
        numerics::lognormal_interval(std::exp(relative * distance), relative * spread);
    check.departure = distance / both;
    check.visible_error = std::expm1(StatedNumberCheck::contradicted_beyond * relative * both);
    check.inertia_effect = gradient.dot(posterior.formal * u) / relative;
    const double shift = gradient.dot(without.point - posterior.point);
    check.inertia = numerics::lognormal_interval(
        inertia * std::exp(shift),
        std::hypot(deviation(without.covariance, gradient), posterior.torque_discrepancy));
    check.moves_inertia = u(P::supply_torque) != 0.0 ||
                          (u.tail(u.size() - P::modes).isZero() && std::abs(shift) >= of_inertia);
  }
  return checks;
}

std::vector<StatedNumberCheck> departing_numbers(const std::vector<StatedNumberCheck>& checks,
                                                 double beyond, StatedNumbers which) {
  const auto departure = [](const StatedNumberCheck& one) { return std::abs(one.departure); };
  std::vector<StatedNumberCheck> departing;
  std::ranges::copy_if(checks, std::back_inserter(departing), [&](const StatedNumberCheck& one) {
    return which == StatedNumbers::all || one.moves_inertia;
  });
  const auto is_tenfold = [](const StatedNumberCheck& one) {
    return std::abs(std::log(one.by_others.value)) > std::numbers::ln10;
  };
  if (std::ranges::any_of(departing, [&](const StatedNumberCheck& one) {
        return departure(one) >= beyond && !is_tenfold(one);
      })) {
    std::erase_if(departing, is_tenfold);
  }
  std::ranges::stable_sort(departing, std::ranges::greater{}, departure);
  if (departing.empty() || departure(departing.front()) < beyond) return {};
  const double least = departure(departing.front()) - nearly_as_well;
  std::erase_if(departing, [&](const StatedNumberCheck& one) { return departure(one) < least; });
  return departing;
}

std::vector<double> gross_error_probabilities(const std::vector<StatedNumberCheck>& checks) {
  // Densities of the departure with a gross error over that without.
  std::vector<double> odds;
  for (const auto& one : checks) {
    const double spread =
        one.by_others.standard_uncertainty / (one.by_others.value * one.stated_uncertainty);
    const double ratio = (1.0 + spread * spread) / (gross_size * gross_size + spread * spread);
    const double square = one.departure * one.departure;
    odds.push_back(one.moves_inertia ? gross_errors / (1.0 - gross_errors) * std::sqrt(ratio) *
                                           std::exp(0.5 * square * (1.0 - ratio))
                                     : 0.0);
  }
  const double all = 1.0 + std::accumulate(odds.begin(), odds.end(), 0.0);
  for (double& one : odds) one /= all;
  return odds;
}

std::vector<DriveEstimate> samples_in_doubt(const P& parameters, const GreyBoxPosterior& posterior,
                                            const std::vector<StatedNumberCheck>& checks, int count,
                                            std::uint64_t seed) {
  const auto probabilities = gross_error_probabilities(checks);
  std::vector<std::vector<DriveEstimate>> by_number;
  for (const auto& one : checks) {
    by_number.push_back(posterior_samples(
        parameters, without_stated_number(posterior, one.direction), count, seed));
  }
  auto samples = posterior_samples(parameters, posterior, count, seed);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    // Every stretch of the samples has about the same share of each.
    double place = std::fmod((static_cast<double>(i) + 0.5) / std::numbers::phi, 1.0);
    for (std::size_t k = 0; k < checks.size(); ++k) {
      if (place < probabilities[k]) {
        samples[i] = by_number[k][i];
        break;
      }
      place -= probabilities[k];
    }
  }
  return samples;
}

}  // namespace boresight::identification
