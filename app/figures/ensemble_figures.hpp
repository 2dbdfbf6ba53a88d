#pragma once

#include <string>
#include <vector>

#include <boresight/app/figures/drawn_controller.hpp>
#include <boresight/app/figures/figure.hpp>

namespace boresight::app {

/// A controller with fixed gains on its ensemble: sensitivity at the three breaks, nominal, worst
/// member and range, with the allowed Ms; step responses of rate loop and position loop, nominal
/// and range. Empty without DrawnController::curves.
std::vector<Figure> ensemble_figures(const DrawnController& drawn);

/// "range over 30 perturbed models", with how many of them are stable where not all are.
std::string range_name(const design::EnsembleCurves& curves);

}  // namespace boresight::app
