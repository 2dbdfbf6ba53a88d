#pragma once

#include <optional>
#include <vector>

#include <boresight/design/ensembles/plant_ensemble.hpp>
#include <boresight/design/problem/nonlinear_effect.hpp>
#include <boresight/design/problem/pointing_budget.hpp>

namespace boresight::design {

/// Number of ensemble members on which each budget is met, one entry per budget. The controller is
/// evaluated with fixed gains, in the wind up to which the budget is needed, whatever the problem's
/// own wind. None for a budget that states no wind_speed. `effect`: applied to the rms of the
/// linear loops. The supply's torque limit is not included. The result does not depend on the
/// number of threads.
/// @throws as evaluate.
std::vector<std::optional<int>> plants_within_budgets(
    const TrackingProblem& problem, const std::vector<EnsembleMember>& members,
    const control::Controller& controller, const Constraints& goals,
    const std::vector<PointingBudget>& budgets, const NonlinearEffect& effect, unsigned threads);

}  // namespace boresight::design
