#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <boresight/app/evaluate/evaluate_section.hpp>

namespace boresight::app {

/// Whether two laws of one structure come from different local optima of their searches: the places
/// of the gains that are more than a factor of 5 apart, which a change of hardware seldom asks of
/// one optimum. Empty for laws alike, of different structures or without gains.
std::vector<std::size_t> other_family(const CandidateLaw& law, const CandidateLaw& other);

/// Which proposals change the beam's largest error at a reversal, or the acceleration that the
/// drive reaches, by more than a tenth of what the antenna as it is has, in a sentence each; of
/// those that change that error or the hunting so, which have a law of an other_family than the
/// antenna as it is. Empty where none does.
std::string changed_motion(const EvaluateSection& section);

/// On how many plants each candidate's law meets the budgets that state a wind they are needed up
/// to; empty without such budgets.
std::string plants_within_needs(const EvaluateSection& section);

}  // namespace boresight::app
