#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <boresight/app/evaluate/evaluate_study.hpp>

namespace boresight::app {

/// Holds candidates against each other with one structure on both, by the laws tuned for each and
/// over the draws of `rms` (draws x decision.candidates, mdeg): every pair of different antennas
/// whose chosen laws differ in structure, with each of the two that was tuned for both. None if
/// interrupted.
std::optional<std::vector<PairByStructure>> compare_by_structure(
    const DecisionSection& decision, const Eigen::MatrixXd& rms,
    const std::vector<Candidate>& candidates, const std::vector<io::Case>& cases,
    const design::PlantDistribution& distribution, const EvaluateOptions& options);

/// What of the difference between such candidates is the law's and what the hardware's, in a
/// sentence a pair: of proposals with the antenna as it is, and of the two best. Empty without.
std::string law_or_hardware(const EvaluateSection& section, const DecisionSection& decision);
/// Same, only of the pairs that hold the candidate at that place and share a structure.
std::string law_or_hardware(const EvaluateSection& section, const DecisionSection& decision,
                            std::size_t place);

}  // namespace boresight::app
