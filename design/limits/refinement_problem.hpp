#pragma once

#include <array>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <boresight/design/limits/loop_figures.hpp>
#include <boresight/design/limits/parallel_sections.hpp>
#include <boresight/design/limits/robust_constraints.hpp>
#include <boresight/design/limits/sampled_spectrum.hpp>
#include <boresight/design/tuning/feasible_search.hpp>

namespace boresight::design {

/// The optimisation problem of one step of refine_controller: minimise the largest ratio of an rms
/// to that of the start on the same plant, within the constraints, over all parameters of a
/// controller (ParallelSections). Values and gradients are those of LoopFigureEvaluator on every
/// plant. These are evaluated at discrete frequencies; correct() adds the difference to the exact
/// peaks.
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
    double gain = 0.0;       // decrease of objective and penalty of violations
    double violation = 0.0;  // the largest, logarithmic, beyond a tolerance
    long evaluations = 0;    // of all figures and gradients on all plants
    Eigen::VectorXd peaks;   // as RobustConstraints::peaks, by LoopFigures
  };

  /// The best point in a box of this half-width about the centre, which is the start at first. A
  /// unit of the coordinates changes the mean square of the boresight or of the command's noise, or
  /// a sensitivity, by about 40 % of itself over all plants.
  Step step(double radius) const;

  /// Makes a step the centre.
  void move_to(const Step& step);

  enum class Correction { afresh, more };
  /// Sets the corrections of the peaks from the exact peaks of a step (RobustConstraints::peaks).
  /// `more`: only upwards. `afresh`, of the step that becomes the centre: also downwards, by at
  /// most 30 %. Returns whether one rose.
  bool correct(const Step& step, const Eigen::VectorXd& exact, Correction how);

  /// Halves the excess of each correction over the one that the centre needs (before the first
  /// `afresh`: over the least). For a box of half the size: the closer a step is to the centre, the
  /// closer its corrections are to the centre's.
  void ease_corrections();

  /// ln of the largest ratio of an rms (as RobustConstraints::rms) to that of the start, of each
  /// plant to its own; at standstill with an allowance.
  double objective(const Eigen::VectorXd& rms) const;

 private:
  std::size_t all() const { return spectra_.size(); }
  double peak_goal(std::size_t i) const;
  void choose_directions();
  Eigen::MatrixXd curvature(const ParallelSections::Response& response) const;
  Eigen::VectorXd moved(const std::vector<double>& point) const;
  // Per sensor, parameters_of(it) x 2 frequencies: first the real parts, then the imaginary ones.
  using Derivatives = std::array<Eigen::MatrixXd, ParallelSections::sensors>;
  // Gradients by all parameters, a column a figure.
  Eigen::MatrixXd by_parameters(const Derivatives& derivatives,
                                std::span<const RmsFigure* const> figures) const;
  Eigen::VectorXd by_parameters(const Derivatives& derivatives, const PeakFigure& figure) const;
  struct Figures {
    std::vector<LoopFigures> loops;   // a plant each; the rms only of those rated
    std::vector<PeakFigure> locked;   // the gain on a locked motor
    std::vector<PeakFigure> at_rest;  // the inverse of the static gain, if limited
  };
  Figures figures(const Eigen::ArrayXXcd& response, bool with_rms) const;
  Eigen::VectorXd peaks(const Figures& figures) const;
  void evaluate(const std::vector<double>& point, ConstrainedValues& values) const;

  const RobustConstraints& constraints_;
  ParallelSections sections_;
  Eigen::ArrayXd frequency_;
  Eigen::VectorXd centre_;
  Eigen::MatrixXd directions_;            // columns: steps of the parameters of unit effect
  std::vector<SampledSpectrum> spectra_;  // of the plants, at standstill, at edges, of corners
  std::vector<LoopFigureEvaluator> evaluators_;  // of the same plants
  std::vector<LoopFigureEvaluator> locked_;      // of the plants whose gain is limited
  std::size_t moving_, rated_;                   // the plants; these and those at standstill
  std::size_t limited_positions_;  // whose position loop's peak is limited: rated_ or 0
  Eigen::VectorXd references_;     // ln of the rms of the start, of those rated
  Eigen::VectorXd of_centre_;      // the corrections that the centre needs
  Eigen::VectorXd corrections_;    // ln, of the peaks
};

}  // namespace boresight::design
