#pragma once

#include <optional>
#include <vector>

#include <boresight/app/figures/figure.hpp>
#include <boresight/app/report/report.hpp>

namespace boresight::app {

/// The tuned controller: block diagram, controller_figures, its rms against wind speed, and its
/// error budget with what the nonlinear antenna adds where it was simulated. None without a stable
/// controller.
std::vector<Figure> tuning_figures(const TuningSection& section,
                                   const std::optional<TimeDomainSection>& in_time);

/// Boresight error rms for each alternative interpretation of contradictory numbers.
std::vector<Figure> interpretations_figures(
    const std::vector<InterpretationResult>& interpretations);

/// Boresight error rms of every series, and hydraulic frequency and damping, against flywheel
/// disks.
std::vector<Figure> matching_figures(const MatchingSection& section);

}  // namespace boresight::app
