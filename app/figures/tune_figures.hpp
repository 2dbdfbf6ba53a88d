#pragma once

#include <optional>
#include <vector>

#include <boresight/app/figures/figure.hpp>
#include <boresight/app/simulate/time_domain.hpp>
#include <boresight/app/tune/tune_section.hpp>
#include <boresight/design/limits/pointing_limit.hpp>

namespace boresight::app {

/// Structures side by side, their rms against wind speed, their sensitivities, and the
/// controller_figures of the best controller. The best one has the least rms at the design's wind
/// speed among those that meet every requirement; robust controllers take precedence. `in_time`:
/// controllers on the nonlinear antenna, if they were run.
std::vector<Figure> tune_figures(const TuneSection& section,
                                 const std::optional<TimeDomainSection>& in_time);

/// Controllers and LQG benchmarks against the lower bound.
std::vector<Figure> limit_figures(const design::PointingLimit& limit);

}  // namespace boresight::app
