#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include <boresight/design/limits/controller_refinement.hpp>
#include <boresight/design/limits/parallel_sections.hpp>
#include <boresight/design/limits/sampled_spectrum.hpp>
#include <boresight/design/tuning/feasible_search.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/parallel_loop.hpp>
#include <boresight/numerics/singular_values.hpp>

namespace boresight::design {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Between neighbours on the grid of the gradients: a resonance of 0.5 % damping has some points.
constexpr double spacing = 1.004;
// Below the grid, where slow poles of a controller act.
constexpr double slow_spacing = 1.3, slow_decades = 3.0;
// What the constraints keep in hand for peaks between the points, and how far a step may miss that.
constexpr double first_margin = 4e-3, tolerance = 1e-3;
constexpr double first_radius = 8e-3, min_radius = 5e-4, max_radius = 0.5;
// An rms at standstill may be that much of the start's when the largest over the plants is as
// large.
constexpr double allowance_at_standstill = 1.15;
// Cost of missing a constraint by a factor of e: above what it can gain.
constexpr double slack_cost = 5.0, max_slack = 3.0;
constexpr int evaluations_a_step = 10;
constexpr double worthwhile = 1e-4;
// Of every so many plants the boresight counts for the coordinates; sensitivities do of all, since
// each plant's resonances lie elsewhere.
constexpr std::size_t plants_a_curvature = 3;
// A unit of the coordinates changes figures by about this fraction of themselves, over all plants.
constexpr double unit_change = 0.4;
// Of the largest curvature, scaled: directions with less hardly matter and get no more room.
constexpr double min_curvature = 1e-3;

Eigen::ArrayXd refinement_frequencies(const Eigen::ArrayXd& grid) {
  std::vector<double> kept;
  for (double place = grid[0] * std::pow(10.0, -slow_decades); place < grid[0] / slow_spacing;
       place *= slow_spacing) {
    kept.push_back(place);
  }
  for (const double place : grid) {
    if (kept.empty() || place > spacing * kept.back()) kept.push_back(place);
  }
  return Eigen::Map<Eigen::ArrayXd>(kept.data(), static_cast<Index>(kept.size()));
}

// Real and imaginary parts one below the other, so that Re(a^H b) is a real product.
MatrixXd stacked(const Eigen::MatrixXcd& matrix) {
  MatrixXd result(2 * matrix.rows(), matrix.cols());
  result << matrix.real(), matrix.imag();
  return result;
}

class Refinement {
 public:
  Refinement(const plant::StateSpace& start, const RobustConstraints& constraints)
      : constraints_(constraints),
        sections_(start),
        frequency_(refinement_frequencies(constraints.plants().front().frequency())),
        centre_(sections_.parameters()),
        plants_(spectra(constraints.plants())),
        at_standstill_(spectra(constraints.at_standstill())) {
    const auto response = sections_.response(centre_, frequency_);
    double worst = -HUGE_VAL;
    for (const auto& one : plants_) {
      worst = std::max(worst, loop_figures(one, response.value).boresight_rms.logarithm);
    }
    references_.assign(plants_.size(), worst);
    for (const auto& one : at_standstill_) {
      references_.push_back(loop_figures(one, response.value).boresight_rms.logarithm +
                            std::log(allowance_at_standstill));
    }
  }

  RefinementResult run(const plant::StateSpace& start, int steps) {
    RefinementResult result{start, constraints_.largest_rms(start), 0, 0};
    double radius = first_radius, best = 0.0;
    MatrixXd directions = own_directions();
    for (int i = 0; i < steps && radius >= min_radius; ++i) {
      Step found = step(directions, radius);
      result.evaluations += found.evaluations;
      if (!(found.cost < best - worthwhile)) {
        radius *= 0.5;
        continue;
      }
      const double excess = constraints_.excess(found.controller);
      if (excess > 0.0) {
        // A peak between the points: keep more in hand. Else the step was too long.
        if (excess < 2.0 * margin_) {
          margin_ += excess;
        } else {
          radius *= 0.5;
        }
        continue;
      }
      const double rms = constraints_.largest_rms(found.controller);
      if (!(rms < result.boresight_rms)) break;  // what the grid shows is no more than its error
      best = found.cost;
      centre_ = std::move(found.parameters);
      directions = own_directions();
      radius = std::min(1.4 * radius, max_radius);
      result.controller = std::move(found.controller);
      result.boresight_rms = rms;
      ++result.steps;
    }
    return result;
  }

 private:
  struct Step {
    VectorXd parameters;
    plant::StateSpace controller;
    double cost = 0.0;
    long evaluations = 0;
  };

  std::vector<SampledSpectrum> spectra(const std::vector<SampledSetting>& settings) const {
    std::vector<SampledSpectrum> result(settings.size());
    numerics::for_each_index(settings.size(), constraints_.threads(), [&](std::size_t i) {
      result[i] = sampled_spectrum(settings[i], frequency_);
    });
    return result;
  }

  std::size_t plants() const { return plants_.size() + at_standstill_.size(); }
  const SampledSpectrum& plant(std::size_t i) const {
    return i < plants_.size() ? plants_[i] : at_standstill_[i - plants_.size()];
  }
  double peak_goal(std::size_t i) const {
    const SampledLoopGoals& goals = constraints_.goals();
    return i < plants_.size() ? goals.sensitivity_peak : goals.standstill_peak;
  }

  // Columns: steps of the parameters of unit effect on mean square and sensitivities.
  MatrixXd own_directions() const {
    const auto response = sections_.response(centre_, frequency_);
    std::vector<MatrixXd> parts(plants());
    numerics::for_each_index(plants(), constraints_.threads(), [&](std::size_t i) {
      parts[i] = curvature(plant(i), peak_goal(i), response,
                           i < plants_.size() && i % plants_a_curvature == 0);
    });
    MatrixXd sum = MatrixXd::Zero(centre_.size(), centre_.size());
    for (const MatrixXd& part : parts) sum += part;
    sum = sum.selfadjointView<Eigen::Lower>();
    sum /= unit_change * unit_change * static_cast<double>(plants());
    VectorXd scale = sum.diagonal().cwiseSqrt();
    // A parameter of no effect, as of a sensor without noise or response, stays within its box.
    scale = (scale.array() > 0.0).select(scale.cwiseInverse(), 1.0);
    const auto parts_of = numerics::singular_values(scale.asDiagonal() * sum * scale.asDiagonal());
    const VectorXd size = (parts_of.values.array() + min_curvature).sqrt().inverse();
    return scale.asDiagonal() * parts_of.u * size.asDiagonal();
  }

  MatrixXd curvature(const SampledSpectrum& spectrum, double goal,
                     const ParallelSections::Response& response, bool with_rms) const {
    const Index count = frequency_.size();
    // Of ln S, weighted where |S| is next to its goal.
    const Eigen::ArrayXcd sensitivity = sensitivity_function(spectrum, response.value);
    const Eigen::ArrayXcd weight = sensitivity * (sensitivity.abs() / goal).min(1.0);
    Eigen::MatrixXcd rows = Eigen::MatrixXcd::Zero(count, centre_.size());
    for (Index i = 0; i < ParallelSections::sensors; ++i) {
      rows += (weight * spectrum.response.col(i)).matrix().asDiagonal() *
              response.by_parameters.at(static_cast<std::size_t>(i));
    }
    MatrixXd result = MatrixXd::Zero(centre_.size(), centre_.size());
    result.selfadjointView<Eigen::Lower>().rankUpdate(stacked(rows).transpose());
    if (!with_rms) return result;
    const Eigen::MatrixXcd factors = boresight_curvature(spectrum, response.value);
    for (Index row = 0; row < ParallelSections::sensors; ++row) {
      rows.setZero();
      for (Index i = 0; i < ParallelSections::sensors; ++i) {
        Eigen::VectorXcd factor(count);
        for (Index k = 0; k < count; ++k) {
          factor[k] = factors(ParallelSections::sensors * k + row, i);
        }
        rows += factor.asDiagonal() * response.by_parameters.at(static_cast<std::size_t>(i));
      }
      result.selfadjointView<Eigen::Lower>().rankUpdate(stacked(rows).transpose(),
                                                        static_cast<double>(plants_a_curvature));
    }
    return result;
  }

  Step step(const MatrixXd& directions, double radius) const {
    const auto size = static_cast<std::size_t>(centre_.size());
    ConstrainedProblem problem;
    problem.lower.assign(size, -radius);
    problem.upper.assign(size, radius);
    // The last variable: by how much constraints are missed.
    problem.lower.push_back(0.0);
    problem.upper.push_back(max_slack);
    problem.objectives = plants();
    problem.constraints = plants_.size() + plants() +
                          static_cast<std::size_t>(sections_.stability(centre_).conditions.size());
    // The search's own record has only points that miss no constraint at all, and curved ones are
    // always missed by a little.
    Step result;
    double least = HUGE_VAL;
    problem.evaluate = [&](const std::vector<double>& point, ConstrainedValues& values) {
      evaluate(directions, point, values);
      const double cost = values.cost() - slack_cost * point.back();
      const double missed = std::max(0.0, values.violation() + point.back() - tolerance);
      if (cost + slack_cost * missed < least) {
        least = cost + slack_cost * missed;
        result.cost = cost;
        result.parameters = moved(directions, point);
      }
      return true;
    };
    FeasibleSearchOptions options;
    options.evaluations_per_run = evaluations_a_step;
    options.max_restarts = 0;
    FeasibleSearch search(std::move(problem), options);
    std::vector<double> first(size + 1, 0.0);
    first.back() = std::clamp(search.evaluate(first)->violation(), 0.0, max_slack);
    search.search_from(first);
    result.evaluations = search.evaluations();
    result.controller = sections_.state_space(result.parameters);
    return result;
  }

  VectorXd moved(const MatrixXd& directions, const std::vector<double>& point) const {
    return centre_ + directions * Eigen::Map<const VectorXd>(point.data(), directions.cols());
  }

  void evaluate(const MatrixXd& directions, const std::vector<double>& point,
                ConstrainedValues& values) const {
    const VectorXd parameters = moved(directions, point);
    const auto response = sections_.response(parameters, frequency_);
    std::array<MatrixXd, ParallelSections::sensors> derivatives;
    for (std::size_t i = 0; i < derivatives.size(); ++i) {
      derivatives.at(i) = stacked(response.by_parameters.at(i));
    }
    const Index count = frequency_.size(), size = centre_.size();
    const double slack = point.back();
    const auto store = [&](std::vector<double>& rows, std::size_t row, const auto& gradient,
                           double by_slack) {
      Eigen::Map<VectorXd> target(rows.data() + row * point.size(), size + 1);
      target.head(size) = gradient;
      target[size] = by_slack;
    };
    const auto constrain = [&](std::size_t row, double value, const auto& gradient) {
      values.constraints[row] = value - slack;
      store(values.constraint_gradients, row, gradient, -1.0);
    };
    const SampledLoopGoals& goals = constraints_.goals();
    numerics::for_each_index(plants(), constraints_.threads(), [&](std::size_t i) {
      const LoopFigures figures = loop_figures(plant(i), response.value);
      // 2 Re sum(gradient * dK): of the three figures at once.
      MatrixXd gradients = MatrixXd::Zero(size, 3);
      for (Index sensor = 0; sensor < ParallelSections::sensors; ++sensor) {
        MatrixXd weights(2 * count, 3);
        const std::array<const LoopFigure*, 3> each{&figures.boresight_rms, &figures.control_effort,
                                                    &figures.sensitivity_peak};
        for (Index k = 0; k < 3; ++k) {
          const auto column = each.at(static_cast<std::size_t>(k))->gradient.col(sensor);
          weights.col(k) << column.real(), -column.imag();
        }
        gradients.noalias() +=
            2.0 * derivatives.at(static_cast<std::size_t>(sensor)).transpose() * weights;
      }
      gradients = (directions.transpose() * gradients).eval();
      values.objectives[i] = figures.boresight_rms.logarithm - references_[i] + slack_cost * slack;
      store(values.objective_gradients, i, gradients.col(0), slack_cost);
      constrain(i, figures.sensitivity_peak.logarithm - std::log(peak_goal(i)) + margin_,
                gradients.col(2));
      if (i >= plants_.size()) return;
      constrain(plants() + i,
                figures.control_effort.logarithm - std::log(goals.control_effort) + margin_,
                gradients.col(1));
    });
    const auto stability = sections_.stability(parameters);
    for (Index k = 0; k < stability.conditions.size(); ++k) {
      constrain(plants() + plants_.size() + static_cast<std::size_t>(k), stability.conditions[k],
                directions.transpose() * stability.gradients.row(k).transpose());
    }
  }

  const RobustConstraints& constraints_;
  ParallelSections sections_;
  Eigen::ArrayXd frequency_;
  VectorXd centre_;
  std::vector<SampledSpectrum> plants_, at_standstill_;
  std::vector<double> references_;  // ln of the rms of the start
  double margin_ = first_margin;
};

}  // namespace

RefinementResult refine_controller(const plant::StateSpace& start,
                                   const RobustConstraints& constraints,
                                   const RefinementOptions& options) {
  if (options.steps < 1) {
    throw InvalidInput(
        fmt::format("refine_controller: expected at least 1 step, found {}", options.steps));
  }
  const double excess = constraints.excess(start);
  if (excess > 0.0) {
    throw InvalidInput(
        fmt::format("refine_controller: expected a start that meets its constraints, found one "
                    "that exceeds one by a factor of {:.4g} or is unstable",
                    std::exp(excess)));
  }
  return Refinement(start, constraints).run(start, options.steps);
}

}  // namespace boresight::design
