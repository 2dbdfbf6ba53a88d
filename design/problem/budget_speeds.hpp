#pragma once

#include <vector>

#include <boresight/design/problem/nonlinear_effect.hpp>
#include <boresight/design/problem/pointing_budget.hpp>
#include <boresight/design/problem/tracking_problem.hpp>

namespace boresight::design {

/// Highest mean wind speeds (m/s) at which a controller with fixed gains meets each budget, one
/// entry per budget. Computed by wind_speed_limit for the part of the budget that
/// NonlinearEffect::for_budgets leaves to the linear loop. `noise_variance` (rad2 of motor):
/// variance of the loop from sensor noise, as computed by the evaluator.
std::vector<double> budget_speeds(const TrackingProblem& problem,
                                  const control::LoopEvaluator& evaluator,
                                  const control::Controller& controller, double noise_variance,
                                  const std::vector<PointingBudget>& budgets,
                                  const NonlinearEffect& effect);

/// The same, with an evaluator made for the problem.
std::vector<double> budget_speeds(const TrackingProblem& problem,
                                  const control::Controller& controller,
                                  const std::vector<PointingBudget>& budgets,
                                  const NonlinearEffect& effect);

}  // namespace boresight::design
