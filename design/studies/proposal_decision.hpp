#pragma once

#include <optional>
#include <vector>

#include <boresight/design/studies/proposal_study.hpp>

namespace boresight::design {

/// Probabilities, regrets and decisive inputs of the candidates with a stable controller.
/// `missions`: of the candidates; `as_is`: the antenna that the samples perturb. None if
/// interrupted, or with fewer than two such candidates. The result does not depend on the number of
/// threads.
std::optional<ProposalDecision> decide(const std::vector<ProposedDesign>& candidates,
                                       const plant::Antenna& as_is,
                                       const std::vector<const Mission*>& missions,
                                       const PlantDistribution& distribution,
                                       const ProposalOptions& options);

}  // namespace boresight::design
