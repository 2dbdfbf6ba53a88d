#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include <boresight/design/studies/proposal_study.hpp>

namespace boresight::design {

/// Compares candidates with the same structure on both, using the controllers tuned for each, over
/// the samples of `rms` (samples x decision.candidates, mdeg). It covers every pair of different
/// antennas whose chosen controllers differ in structure, and each of the two structures that was
/// tuned for both. `missions`: of the candidates; `as_is`: the antenna that the samples perturb.
/// None if interrupted.
std::optional<std::vector<PairByStructure>> compare_by_structure(
    const ProposalDecision& decision, const Eigen::MatrixXd& rms,
    const std::vector<ProposedDesign>& candidates, const plant::Antenna& as_is,
    const std::vector<const Mission*>& missions, const PlantDistribution& distribution,
    const ProposalOptions& options);

}  // namespace boresight::design
