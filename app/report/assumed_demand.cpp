#include <algorithm>

#include <fmt/format.h>

#include <boresight/app/report/assumed_demand.hpp>

namespace boresight::app {

std::string assumed_demand(const design::TuningResult& tuning, const std::string& assumption) {
  const bool limited =
      std::ranges::any_of(tuning.limits, [](const design::ActiveConstraint& limit) {
        return limit.goal.kind == design::GoalKind::gust_demand;
      });
  if (!limited || assumption.empty()) return "";
  return fmt::format(" The gust limit of the valve command depends on {}.", assumption);
}

}  // namespace boresight::app
