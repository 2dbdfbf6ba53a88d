#pragma once

#include <string>
#include <vector>

#include <boresight/app/evaluate/evaluate_section.hpp>

namespace boresight::app {

/// Conclusions from the samples: the least mean and its probability of being best, cost without
/// benefit, what the difference of the two best depends on, and what to test first. If no candidate
/// is eligible: only that.
std::vector<std::string> conclude_samples(const EvaluateSection& section,
                                          const DecisionSection& decision);

}  // namespace boresight::app
