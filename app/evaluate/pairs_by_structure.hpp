#pragma once

#include <string>

#include <boresight/app/evaluate/evaluate_section.hpp>

namespace boresight::app {

/// What of the difference between such candidates is the law's and what the hardware's, in a
/// sentence a pair: of proposals with the antenna as it is, and of the two best. Empty without.
std::string law_or_hardware(const EvaluateSection& section, const DecisionSection& decision);
/// Same, only of the pairs that hold the candidate at that place and share a structure.
std::string law_or_hardware(const EvaluateSection& section, const DecisionSection& decision,
                            std::size_t place);

}  // namespace boresight::app
