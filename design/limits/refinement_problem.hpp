#pragma once

#include <array>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <boresight/design/limits/parallel_sections.hpp>
#include <boresight/design/limits/robust_constraints.hpp>
#include <boresight/design/limits/sampled_spectrum.hpp>
#include <boresight/design/tuning/feasible_search.hpp>

namespace boresight::design {

/// What refine_controller searches step by step: the largest rms within the constraints, as a
/// function of all numbers of a controller (ParallelSections), with gradients, by the figures of
/// SampledSpectrum on every plant. They know peaks at their frequencies only; what exact peaks
/// exceed them by is set by correct().
class RefinementProblem {
 public:
  /// `bounds`: of ParallelSections. Refers to the constraints. `start` is stable on all plants; its
  /// objective is 0.
  /// @throws as ParallelSections.
  RefinementProblem(const plant::StateSpace& start, const RobustConstraints& constraints,
                    const PoleBounds& bounds);

  struct Step {
    Eigen::VectorXd parameters;
    plant::StateSpace controller;
    double gain = 0.0;      // of the objective, ln, less the cost of what is missed
    double missed = 0.0;    // ln, of the constraints, beyond a tolerance
    long evaluations = 0;   // of all figures on all plants, with gradients
    Eigen::VectorXd peaks;  // as RobustConstraints::peaks, at the frequencies, from above
  };

  /// The best point found in a box of that half-width about the centre, at first the start, in
  /// coordinates in which a unit changes the mean square of the boresight or of the command's noise
  /// or a sensitivity by about itself.
  Step step(double radius) const;

  void move_to(const Step& step);

  enum class Correction { afresh, more };
  /// Takes the exact peaks of a step (RobustConstraints::peaks) for what the frequencies miss from
  /// now on: where that is more than before, or afresh, which leaves 70 % of what is no longer
  /// needed. Whether a correction rose.
  bool correct(const Step& step, const Eigen::VectorXd& exact, Correction how);

  /// ln of the largest ratio of an rms (as RobustConstraints::rms) to that of the start: of the
  /// largest over the plants; at standstill of each to its own, with an allowance.
  double objective(const Eigen::VectorXd& rms) const;

 private:
  std::size_t all() const { return spectra_.size(); }
  double peak_goal(std::size_t i) const;
  void choose_directions();
  Eigen::MatrixXd curvature(const ParallelSections::Response& response) const;
  Eigen::VectorXd moved(const std::vector<double>& point) const;
  Eigen::MatrixXd by_parameters(
      const std::array<Eigen::MatrixXd, ParallelSections::sensors>& derivatives,
      std::span<const LoopFigures> figures) const;
  std::vector<LoopFigures> figures(const ParallelSections::Response& response) const;
  Eigen::VectorXd peaks(std::span<const LoopFigures> figures) const;
  void evaluate(const std::vector<double>& point, ConstrainedValues& values) const;

  const RobustConstraints& constraints_;
  ParallelSections sections_;
  Eigen::ArrayXd frequency_;
  Eigen::VectorXd centre_;
  Eigen::MatrixXd directions_;            // columns: steps of the parameters of unit effect
  std::vector<SampledSpectrum> spectra_;  // of the plants, at standstill, at edges
  std::size_t moving_, rated_;            // the plants; these and those at standstill
  std::size_t limited_positions_;         // whose position loop's peak is limited: rated_ or 0
  Eigen::VectorXd references_;            // ln of the rms of the start, of those rated
  Eigen::VectorXd corrections_;           // ln, of the peaks
};

}  // namespace boresight::design
