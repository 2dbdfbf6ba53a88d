#pragma once

#include <vector>

#include <boresight/app/figures/figure.hpp>
#include <boresight/app/simulate/time_domain.hpp>

namespace boresight::app {

/// From the linear prediction to the simulated boresight rms, one contribution after the other, if
/// the run in wind completed. Then the trace_figures, and the controllers from which the verified
/// one was chosen. `section`: their heading.
std::vector<Figure> time_domain_figures(const TimeDomainSection& section,
                                        const std::string& heading);

}  // namespace boresight::app
