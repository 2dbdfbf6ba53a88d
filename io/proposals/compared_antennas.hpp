#pragma once

#include <string>
#include <vector>

#include <boresight/design/studies/proposal_study.hpp>
#include <boresight/io/proposals/proposed_case.hpp>

namespace boresight::io {

/// What the antenna without proposals is called among them.
inline constexpr std::string_view as_it_is = "as it is";

/// The present antenna and the antennas of all proposals, as input of design::study_proposals.
struct ComparedAntennas {
  std::vector<ProposedCase> cases;  // the first without changes
  std::vector<design::ProposedAntenna> antennas;
  std::string currency;  // of the costs; empty: no proposal states one
};

/// `structures`: those tuned for the present antenna and for proposals that name none, as in
/// asked_structures.
/// @throws InvalidInput (FILE:LINE:COLUMN: KEY: ...) for two proposals of one name or of different
/// currencies and one called as_it_is; as apply_proposal, mission_of, asked_structures and
/// design::validate of the constraints.
ComparedAntennas compared_antennas(const Case& antenna, const std::vector<Proposal>& proposals,
                                   const std::vector<std::string>& structures = {});

/// Checks that they can be compared; call it before any work.
/// @throws InvalidInput as compared_antennas, except for missions and structures.
void check_proposals(const Case& antenna, const std::vector<Proposal>& proposals);

}  // namespace boresight::io
