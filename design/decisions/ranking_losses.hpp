#pragma once

#include <vector>

#include <boresight/design/decisions/decision_statistics.hpp>

namespace boresight::design {

/// What of an option's distribution of losses options are ranked by.
enum class LossMeasure {
  mean,
  quantile_95,  // that 95 % of the draws do not exceed
  median,
};
std::string_view to_string(LossMeasure measure);

struct RankingLosses {
  LossMeasure measure = LossMeasure::mean;
  std::vector<double> losses;  // one an option
};

/// Losses by which options can be told apart: their means, if one that is fit (of all where none
/// is) has a finite one. Each of those that fails on some draw has none, and of infinite means the
/// cheapest would be as good as any: then the loss that 95 % of the draws do not exceed, or where
/// that is infinite for each of them too, the median. `fit`: one an option.
/// @throws InvalidInput for sizes that differ.
RankingLosses ranking_losses(const std::vector<OptionStatistics>& options,
                             const std::vector<bool>& fit);

}  // namespace boresight::design
