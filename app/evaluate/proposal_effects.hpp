#pragma once

#include <string>

#include <boresight/app/evaluate/evaluate_section.hpp>

namespace boresight::app {

/// Which proposals change the beam's largest error at a reversal, or the acceleration that the
/// drive reaches, by more than a tenth of what the antenna as it is has, in a sentence each; empty
/// where none does.
std::string changed_motion(const EvaluateSection& section);

/// On how many plants each candidate's law meets the budgets that state a wind they are needed up
/// to; empty without such budgets.
std::string plants_within_needs(const EvaluateSection& section);

}  // namespace boresight::app
