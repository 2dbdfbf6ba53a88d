#pragma once

#include <string>
#include <vector>

#include <boresight/app/figures/figure.hpp>
#include <boresight/app/simulate/time_domain.hpp>

namespace boresight::app {

/// The verified controller against time: boresight error in wind, beside that of the present gains
/// where there are some, with its two parts; limit cycles, or how the loop comes to rest; velocity
/// reversals with and without friction. Only runs that completed.
std::vector<Figure> trace_figures(const TimeDomainSection& section, const std::string& heading);

}  // namespace boresight::app
