#pragma once

#include <optional>
#include <vector>

#include <boresight/design/ensembles/plant_ensemble.hpp>
#include <boresight/design/problem/nonlinear_effect.hpp>
#include <boresight/design/problem/pointing_budget.hpp>

namespace boresight::design {

/// On how many plants that may be the true one each budget is met, one number a budget, with the
/// law's gains held in the wind that the budget is needed up to, whatever the problem's own wind;
/// none for a budget that states no wind_speed. `effect`: what makes the rms of the linear loops.
/// The supply's torque is not counted. Does not depend on the thread count.
/// @throws as judge.
std::vector<std::optional<int>> plants_within_budgets(
    const TrackingProblem& problem, const std::vector<EnsembleMember>& members,
    const control::ControlLaw& law, const HardGoals& goals,
    const std::vector<PointingBudget>& budgets, const NonlinearEffect& effect, unsigned threads);

}  // namespace boresight::design
