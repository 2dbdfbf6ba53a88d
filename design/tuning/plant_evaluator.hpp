#pragma once

#include <memory>
#include <string>
#include <vector>

#include <boresight/design/problem/goals.hpp>
#include <boresight/design/problem/tracking_problem.hpp>

namespace boresight::design {

/// Evaluation of one controller on one plant against its constraints.
struct PlantEvaluation {
  /// By Nyquist encirclements along the frequencies. If false, the fields below are not set.
  bool stable = false;
  control::LoopEvaluation evaluation;
  std::vector<NormalisedConstraint> ratios;

  /// The largest ratio; infinity for an unstable loop.
  double worst_ratio() const;
};

/// One plant of a tuning, prepared to evaluate many controllers. Copies are independent. Use
/// one object in one thread only.
class PlantEvaluator {
 public:
  /// For the problem's own plant. `wind` must belong to the problem. `tolerance` as in
  /// make_adaptive_evaluator.
  PlantEvaluator(std::string name, const TrackingProblem& problem, const Constraints& goals,
                 const WindTable& wind, double tolerance = control::LoopQuadrature{}.tolerance);
  /// For the problem's own plant with one friction of Constraints::standstill, by its place there.
  /// Its only constraint is that of standstill.
  static PlantEvaluator at_standstill(TrackingProblem problem, std::size_t place,
                                      const Constraints& goals, const WindTable& wind,
                                      double tolerance = control::LoopQuadrature{}.tolerance);

  /// Evaluates one controller. The reference is valid until the next call. @throws InvalidInput as
  /// control::validate.
  const PlantEvaluation& evaluate(const control::Controller& controller, bool with_gradients);

  /// Stability by the eigenvalues of the closed loop; of a conditional integral, while it holds
  /// too.
  bool stable_by_eigenvalues(const control::Controller& controller) const;

  const std::string& name() const { return name_; }
  /// True for an evaluator by at_standstill(), whose rms means nothing.
  bool is_at_standstill() const { return at_standstill_; }
  const plant::AntennaPlant& plant() const { return plant_; }

 private:
  std::string name_;
  plant::AntennaPlant plant_;
  double delay_;
  double gear_ratio_;
  Constraints goals_;
  bool at_standstill_ = false;
  double amplitude_ = 0.0;  // of Standstill
  MeanWindLoad mean_;
  Eigen::ArrayXd frequency_;  // rad/s, for margins and the eigenvalues' residue
  control::LoopEvaluator evaluator_;
  /// Gusts are those of the design wind. With a climate they need an evaluator of their own.
  std::vector<control::LoopEvaluator> gusts_;
  std::vector<control::LoopChannels> channels_;  // where margins are asked for
  PlantEvaluation plant_evaluation_;
  control::Controller equivalent_;  // of a conditional integral
};

/// Appends one evaluator at_standstill for each friction of Constraints::standstill, if given.
void append_standstill(const TrackingProblem& problem, const Constraints& goals,
                       const WindTable& wind, std::vector<PlantEvaluator>& plants,
                       double tolerance = control::LoopQuadrature{}.tolerance);

}  // namespace boresight::design
