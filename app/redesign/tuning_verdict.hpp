#pragma once

#include <optional>
#include <string>
#include <vector>

#include <boresight/app/report/report.hpp>

namespace boresight::app {

/// "is met up to 10.1 m/s", with what ends it where that is the supply, and with the share of the
/// climate's time.
std::string met_text(const TuningSection& section, const BudgetResult& budget);

/// In one or two sentences each budget that states a wind speed it is needed up to and is not met
/// so far by a law that is good otherwise: by the linear plant, or in the wind of the run on the
/// nonlinear antenna, if that is no more; none without such a law.
std::vector<std::string> unmet_needs(const TuningSection& section,
                                     const std::optional<TimeDomainSection>& time_domain);

/// What the report's linear study leaves out for want of a [simulation]; empty if it has one or if
/// no law was good enough to run.
std::string not_examined(const Report& report);

/// Appends what the tuned loops mean, the present gains first.
void conclude_tuning(const Report& report, const TuningSection& section,
                     std::vector<std::string>& sentences);

/// For the decision box: what is needed and not met, a warning of each unstable present law, then
/// one sentence of the law.
std::vector<std::string> decide_tuning(const Report& report, const TuningSection& section);

/// What that decision rests on or leaves open, each in a sentence or two; none if no law was good
/// enough to decide on.
std::vector<std::string> tuning_reservations(const Report& report, const TuningSection& section);

}  // namespace boresight::app
