#pragma once

#include <string>

#include <boresight/app/evaluate/evaluate_section.hpp>

namespace boresight::app {

/// Separates the effects of controller and hardware in the difference between two candidates, one
/// sentence per pair. Pairs: each proposal with the present antenna, and the two best candidates.
/// Empty without such pairs.
std::string controller_or_hardware(const EvaluateSection& section, const DecisionSection& decision);
/// Same, for the pairs that include the candidate at index `place` and have a structure in common.
std::string controller_or_hardware(const EvaluateSection& section, const DecisionSection& decision,
                                   std::size_t place);

}  // namespace boresight::app
