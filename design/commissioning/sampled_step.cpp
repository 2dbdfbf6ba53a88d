#include <algorithm>
#include <cmath>
#include <limits>

#include <boresight/design/commissioning/sampled_step.hpp>

namespace boresight::design {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double settled = 0.05;

// First time at which the samples reach a level.
double time_at(const VectorXd& response, double level, double sample_time) {
  for (Index k = 1; k < response.size(); ++k) {
    if (response[k] < level) continue;
    const double part = (level - response[k - 1]) / (response[k] - response[k - 1]);
    return sample_time * (static_cast<double>(k - 1) + std::clamp(part, 0.0, 1.0));
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace

double rise_time(const VectorXd& response, double sample_time) {
  const double high = time_at(response, 0.9, sample_time);
  return std::isfinite(high) ? high - time_at(response, 0.1, sample_time) : high;
}

Index settled_from(const VectorXd& response) {
  Index last = response.size() - 1;
  while (last >= 0 && std::abs(response[last] - 1.0) <= settled) --last;
  return last + 1;
}

}  // namespace boresight::design
