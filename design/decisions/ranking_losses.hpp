#pragma once

#include <vector>

#include <boresight/design/decisions/decision_statistics.hpp>

namespace boresight::design {

/// Statistic of an option's loss distribution by which options are ranked.
enum class LossMeasure {
  mean,
  quantile_95,  // not exceeded in 95 % of the samples
  median,
};
std::string_view to_string(LossMeasure measure);

struct RankingLosses {
  LossMeasure measure = LossMeasure::mean;
  std::vector<double> losses;  // one per option
};

/// Losses by which options can be distinguished. The means are used if one eligible option (any
/// option where none is eligible) has a finite mean. An option that fails on some sample has an
/// infinite mean, and infinite means would all tie. If all are infinite, the 95 % quantile is used;
/// if that is infinite for all too, the median. `fit`: eligibility, one per option.
/// @throws InvalidInput for sizes that differ.
RankingLosses ranking_losses(const std::vector<OptionStatistics>& options,
                             const std::vector<bool>& fit);

}  // namespace boresight::design
