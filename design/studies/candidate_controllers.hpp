#pragma once

#include <optional>
#include <vector>

#include <boresight/design/studies/proposal_study.hpp>

namespace boresight::design {

/// The controllers of one antenna: one per structure, in the order of the structures.
struct TunedCandidate {
  std::vector<CandidateController> controllers;
  std::optional<std::size_t> chosen;  // ProposedDesign::chosen
  bool whole = true;                  // no interrupt came before its last controller
};

struct TunedCandidates {
  std::vector<TunedCandidate> candidates;
  std::size_t members = 0;  // of each ensemble
};

/// Runs study_controllers for every antenna. For each structure it returns the design for the
/// purpose and wind speed of the antenna's recommended controller. These designs are evaluated on
/// the members and on the nonlinear antenna. `starts`: per search. The result does not depend on
/// the number of threads. @throws InvalidInput for a state space without the time domain, and as
/// study_controllers.
TunedCandidates tune_candidates(const std::vector<ProposedAntenna>& antennas,
                                const PlantUncertainty& uncertainty, int starts,
                                const ProposalOptions& options);

}  // namespace boresight::design
