#pragma once

#include <functional>
#include <optional>

#include <boresight/design/limits/parallel_sections.hpp>
#include <boresight/design/limits/robust_constraints.hpp>

namespace boresight::design {

/// Counts a controller's violations. It may stop at `enough` of them and return that number.
using CountViolations = std::function<int(const plant::StateSpace&, int enough)>;

struct RefinementOptions {
  /// Largest number of steps. Each takes about 0.2 s of one processor with 49 plants and order 14.
  int steps = 24;
  /// Bounds of the controller's poles; the start's own where it violates them. An error that a slew
  /// leaves in a slow pole decays as slowly.
  PoleBounds poles = {};
  /// Number of violations of a requirement that is too expensive to evaluate at every step, such as
  /// limit cycles in simulation. It is evaluated at the last step that meets every constraint, then
  /// 2, 6, 14 and so on steps before it, down to the first, until a step has none. The interval
  /// from that step to the next evaluated one with violations is then halved, as long as the later
  /// one's rms is smaller by more than 1 %. At most 6 evaluations; `enough` is the least count so
  /// far, at least 1. The result is the last step found without violations, else the one with the
  /// fewest, the latest of several. Empty, or without an accepted step that meets every constraint:
  /// the last step.
  CountViolations violations = {};
};

struct RefinementResult {
  plant::StateSpace controller;
  double boresight_rms = 0.0;                    // rad of motor, the largest over the plants
  bool feasible = false;                         // all constraints are met
  int steps = 0;                                 // that counted
  std::optional<int> violations = std::nullopt;  // RefinementOptions::violations, if evaluated
  long evaluations = 0;                          // of all figures on all plants, with gradients
  /// boresight_rms of the last step, which violations may have ruled out; of the start without one.
  double last_rms = 0.0;
};

/// Fixed-order synthesis over the whole ensemble by gradient: a controller of the order of `start`
/// with less rms under the constraints. All parameters of the controller (ParallelSections) vary. A
/// start that violates constraints is first led to where it meets them.
///
/// The objective is the largest ratio of an rms to that of the start on the same plant
/// (RefinementProblem::objective). It includes the rms on each plant at standstill, which
/// represents wind with much friction; otherwise the result would suit the frictionless antenna
/// only. Plants at an edge of the encoder and corners must be stable and limit only |S| at the
/// valve. A plant with a locked motor limits only the gain from encoder to motor torque.
///
/// Each step is a search by sequential quadratic programming within a box about the present
/// controller (RefinementProblem). A step is accepted if the exact quantities of RobustConstraints
/// confirm it, and the box then grows. A step with a small violation is repeated with corrected
/// peaks, at most twice; otherwise the box shrinks. The search ends after four steps since the last
/// accepted one that each promise a gain, in objective and penalty of violations, of at most 1e-4,
/// or where the objective of controllers that meet every constraint fell by less than 4e-3 over
/// twelve steps, refused ones included. The result is a local optimum or on the way to one. From a
/// feasible start the objective does not increase. The problem is not convex: another start may
/// lead to a better result.
/// @throws InvalidInput as ParallelSections, for fewer than 1 step and a start that is not stable
/// on all plants; NumericalFailure as ParallelSections.
RefinementResult refine_controller(const plant::StateSpace& start,
                                   const RobustConstraints& constraints,
                                   const RefinementOptions& options = {});

}  // namespace boresight::design
