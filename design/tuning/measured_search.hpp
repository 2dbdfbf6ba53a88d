#pragma once

#include <array>
#include <optional>
#include <vector>

#include <boresight/control/controllers/control_law.hpp>
#include <boresight/control/loops/loop_evaluator.hpp>
#include <boresight/design/tuning/feasible_search.hpp>
#include <boresight/design/tuning/measured_tuning.hpp>

namespace boresight::design {

/// One response that must meet its peaks, at the breaks looked at.
struct MeasuredMember {
  control::LoopEvaluator evaluator;
  std::array<bool, control::loop_breaks.size()> looked_at;
};

/// Loops with these channels in the problem's wind and noise; variances over `band` (Hz).
control::LoopEvaluator measured_evaluator(const MeasuredProblem& problem,
                                          const control::LoopChannels& channels,
                                          control::FrequencyBand band);

/// The searches of one tuning on a measured response, which count themselves in its result. Keeps
/// references to what it is made of. Points are logarithms of gains.
class MeasuredSearch {
 public:
  MeasuredSearch(const MeasuredProblem& problem, const control::LoopStructure& structure,
                 const MeasuredGoals& goals, const MeasuredTuningOptions& options);

  /// Distinct optima of random starts on a coarse grid, best first; the point nearest to the goals
  /// where none meets them; nothing where no stable law was seen.
  std::vector<SearchPoint> from_everywhere(MeasuredTuningResult& result);

  /// The best from these starts with the responses of `members`, of which the first is the measured
  /// one: rms and effort are its; nearest to the goals if none meets them.
  std::optional<SearchPoint> refine(std::vector<MeasuredMember>& members,
                                    const std::vector<std::vector<double>>& starts,
                                    MeasuredTuningResult& result);

  /// The measured response itself, looked at at every break.
  MeasuredMember measured(const Eigen::ArrayXd& grid) const;
  /// The response within `radius` of the measured one's confidence that is worst for the law at
  /// break `b`, looked at there.
  MeasuredMember least_favourable(const control::ControlLaw& law, std::size_t b, double radius,
                                  const Eigen::ArrayXd& grid) const;
  control::ControlLaw law_of(const SearchPoint& point) const;

 private:
  const MeasuredProblem& problem_;
  const control::LoopStructure& structure_;
  const MeasuredGoals& goals_;
  const MeasuredTuningOptions& options_;
  FeasibleSearchOptions search_options_;
};

}  // namespace boresight::design
