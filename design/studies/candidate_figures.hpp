#pragma once

#include <boresight/design/studies/proposal_study.hpp>

namespace boresight::design {

/// What the law and the drive do at the design's wind speed, for those bands and budgets.
/// @throws InvalidInput and NumericalFailure as make_evaluator, wind_speed_limit and within_reach.
CandidateFigures candidate_figures(const Mission& mission, const std::vector<PointingBand>& bands,
                                   const std::vector<PointingBudget>& budgets,
                                   const CandidateLaw& tuned);

}  // namespace boresight::design
