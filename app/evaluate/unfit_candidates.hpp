#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <boresight/app/evaluate/evaluate_section.hpp>

namespace boresight::app {

/// Reason why a candidate's controller is not eligible, to follow its name: "fails its
/// verification".
std::string_view why_not(const Candidate& candidate);

/// That no proposal is fit to be chosen, and why; empty where one is, or without proposals.
std::string none_chosen(const EvaluateSection& section);

/// Names of the candidates that are not eligible only because of their limit cycle.
std::vector<std::string> limit_cycle_candidates(const EvaluateSection& section);

/// Names of the candidates that are not eligible but are the best of all in some sample:
/// probabilities to be best and regrets include them.
std::vector<std::string> unfit_but_counted(const EvaluateSection& section,
                                           const DecisionSection& decision);

/// In a sentence each budget that states a wind speed it is needed up to and that no candidate fit
/// to be chosen meets so far on its nominal plant, with the one that comes nearest.
std::vector<std::string> unmet_needs(const EvaluateSection& section);

}  // namespace boresight::app
