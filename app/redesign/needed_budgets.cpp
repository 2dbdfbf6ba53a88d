#include <algorithm>

#include <fmt/format.h>

#include <boresight/app/redesign/needed_budgets.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/design/problem/pointing_budget.hpp>

namespace boresight::app {

bool meets_need(const design::PointingBudget& budget, double reached) {
  return !budget.wind_speed || reached >= *budget.wind_speed * (1.0 - 1e-6);
}

std::string budget_text(const design::PointingBudget& budget) {
  return fmt::format("{} ({}: {:.3f} mdeg)", budget.name, budget.band, budget.rms / millidegree);
}

double reached_wind_speed(const TuningSection& section, const BudgetResult& budget) {
  return std::min(budget.wind_speed_limit, section.torque_limited_wind_speed);
}

}  // namespace boresight::app
