#pragma once

#include <string>
#include <vector>

#include <boresight/app/evaluate/evaluate_section.hpp>

namespace boresight::app {

/// What the draws say of the candidates: the least mean and its chances, what of it is not worth
/// paying for, what the difference of the two best depends on, what to test first. Where no
/// candidate is fit to be chosen: that alone.
std::vector<std::string> conclude_draws(const EvaluateSection& section,
                                        const DecisionSection& decision);

}  // namespace boresight::app
