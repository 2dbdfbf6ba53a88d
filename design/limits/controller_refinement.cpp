#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <boresight/design/limits/controller_refinement.hpp>
#include <boresight/design/limits/refinement_problem.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::design {
namespace {

// Of ln: a step that misses a constraint by less is tried again with what the frequencies of the
// search did not show; one that misses it by more was too long.
constexpr double max_excess = 0.02;
// So many times in a row.
constexpr int max_corrections = 2;
// Of ln: what a step may miss of the search's own constraints, which keep something in hand.
constexpr double max_missed = 0.01;
constexpr double first_radius = 8e-3, min_radius = 1e-4, max_radius = 0.5, growth = 2.0;
// Steps that RefinementOptions::misses is asked of.
constexpr int max_asked = 6;
constexpr double worthwhile = 1e-4;

PoleBounds attainable(const PoleBounds& bounds, const plant::StateSpace& start) {
  const PoleBounds own = bounds_of(start);
  return {std::min(bounds.slowest, own.slowest), std::min(bounds.damping, own.damping)};
}

class Refinement {
 public:
  Refinement(const plant::StateSpace& start, const RobustConstraints& constraints,
             const RefinementOptions& options)
      : constraints_(constraints),
        options_(options),
        problem_(start, constraints, attainable(options.poles, start)) {}

  RefinementResult run(const plant::StateSpace& start) {
    double missed = constraints_.excess(start);
    RefinementResult result{start, constraints_.largest_rms(start), !(missed > 0.0), 0, 0};
    double radius = first_radius;
    double objective = 0.0;
    int corrected = 0;
    std::vector<RefinementResult> path;  // the steps that met every constraint
    const auto shorten = [&] {
      radius *= 0.5;
      corrected = 0;
    };
    for (int i = 0; i < options_.steps && radius >= min_radius; ++i) {
      RefinementProblem::Step found = problem_.step(radius);
      result.evaluations += found.evaluations;
      if (!(found.gain > worthwhile)) {
        shorten();
        continue;
      }
      const double excess = constraints_.excess(found.controller);
      // On the way to where all constraints are met, half of what the search shows is enough.
      const double beyond = excess - (result.feasible ? 0.0 : 0.5 * (missed + found.missed));
      if (beyond > 0.0) {
        const bool by_little = beyond < max_excess && corrected < max_corrections;
        if (by_little && problem_.correct(found, constraints_.peaks(found.controller),
                                          RefinementProblem::Correction::more)) {
          ++corrected;
        } else {
          shorten();
        }
        continue;
      }
      // Of the poles' bounds only the search knows.
      if (result.feasible && found.missed > max_missed) {
        shorten();
        continue;
      }
      // Where a peak exceeds its goal, excess() does not ask for stability.
      if (excess > 0.0 && !constraints_.stable(found.controller)) {
        shorten();
        continue;
      }
      const bool feasible = !(excess > 0.0);
      const Eigen::VectorXd rms = constraints_.rms(found.controller);
      // What the frequencies of the search show may be no more than their error.
      const double next = problem_.objective(rms);
      if (result.feasible && !(next < objective)) {
        shorten();
        continue;
      }
      corrected = 0;
      objective = next;
      missed = excess;
      problem_.correct(found, constraints_.peaks(found.controller),
                       RefinementProblem::Correction::afresh);
      problem_.move_to(found);
      radius = std::min(growth * radius, max_radius);
      result.controller = std::move(found.controller);
      result.boresight_rms =
          rms.head(static_cast<Eigen::Index>(constraints_.plants().size())).maxCoeff();
      result.feasible = feasible;
      ++result.steps;
      if (options_.misses && feasible) path.push_back(result);
    }
    return least_missing(std::move(result), std::move(path));
  }

 private:
  RefinementResult least_missing(RefinementResult found, std::vector<RefinementResult> path) const {
    int least = std::numeric_limits<int>::max();
    std::size_t best = path.size(), back = 1;
    for (int asked = 0; asked < max_asked && back <= path.size() && least > 0; ++asked) {
      const std::size_t place = path.size() - back;
      const int missed = options_.misses(path[place].controller);
      if (missed < least) {
        least = missed;
        best = place;
      }
      back += static_cast<std::size_t>(1 + asked);
    }
    if (best == path.size()) return found;
    path[best].evaluations = found.evaluations;
    return std::move(path[best]);
  }

  const RobustConstraints& constraints_;
  const RefinementOptions& options_;
  RefinementProblem problem_;
};

}  // namespace

RefinementResult refine_controller(const plant::StateSpace& start,
                                   const RobustConstraints& constraints,
                                   const RefinementOptions& options) {
  if (options.steps < 1) {
    throw InvalidInput(
        fmt::format("refine_controller: expected at least 1 step, found {}", options.steps));
  }
  if (!constraints.stable(start)) {
    throw InvalidInput(
        "refine_controller: expected a start that is stable by itself and on every plant, found "
        "one that is not");
  }
  return Refinement(start, constraints, options).run(start);
}

}  // namespace boresight::design
