#pragma once

#include <memory>
#include <string>
#include <vector>

#include <boresight/design/problem/goals.hpp>
#include <boresight/design/problem/tracking_problem.hpp>

namespace boresight::design {

/// A control law on one plant against its hard goals.
struct PlantJudgement {
  /// By the winding along the frequencies; nothing below is set where it is false.
  bool stable = false;
  control::LoopEvaluation evaluation;
  std::vector<GoalRatio> ratios;

  /// The largest ratio; infinity for an unstable loop.
  double worst_ratio() const;
};

/// One plant of a tuning, ready to judge law after law. Copies are independent. Not to be shared
/// between threads.
class JudgedPlant {
 public:
  /// The problem's own plant. `wind` must be of the problem. `tolerance`: as of
  /// make_adaptive_evaluator.
  JudgedPlant(std::string name, const TrackingProblem& problem, const HardGoals& goals,
              const WindTable& wind, double tolerance = control::LoopQuadrature{}.tolerance);

  /// Good until the next call. @throws InvalidInput as control::validate(law).
  const PlantJudgement& judge(const control::ControlLaw& law, bool with_gradients);

  /// Of the eigenvalues.
  bool stable_by_eigenvalues(const control::ControlLaw& law) const;

  const std::string& name() const { return name_; }
  const plant::AntennaPlant& plant() const { return plant_; }

 private:
  std::string name_;
  plant::AntennaPlant plant_;
  double delay_;
  HardGoals goals_;
  MeanWindLoad mean_;
  Eigen::ArrayXd frequency_;  // rad/s, for margins and the eigenvalues' residue
  control::LoopEvaluator evaluator_;
  /// Gusts are those of the design's wind: beside a climate they take an evaluator of their own.
  std::vector<control::LoopEvaluator> gusts_;
  std::vector<control::LoopChannels> channels_;  // where margins are asked for
  PlantJudgement judgement_;
};

}  // namespace boresight::design
