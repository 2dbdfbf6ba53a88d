#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include <boresight/design/studies/proposal_study.hpp>

namespace boresight::design {

/// Holds candidates against each other with one structure on both, by the laws tuned for each and
/// over the draws of `rms` (draws x decision.candidates, mdeg): every pair of different antennas
/// whose chosen laws differ in structure, with each of the two that was tuned for both.
/// `missions`: of the candidates; `as_is`: the antenna that draws are of. None if interrupted.
std::optional<std::vector<PairByStructure>> compare_by_structure(
    const ProposalDecision& decision, const Eigen::MatrixXd& rms,
    const std::vector<ProposedDesign>& candidates, const plant::Antenna& as_is,
    const std::vector<const Mission*>& missions, const PlantDistribution& distribution,
    const ProposalOptions& options);

}  // namespace boresight::design
