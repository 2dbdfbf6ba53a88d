#pragma once

#include <vector>

#include <boresight/design/problem/nonlinear_effect.hpp>
#include <boresight/design/problem/pointing_budget.hpp>
#include <boresight/design/problem/tracking_problem.hpp>

namespace boresight::design {

/// Mean wind speeds (m/s) up to which a controller keeps the budgets with its gains held, one a
/// budget: wind_speed_limit of what NonlinearEffect::for_budgets leaves of each to the linear loop.
/// `noise_variance` (rad2 of motor): of the loop, as the evaluator has it.
std::vector<double> budget_speeds(const TrackingProblem& problem,
                                  const control::LoopEvaluator& evaluator,
                                  const control::ControlLaw& law, double noise_variance,
                                  const std::vector<PointingBudget>& budgets,
                                  const NonlinearEffect& effect);

/// The same with an evaluator of its own.
std::vector<double> budget_speeds(const TrackingProblem& problem, const control::ControlLaw& law,
                                  const std::vector<PointingBudget>& budgets,
                                  const NonlinearEffect& effect);

}  // namespace boresight::design
