#pragma once

#include <string>

#include <boresight/app/report/report.hpp>
#include <boresight/design/problem/pointing_budget.hpp>

namespace boresight::app {

/// Whether a budget that is met up to that mean wind speed (m/s) is so in all winds that it is
/// needed in; always where it states none.
bool meets_need(const design::PointingBudget& budget, double reached);

/// "need (Ka: 1.200 mdeg)".
std::string budget_text(const design::PointingBudget& budget);

/// Mean wind speed (m/s) up to which a budget is met with fixed gains, and the supply's torque
/// still carries the mean wind, friction and offset; infinite if neither ends within the search.
double reached_wind_speed(const TuningSection& section, const BudgetResult& budget);

}  // namespace boresight::app
