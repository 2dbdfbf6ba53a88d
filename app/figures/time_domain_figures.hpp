#pragma once

#include <vector>

#include <boresight/app/figures/figure.hpp>
#include <boresight/app/simulate/time_domain.hpp>

namespace boresight::app {

/// From the linear prediction to the simulated boresight rms, one contribution after the other,
/// where the run in wind completed; the trace_figures; and the controllers that the one verified
/// was chosen from. `section`: heading that they stand under.
std::vector<Figure> time_domain_figures(const TimeDomainSection& section,
                                        const std::string& heading);

}  // namespace boresight::app
