#pragma once

#include <vector>

#include <boresight/app/evaluate/evaluate_section.hpp>
#include <boresight/app/figures/figure.hpp>

namespace boresight::app {

/// Proposals by cost and rms with their front, side by side with what the ensemble spreads them
/// over, their probabilities, and which inputs decide between the two best.
std::vector<Figure> evaluate_figures(const EvaluateSection& section);

}  // namespace boresight::app
