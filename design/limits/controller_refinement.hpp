#pragma once

#include <functional>

#include <boresight/design/limits/robust_constraints.hpp>

namespace boresight::design {

struct RefinementOptions {
  /// Steps of the search. Each takes about 0.7 s of computing with 31 plants and order 25.
  int steps = 24;
  /// rad/s: no pole of the controller becomes slower, unless the start has slower ones. What a slew
  /// leaves in slow poles decays as slowly.
  double slowest_pole = 0.0;
  /// A step that meets every constraint counts only if this agrees, which may simulate; all do if
  /// empty.
  std::function<bool(const plant::StateSpace&)> accepts = {};
  /// What costs too much to be asked at each step: the result is the last step that meets every
  /// constraint and is confirmed. It is sought by bisection, as if steps were confirmed up to some
  /// one and none after it. If none of those asked is, the last step is returned.
  std::function<bool(const plant::StateSpace&)> confirms = {};
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
/// meets them, at the least rms on the way. All numbers of
/// the controller (ParallelSections) are varied. What is minimised is the largest ratio of an rms
/// to that of the start: of the largest rms over the plants, and of the rms on each plant at
/// standstill, which wind with much friction amounts to. A controller that only the frictionless
/// antenna tolerates is therefore none. Plants at an edge of the encoder only limit |S|.
///
/// Rms, effort and peaks and their gradients are those of SampledSpectrum. Each step is a search by
/// sequential quadratic programming (FeasibleSearch) within a box about the best controller, in
/// coordinates in which a unit changes the mean square of the boresight or of the command's noise
/// or a sensitivity by about itself; a step counts if RobustConstraints agrees, and widens or
/// narrows the next box. The result is a local optimum or on the way to one, never worse than a
/// feasible start, and no bound. Not convex: another start may do better.
/// @throws InvalidInput as ParallelSections, for fewer than 1 step and a start that is not stable
/// on all plants; NumericalFailure as ParallelSections.
RefinementResult refine_controller(const plant::StateSpace& start,
                                   const RobustConstraints& constraints,
                                   const RefinementOptions& options = {});

}  // namespace boresight::design
