#include <algorithm>
#include <cmath>
#include <limits>

#include <boresight/design/decisions/weighed_losses.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::design {
namespace {

double quantile_at(const OptionStatistics& option, double share) {
  const auto found = std::ranges::find(option.quantiles, share, &Quantile::share);
  return found == option.quantiles.end() ? std::numeric_limits<double>::infinity() : found->value;
}

double loss_of(const OptionStatistics& option, WeighedBy measure) {
  switch (measure) {
    case WeighedBy::mean:
      return option.mean;
    case WeighedBy::upper_quantile:
      return quantile_at(option, 0.95);
    case WeighedBy::median:
      return quantile_at(option, 0.5);
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace

std::string_view to_string(WeighedBy measure) {
  switch (measure) {
    case WeighedBy::mean:
      return "mean";
    case WeighedBy::upper_quantile:
      return "quantile_95";
    case WeighedBy::median:
      return "median";
  }
  return "";
}

WeighedLosses weigh_losses(const std::vector<OptionStatistics>& options,
                           const std::vector<bool>& fit) {
  if (options.size() != fit.size()) {
    throw InvalidInput("weigh_losses: expected for each option whether it is fit");
  }
  const bool none_fit = std::ranges::find(fit, true) == fit.end();
  const auto decides = [&](WeighedBy measure) {
    for (std::size_t i = 0; i < options.size(); ++i) {
      if ((fit[i] || none_fit) && std::isfinite(loss_of(options[i], measure))) return true;
    }
    return false;
  };
  WeighedLosses weighed;
  weighed.by = WeighedBy::median;
  for (const WeighedBy measure : {WeighedBy::mean, WeighedBy::upper_quantile}) {
    if (decides(measure)) {
      weighed.by = measure;
      break;
    }
  }
  for (const auto& option : options) weighed.losses.push_back(loss_of(option, weighed.by));
  return weighed;
}

}  // namespace boresight::design
