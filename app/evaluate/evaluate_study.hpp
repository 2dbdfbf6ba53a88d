#pragma once

#include <string>
#include <vector>

#include <boresight/app/evaluate/evaluate_section.hpp>
#include <boresight/io/case/case_declaration.hpp>
#include <boresight/io/proposals/proposal.hpp>

namespace boresight::app {

struct EvaluateOptions : design::ProposalOptions {
  /// For the present antenna and for proposals that name none; empty: as tune.
  std::vector<std::string> structures;
};

/// design::study_proposals of the present antenna and of every proposal. Without proposals: of the
/// present antenna only.
/// @throws InvalidInput as io::compared_antennas and study_proposals.
EvaluateSection evaluate_proposals(const io::Case& antenna,
                                   const std::vector<io::Proposal>& proposals,
                                   const design::PlantUncertainty& uncertainty,
                                   const EvaluateOptions& options);

/// Adds the numbers that the proposals assume to the case's.
void add_assumed(const std::vector<io::Proposal>& proposals, std::vector<io::Quantity>& assumed);

}  // namespace boresight::app
