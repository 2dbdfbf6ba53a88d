#pragma once

#include <string>
#include <vector>

#include <boresight/app/figures/figure.hpp>
#include <boresight/app/simulate/time_domain.hpp>

namespace boresight::app {

/// The verified controller against time. Boresight error in wind with its two parts, compared with
/// that of the present gains if there are some; limit cycles, or the decay to rest; velocity
/// reversals with and without friction. Only completed runs.
std::vector<Figure> trace_figures(const TimeDomainSection& section, const std::string& heading);

}  // namespace boresight::app
