#pragma once

#include <optional>
#include <vector>

#include <boresight/design/studies/proposal_study.hpp>

namespace boresight::design {

/// Chances, regrets and what decides, of the candidates with a stable law. `missions`: of the
/// candidates; `as_is`: the antenna that draws are of. None if interrupted, or with fewer than two
/// of them. The same for any number of threads.
std::optional<ProposalDecision> decide(const std::vector<ProposedDesign>& candidates,
                                       const plant::Antenna& as_is,
                                       const std::vector<const Mission*>& missions,
                                       const PlantDistribution& distribution,
                                       const ProposalOptions& options);

}  // namespace boresight::design
