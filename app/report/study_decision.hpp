#pragma once

#include <optional>
#include <string>
#include <vector>

#include <boresight/app/report/report.hpp>

namespace boresight::app {

// The decision of a study by itself, as decision(const Report&).
std::vector<std::string> decision(const MatchSection& section);
std::vector<std::string> decision(const EvaluateSection& section);
std::vector<std::string> decision(const TuneSection& section,
                                  const std::optional<TimeDomainSection>& time_domain,
                                  const std::optional<design::PointingLimit>& limit);

}  // namespace boresight::app
