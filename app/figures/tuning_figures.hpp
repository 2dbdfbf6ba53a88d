#pragma once

#include <vector>

#include <boresight/app/figures/figure.hpp>
#include <boresight/app/report/report.hpp>

namespace boresight::app {

/// The tuned law: law_figures, and its rms against wind speed. None without a stable law.
std::vector<Figure> tuning_figures(const TuningSection& section);

/// Beam rms by each choice among contradictory numbers.
std::vector<Figure> choices_figures(const std::vector<ChoiceResult>& choices);

/// Beam rms of every series, and hydraulic frequency and damping, against flywheel disks.
std::vector<Figure> matching_figures(const MatchingSection& section);

}  // namespace boresight::app
