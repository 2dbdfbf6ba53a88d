#pragma once

#include <optional>
#include <vector>

#include <boresight/design/studies/proposal_study.hpp>

namespace boresight::design {

/// The laws of one antenna: one a structure, in their order.
struct TunedCandidate {
  std::vector<CandidateLaw> laws;
  std::optional<std::size_t> chosen;  // ProposedDesign::chosen
  bool whole = true;                  // no interrupt came before its last law
};

struct TunedCandidates {
  std::vector<TunedCandidate> candidates;
  std::size_t members = 0;  // of each ensemble
};

/// study_controllers of every antenna, and of each structure the design for the same purpose and
/// wind speed as the one that stands for the antenna, judged on the members and on the nonlinear
/// antenna. `starts`: of each search. The same for any number of threads.
TunedCandidates tune_candidates(const std::vector<ProposedAntenna>& antennas,
                                const PlantUncertainty& uncertainty, int starts,
                                const ProposalOptions& options);

}  // namespace boresight::design
