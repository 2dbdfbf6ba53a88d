#include <algorithm>
#include <cmath>
#include <limits>

#include <boresight/design/decisions/ranking_losses.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::design {
namespace {

double quantile_at(const OptionStatistics& option, double fraction) {
  const auto found = std::ranges::find(option.quantiles, fraction, &Quantile::fraction);
  return found == option.quantiles.end() ? std::numeric_limits<double>::infinity() : found->value;
}

double loss_of(const OptionStatistics& option, LossMeasure measure) {
  switch (measure) {
    case LossMeasure::mean:
      return option.mean;
    case LossMeasure::quantile_95:
      return quantile_at(option, 0.95);
    case LossMeasure::median:
      return quantile_at(option, 0.5);
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace

std::string_view to_string(LossMeasure measure) {
  switch (measure) {
    case LossMeasure::mean:
      return "mean";
    case LossMeasure::quantile_95:
      return "quantile_95";
    case LossMeasure::median:
      return "median";
  }
  return "";
}

RankingLosses ranking_losses(const std::vector<OptionStatistics>& options,
                             const std::vector<bool>& fit) {
  if (options.size() != fit.size()) {
    throw InvalidInput("ranking_losses: expected for each option whether it is fit");
  }
  const bool none_fit = std::ranges::find(fit, true) == fit.end();
  const auto decides = [&](LossMeasure measure) {
    for (std::size_t i = 0; i < options.size(); ++i) {
      if ((fit[i] || none_fit) && std::isfinite(loss_of(options[i], measure))) return true;
    }
    return false;
  };
  RankingLosses ranking;
  ranking.measure = LossMeasure::median;
  for (const LossMeasure measure : {LossMeasure::mean, LossMeasure::quantile_95}) {
    if (decides(measure)) {
      ranking.measure = measure;
      break;
    }
  }
  for (const auto& option : options) ranking.losses.push_back(loss_of(option, ranking.measure));
  return ranking;
}

}  // namespace boresight::design
