#pragma once

#include <boresight/design/ensembles/monte_carlo_statistics.hpp>
#include <boresight/io/description/visitor.hpp>

namespace boresight::io {

// Numbers estimated from samples; `key` without the unit, which the members' own keys do not name.

void describe_estimate(Visitor& v, std::string_view key, const design::EstimatedNumber& estimate,
                       const KeyUnit& unit, std::string_view meaning);
void describe_distribution(Visitor& v, std::string_view key,
                           const design::DistributionSummary& summary, const KeyUnit& unit,
                           std::string_view meaning);
/// null where there is none.
void describe_distribution(Visitor& v, std::string_view key,
                           const std::optional<design::DistributionSummary>& summary,
                           const KeyUnit& unit, std::string_view meaning);

}  // namespace boresight::io
