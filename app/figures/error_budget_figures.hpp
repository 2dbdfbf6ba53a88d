#pragma once

#include <string>
#include <vector>

#include <boresight/app/figures/figure.hpp>
#include <boresight/app/report/report.hpp>
#include <boresight/design/problem/pointing_budget.hpp>
#include <boresight/design/studies/error_budget.hpp>

namespace boresight::app {

/// The parts of the pointing error and their total, with the pointing budgets as lines.
/// `conditions`: the controller and the wind, in a sentence.
Figure error_budget_figure(const std::string& id, const std::string& section,
                           const std::string& conditions, const design::ErrorBudget& errors,
                           const std::vector<design::PointingBudget>& budgets);

/// Uncertainty budget (GUM) of the reflected inertia, a panel for each method: what each input
/// contributes to its variance, the largest first. Empty without contributions.
std::vector<Figure> uncertainty_figures(const IdentificationSection& section);

}  // namespace boresight::app
