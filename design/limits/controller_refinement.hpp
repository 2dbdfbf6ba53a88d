#pragma once

#include <functional>

#include <boresight/design/limits/parallel_sections.hpp>
#include <boresight/design/limits/robust_constraints.hpp>

namespace boresight::design {

struct RefinementOptions {
  /// Steps of the search. Each takes about 0.6 s of computing with 31 plants and order 25.
  int steps = 24;
  /// All poles keep these bounds, or the start's where it misses them. What a slew leaves in slow
  /// poles decays as slowly.
  PoleBounds poles = {};
  /// What costs too much to be asked at each step: how much of it a controller misses, 0 for
  /// nothing. It is asked of the last step that meets every constraint, then of those 1, 3, 6, 10
  /// and 15 before it until one misses nothing; the result is the one of these that misses least.
  std::function<int(const plant::StateSpace&)> misses = {};
};

struct RefinementResult {
  plant::StateSpace controller;
  double boresight_rms = 0.0;  // rad of motor, the largest over the plants
  bool feasible = false;       // all constraints are met
  int steps = 0;               // that counted
  long evaluations = 0;        // of all figures on all plants, with gradients
};

/// A controller of the order of `start` with less rms under the constraints: fixed-order synthesis
/// over the whole ensemble by gradient. A start that misses some of them is first led to where it
/// meets them, at the least rms on the way. All numbers of the controller (ParallelSections) are
/// varied. What is minimised is the largest ratio of an rms
/// to that of the start: of the largest rms over the plants, and of the rms on each plant at
/// standstill, which wind with much friction amounts to. A controller that only the frictionless
/// antenna tolerates is therefore none. Plants at an edge of the encoder only limit |S|.
///
/// Each step is a search by sequential quadratic programming within a box about the best controller
/// (RefinementProblem); it counts if RobustConstraints agrees, and widens or narrows the next box.
/// The result is a local optimum or on the way to one, and no bound; of a feasible start, what is
/// minimised becomes no larger. Not convex: another start may do better.
/// @throws InvalidInput as ParallelSections, for fewer than 1 step and a start that is not stable
/// on all plants; NumericalFailure as ParallelSections.
RefinementResult refine_controller(const plant::StateSpace& start,
                                   const RobustConstraints& constraints,
                                   const RefinementOptions& options = {});

}  // namespace boresight::design
