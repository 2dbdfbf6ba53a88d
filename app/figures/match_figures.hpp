#pragma once

#include <vector>

#include <boresight/app/figures/figure.hpp>
#include <boresight/app/match/match_section.hpp>

namespace boresight::app {

/// Of the matching study, against flywheel disks: rms of every structure with its optimum, its
/// kinks and the rules; the plant and what its drive can do; margins; limit cycles and reversals;
/// what moves the curve; what each rule costs.
std::vector<Figure> match_figures(const MatchSection& section);

}  // namespace boresight::app
