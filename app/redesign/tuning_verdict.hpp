#pragma once

#include <optional>
#include <string>
#include <vector>

#include <boresight/app/report/report.hpp>

namespace boresight::app {

/// "is met up to 10.1 m/s", with the supply as the cause where it sets the limit, and with the
/// fraction of the climate's time.
std::string met_text(const TuningSection& section, const BudgetResult& budget);

/// Budgets that state a required wind speed and are not met up to it by an otherwise acceptable
/// controller; one or two sentences each. Both the linear plant and the wind of the run on the
/// nonlinear antenna are considered; the lower limit counts. None without such a controller.
std::vector<std::string> unmet_needs(const TuningSection& section,
                                     const std::optional<TimeDomainSection>& time_domain);

/// Effects that the report's linear study excludes without a [simulation]; empty if the case has
/// one or if no controller was good enough to run.
std::string not_examined(const Report& report);

/// Appends what the tuned loops mean, the present gains first.
void conclude_tuning(const Report& report, const TuningSection& section,
                     std::vector<std::string>& sentences);

/// For the decision box: required budgets that are not met, a warning for each unstable present
/// controller, then one sentence on the tuned controller.
std::vector<std::string> decide_tuning(const Report& report, const TuningSection& section);

/// Assumptions and open questions of that decision, one or two sentences each; none if no
/// controller was good enough for a decision.
std::vector<std::string> tuning_reservations(const Report& report, const TuningSection& section);

}  // namespace boresight::app
