#pragma once

#include <optional>
#include <string>
#include <vector>

#include <boresight/app/evaluate/evaluate_study.hpp>

namespace boresight::app {

/// The laws of one candidate: one a structure, in their order.
struct TunedCandidate {
  std::vector<CandidateLaw> laws;
  /// The one recommended (recommended_or, where only a loss in wind is worse than what it accepts);
  /// where none meets its goals, that nearest to them; none if no structure is stable.
  std::optional<std::size_t> chosen;
  bool whole = true;  // no interrupt came before its last law
};

struct TunedCandidates {
  std::vector<TunedCandidate> candidates;
  std::size_t members = 0;  // of each ensemble
};

/// study_controllers of every candidate, and of each structure the design for the same purpose and
/// wind speed as the one that stands for the candidate, judged on the members and on the nonlinear
/// antenna. `cases`: the antenna as it is, then what each proposal makes of it; `structures`: of
/// each, by name. The same for any number of threads.
TunedCandidates tune_candidates(const std::vector<io::Case>& cases,
                                const std::vector<std::vector<std::string>>& structures,
                                const PlantUncertainty& uncertainty, int starts,
                                const EvaluateOptions& options);

}  // namespace boresight::app
