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

// Logarithmic. A step that exceeds a constraint by less is repeated with corrected peaks; one that
// exceeds it by more was too long.
constexpr double max_excess = 0.02;
// Repetitions in a row.
constexpr int max_corrections = 2;
// Logarithmic: largest violation of the search's own constraints in an accepted step.
constexpr double max_violation = 0.01;
constexpr double first_radius = 8e-3, min_radius = 1e-4, max_radius = 0.5, growth = 2.0;
// Steps at which RefinementOptions::violations is evaluated.
constexpr int max_evaluated = 6;
constexpr std::size_t first_stride = 2;
// Of the rms: between steps that differ by less no further one is evaluated.
constexpr double to_gain = 0.01;
constexpr double worthwhile = 1e-4;
// The search ends after so many steps that promise no more than `worthwhile` since the last
// accepted one, and where the objective of feasible centres fell by less than `slow` over so many
// steps.
constexpr int max_idle = 4;
constexpr std::size_t recent = 12;
constexpr double slow = 4e-3;

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
    double violation = constraints_.excess(start);
    const double rms_of_start = constraints_.largest_rms(start);
    RefinementResult result{start, rms_of_start, !(violation > 0.0), 0, std::nullopt,
                            0,     rms_of_start};
    double radius = first_radius;
    double objective = 0.0;
    int corrected = 0, idle = 0;
    std::vector<double> objectives;      // at each step from a centre that met every constraint
    std::vector<RefinementResult> path;  // the steps that met every constraint
    const auto shorten = [&] {
      radius *= 0.5;
      problem_.ease_corrections();
      corrected = 0;
    };
    for (int i = 0; i < options_.steps && radius >= min_radius; ++i) {
      if (result.feasible) objectives.push_back(objective);
      if (objectives.size() > recent &&
          objectives[objectives.size() - 1 - recent] - objectives.back() < slow) {
        break;
      }
      RefinementProblem::Step found = problem_.step(radius);
      result.evaluations += found.evaluations;
      if (!(found.gain > worthwhile)) {
        if (++idle == max_idle) break;
        shorten();
        continue;
      }
      const Eigen::VectorXd peaks = constraints_.peaks(found.controller);
      const double excess = constraints_.excess(found.controller, peaks);
      // From an infeasible start, half of the predicted reduction is accepted.
      const double beyond = excess - (result.feasible ? 0.0 : 0.5 * (violation + found.violation));
      if (beyond > 0.0) {
        const bool by_little = beyond < max_excess && corrected < max_corrections;
        if (by_little && problem_.correct(found, peaks, RefinementProblem::Correction::more)) {
          ++corrected;
        } else {
          shorten();
        }
        continue;
      }
      // RobustConstraints does not include the bounds of the poles.
      if (result.feasible && found.violation > max_violation) {
        shorten();
        continue;
      }
      // excess() does not test stability where a peak exceeds its goal.
      if (excess > 0.0 && !constraints_.stable(found.controller)) {
        shorten();
        continue;
      }
      const bool feasible = !(excess > 0.0);
      const Eigen::VectorXd rms = constraints_.rms(found.controller);
      // By exact rms: a gain on the search's frequencies may be within their error.
      const double next = problem_.objective(rms);
      if (result.feasible && !(next < objective)) {
        shorten();
        continue;
      }
      corrected = idle = 0;
      objective = next;
      violation = excess;
      problem_.correct(found, peaks, RefinementProblem::Correction::afresh);
      problem_.move_to(found);
      radius = std::min(growth * radius, max_radius);
      result.controller = std::move(found.controller);
      result.boresight_rms =
          rms.head(static_cast<Eigen::Index>(constraints_.plants().size())).maxCoeff();
      result.last_rms = result.boresight_rms;
      result.feasible = feasible;
      ++result.steps;
      if (options_.violations && feasible) path.push_back(result);
    }
    return fewest_violations(std::move(result), std::move(path));
  }

 private:
  RefinementResult fewest_violations(RefinementResult found,
                                     std::vector<RefinementResult> path) const {
    if (path.empty()) return found;
    int least = std::numeric_limits<int>::max();
    std::size_t best = path.size() - 1, place = best, stride = first_stride;
    std::size_t later = path.size();  // the next evaluated step after `best`: it has violations
    for (int i = 0; i < max_evaluated; ++i) {
      const int violations = options_.violations(path[place].controller, std::max(least, 1));
      if (violations == 0 || violations < least) best = place;
      if (violations > 0) later = place;
      least = std::min(violations, least);
      if (least == 0) {
        if (best + 1 >= later) break;
        if (later < path.size() &&
            path[best].boresight_rms < (1.0 + to_gain) * path[later].boresight_rms) {
          break;
        }
        place = best + (later - best) / 2;
      } else {
        if (place == 0) break;
        place -= std::min(place, stride);
        stride *= 2;
      }
    }
    path[best].last_rms = path.back().boresight_rms;
    path[best].evaluations = found.evaluations;
    path[best].violations = least;
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
