#pragma once

#include <string>
#include <vector>

#include <boresight/app/evaluate/evaluate_study.hpp>

namespace boresight::app {

/// The laws of one candidate: one a structure, in their order.
struct TunedCandidate {
  std::vector<CandidateLaw> laws;
  bool whole = true;  // no interrupt came before its last law
};

struct TunedCandidates {
  std::vector<TunedCandidate> candidates;
  std::size_t members = 0;  // of each ensemble
};

/// Tunes every candidate's structures robustly, each also from the laws of those that it extends,
/// judges the laws on the members and runs them on the nonlinear antenna. `cases`: the antenna as
/// it is, then what each proposal makes of it; `structures`: of each, by name. Progress is told
/// with one step left for the draws. The same for any number of threads.
TunedCandidates tune_candidates(const std::vector<io::Case>& cases,
                                const std::vector<std::vector<std::string>>& structures,
                                const PlantUncertainty& uncertainty, int starts,
                                const EvaluateOptions& options);

}  // namespace boresight::app
