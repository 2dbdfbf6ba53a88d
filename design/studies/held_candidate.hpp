#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include <boresight/design/ensembles/held_gains_evaluator.hpp>
#include <boresight/design/studies/proposal_study.hpp>

namespace boresight::design {

/// Evaluates a candidate's controller with fixed gains on plant after plant. Use one object per
/// thread; copies are independent. The antennas must outlive it.
class HeldCandidate {
 public:
  HeldCandidate(const plant::Antenna& as_is, const Mission& proposed, const CandidateLaw& law);

  struct Outcome {
    double rms = 0.0;  // mdeg, of linear loops with the controller's effect; infinite: unstable
    bool within_goals = false;
  };

  Outcome judge(const PlantDraw& draw);

 private:
  const plant::Antenna* as_is_;
  const plant::Antenna* proposed_;
  NonlinearEffect effect_;
  TrackingProblem problem_;
  HardGoals goals_;
  HeldGainsEvaluator evaluator_;
};

/// Outcomes of controllers on the same samples: samples x controllers.
struct DrawnOutcomes {
  Eigen::MatrixXd rms;      // mdeg
  Eigen::ArrayXXd outside;  // 1 where a constraint is violated
};

/// Evaluates every candidate on the samples. None if interrupted. The result does not depend on the
/// number of threads.
std::optional<DrawnOutcomes> judge_draws(const std::vector<HeldCandidate>& held,
                                         const PlantDistribution& distribution,
                                         const ProposalOptions& options);

}  // namespace boresight::design
