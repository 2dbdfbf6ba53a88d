#pragma once

#include <vector>

#include <boresight/app/figures/figure.hpp>
#include <boresight/app/report/report.hpp>

namespace boresight::app {

/// Poles of the plant as frequency against damping, and its frequency responses: rates to the valve
/// command, angles to wind torque.
std::vector<Figure> plant_figures(const PlantSection& section);

}  // namespace boresight::app
