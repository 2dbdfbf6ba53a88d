#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include <boresight/design/ensembles/fixed_gain_evaluator.hpp>
#include <boresight/design/studies/proposal_study.hpp>

namespace boresight::design {

/// Evaluates a candidate's controller with fixed gains on plant after plant. Use one object per
/// thread; copies are independent. The antennas must outlive it.
class FixedGainCandidate {
 public:
  FixedGainCandidate(const plant::Antenna& as_is, const Mission& proposed,
                     const CandidateController& controller);

  struct Outcome {
    double rms = 0.0;  // mdeg, of linear loops with the controller's effect; infinite: unstable
    bool within_constraints = false;
  };

  Outcome evaluate(const PlantSample& draw);

 private:
  const plant::Antenna* as_is_;
  const plant::Antenna* proposed_;
  NonlinearEffect effect_;
  TrackingProblem problem_;
  Constraints goals_;
  FixedGainEvaluator evaluator_;
};

/// Outcomes of controllers on the same samples: samples x controllers.
struct DrawnOutcomes {
  Eigen::MatrixXd rms;      // mdeg
  Eigen::ArrayXXd outside;  // 1 where a constraint is violated
};

/// Evaluates every candidate on the samples. None if interrupted. The result does not depend on the
/// number of threads.
std::optional<DrawnOutcomes> evaluate_samples(const std::vector<FixedGainCandidate>& candidates,
                                              const PlantDistribution& distribution,
                                              const ProposalOptions& options);

}  // namespace boresight::design
