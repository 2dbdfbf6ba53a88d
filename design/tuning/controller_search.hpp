#pragma once

#include <memory>
#include <vector>

#include <boresight/design/tuning/feasible_search.hpp>
#include <boresight/design/tuning/plant_evaluator.hpp>

namespace boresight::design {

/// Active plants of a search, as indices into the plants. The constraints apply to each of `goals`.
/// The cost is the root of the mean boresight variance over `rms`, or the largest rms of these if
/// `largest`.
struct ActiveScenarios {
  std::vector<std::size_t> goals;
  std::vector<std::size_t> rms;
  bool largest = false;
};

/// Converts controllers of a structure to points (logarithms of the gains), and back. Gains beyond
/// the bounds of their descriptions are set to the bound, the width of a conditional integral to
/// the middle of its bounds.
std::vector<double> log_gains(const control::Controller& controller);
control::Controller controller_at(const control::LoopStructure& structure,
                                  const std::vector<double>& point);

/// The search problem of one structure over several plants. The cost is ln of the boresight rms;
/// the constraints are ln of each normalised constraint plus `reserve`. A point is undefined if the
/// loop of an active plant is unstable. The plants must outlive the problem, which modifies them.
/// At most three peaks, gain margins and phase margins per break are constraints.
ConstrainedProblem controller_problem(std::vector<PlantEvaluator>& plants,
                                      const ActiveScenarios& active,
                                      const control::LoopStructure& structure,
                                      const Constraints& goals, double reserve);

}  // namespace boresight::design
