#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <boresight/app/evaluate/evaluate_section.hpp>

namespace boresight::app {

/// Indices of the gains that differ by more than a factor of 5 between two controllers of one
/// structure. Such gains suggest different local optima of the searches: a hardware change seldom
/// moves one optimum that far. Empty if no gain differs so much, for different structures, or
/// without gains.
std::vector<std::size_t> other_family(const CandidateController& controller,
                                      const CandidateController& other);

/// Proposals that change the peak boresight error at a velocity reversal, or the drive's largest
/// acceleration, by more than a tenth of the present antenna's value; one sentence each. Of the
/// proposals that so change this error or the limit cycle, it names those whose controller is of an
/// other_family than the present antenna's. Empty without such proposals.
std::string changed_motion(const EvaluateSection& section);

/// Number of plants on which each candidate's controller meets the budgets that state a required
/// wind speed. Empty without such budgets.
std::string plants_within_needs(const EvaluateSection& section);

}  // namespace boresight::app
