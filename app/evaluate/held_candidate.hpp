#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include <boresight/app/evaluate/evaluate_study.hpp>
#include <boresight/design/ensembles/held_gains_evaluator.hpp>

namespace boresight::app {

/// A law of a candidate with its gains held, on plant after plant. Not to be shared between
/// threads: copies are independent. The cases must outlive it.
class HeldCandidate {
 public:
  HeldCandidate(const io::Case& as_is, const io::Case& antenna, const CandidateLaw& law);

  struct Outcome {
    double rms = 0.0;  // mdeg, of linear loops times the law's nonlinear_factor; infinite: unstable
    bool within_goals = false;
  };

  Outcome judge(const design::PlantDraw& draw);

 private:
  const io::Case* as_is_;
  const io::Case* antenna_;
  double nonlinear_factor_;
  design::TrackingProblem problem_;
  design::HardGoals goals_;
  design::HeldGainsEvaluator evaluator_;
};

/// Outcomes of laws on the same draws: draws x laws.
struct DrawnOutcomes {
  Eigen::MatrixXd rms;      // mdeg
  Eigen::ArrayXXd outside;  // 1 where a goal is broken
};

/// None if interrupted. The same for any number of threads.
std::optional<DrawnOutcomes> judge_draws(const std::vector<HeldCandidate>& held,
                                         const design::PlantDistribution& distribution,
                                         const EvaluateOptions& options);

}  // namespace boresight::app
