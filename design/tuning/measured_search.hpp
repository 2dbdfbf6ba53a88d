#pragma once

#include <array>
#include <optional>
#include <vector>

#include <boresight/control/controllers/controller.hpp>
#include <boresight/control/loops/loop_evaluator.hpp>
#include <boresight/design/tuning/feasible_search.hpp>
#include <boresight/design/tuning/measured_tuning.hpp>

namespace boresight::design {

/// One response that must meet the peak limits, at the breaks with `looked_at` true.
struct MeasuredMember {
  control::LoopEvaluator evaluator;
  std::array<bool, control::loop_breaks.size()> looked_at;
};

/// Evaluator for loops with these channels in the problem's wind and noise; variances over `band`
/// (Hz).
control::LoopEvaluator measured_evaluator(const MeasuredProblem& problem,
                                          const control::LoopChannels& channels,
                                          control::FrequencyBand band);

/// The searches of one tuning on a measured response. Adds its counts to the tuning result. Keeps
/// references to the constructor arguments. Points are logarithms of gains.
class MeasuredSearch {
 public:
  MeasuredSearch(const MeasuredProblem& problem, const control::LoopStructure& structure,
                 const MeasuredConstraints& goals, const MeasuredTuningOptions& options);

  /// Distinct optima of random starts on a coarse grid, best first. If none meets the constraints,
  /// returns the point nearest to meeting them. Empty if no stable controller was found.
  std::vector<SearchPoint> from_everywhere(MeasuredTuningResult& result);

  /// The best point from these starts, with the responses of `members`. The first member is the
  /// measured response, for which rms and effort are computed. If no point meets the constraints,
  /// returns the nearest one.
  std::optional<SearchPoint> refine(std::vector<MeasuredMember>& members,
                                    const std::vector<std::vector<double>>& starts,
                                    MeasuredTuningResult& result);

  /// The measured response itself, constrained at every break.
  MeasuredMember measured(const Eigen::ArrayXd& grid) const;
  /// The worst response for the controller at break `b`, within `radius` of the confidence of the
  /// measured response. It is constrained at that break only.
  MeasuredMember least_favourable(const control::Controller& controller, std::size_t b,
                                  double radius, const Eigen::ArrayXd& grid) const;
  control::Controller controller_of(const SearchPoint& point) const;

 private:
  const MeasuredProblem& problem_;
  const control::LoopStructure& structure_;
  const MeasuredConstraints& goals_;
  const MeasuredTuningOptions& options_;
  FeasibleSearchOptions search_options_;
};

}  // namespace boresight::design
