#pragma once

#include <vector>

#include <boresight/app/figures/figure.hpp>
#include <boresight/app/montecarlo/montecarlo_study.hpp>

namespace boresight::app {

/// Histogram and cumulative distribution of the boresight error rms with the budgets; worst plants
/// with their inputs; rank correlations of rms and inputs with intervals. Empty without a stable
/// plant.
std::vector<Figure> montecarlo_figures(const MonteCarloOutcome& outcome);

}  // namespace boresight::app
