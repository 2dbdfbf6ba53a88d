#pragma once

#include <boresight/design/studies/proposal_study.hpp>

namespace boresight::design {

/// Figures of the tuned controller and the drive at the design's wind speed, for the given bands
/// and budgets. @throws InvalidInput and NumericalFailure as make_evaluator, wind_speed_limit and
/// achievable_limits.
CandidateFigures candidate_figures(const Mission& mission, const std::vector<PointingBand>& bands,
                                   const std::vector<PointingBudget>& budgets,
                                   const CandidateController& tuned);

}  // namespace boresight::design
