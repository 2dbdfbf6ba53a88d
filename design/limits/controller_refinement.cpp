#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <span>
#include <utility>

#include <fmt/format.h>

#include <boresight/design/limits/controller_refinement.hpp>
#include <boresight/design/limits/parallel_sections.hpp>
#include <boresight/design/limits/sampled_spectrum.hpp>
#include <boresight/design/tuning/feasible_search.hpp>
#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/parallel_loop.hpp>
#include <boresight/numerics/singular_values.hpp>

namespace boresight::design {
namespace {

using Eigen::ArrayXXcd;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index sensors = ParallelSections::sensors;
// Between neighbours on the grid of the gradients: a resonance of 0.5 % damping has some points.
constexpr double spacing = 1.004;
// Below the grid, where slow poles of a controller act.
constexpr double slow_spacing = 1.3, slow_decades = 3.0;
// Margin of the constraints for peaks between the points, and by how much a step may miss it.
constexpr double first_margin = 4e-3, tolerance = 1e-3;
// A peak that exceeds its goal by less raises the margin; by more, the step was too long.
constexpr double max_excess = 5.0 * first_margin;
// The margin rises by this factor of what is missed: by as much, each next step would miss it again
// by less and less. An accepted step lowers it.
constexpr double margin_growth = 1.5, min_growth = 0.2 * first_margin, margin_fall = 0.8;
constexpr double first_radius = 8e-3, min_radius = 1e-4, max_radius = 0.5;
// An rms at standstill may be that much of the start's when the largest over the plants is as
// large.
constexpr double allowance_at_standstill = 1.15;
// Cost of missing a constraint by a factor of e: above what it can gain.
constexpr double slack_cost = 5.0, max_slack = 3.0;
constexpr int evaluations_a_step = 10;
// Steps in a row that RefinementOptions::accepts may refuse.
constexpr int max_refused = 3;
constexpr std::size_t plants_a_block = 6;
constexpr Index figures_a_plant = 3;
constexpr double worthwhile = 1e-4;
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

double slowest_pole(const plant::StateSpace& controller) {
  const Eigen::VectorXcd poles = numerics::eigen_decomposition(controller.a).values;
  return poles.size() == 0 ? HUGE_VAL
                           : ((1.0 - poles.real().array()) / controller.sample_time).minCoeff();
}

class Refinement {
 public:
  Refinement(const plant::StateSpace& start, const RobustConstraints& constraints,
             const RefinementOptions& options)
      : constraints_(constraints),
        options_(options),
        sections_(start, std::min(options.slowest_pole, slowest_pole(start))),
        frequency_(refinement_frequencies(constraints.plants().front().frequency())),
        centre_(sections_.parameters()),
        plants_(spectra(constraints.plants())),
        held_(spectra(constraints.at_standstill())),
        rated_(plants_.size() + held_.size()) {
    std::ranges::move(spectra(constraints.at_edges()), std::back_inserter(held_));
    const auto response = sections_.response(centre_, frequency_);
    double worst = -HUGE_VAL;
    for (const auto& one : plants_) {
      worst = std::max(worst, loop_figures(one, response.value).boresight_rms.logarithm);
    }
    references_.assign(plants_.size(), worst);
    for (std::size_t i = plants_.size(); i < rated_; ++i) {
      references_.push_back(loop_figures(plant(i), response.value).boresight_rms.logarithm +
                            std::log(allowance_at_standstill));
    }
  }

  RefinementResult run(const plant::StateSpace& start) {
    RefinementResult result{start, constraints_.largest_rms(start),
                            !(constraints_.excess(start) > 0.0), 0, 0};
    double radius = first_radius;
    double best = result.feasible ? 0.0 : HUGE_VAL;
    int refused = 0;
    std::vector<RefinementResult> path;  // the steps that met every constraint
    MatrixXd directions = own_directions();
    for (int i = 0; i < options_.steps && radius >= min_radius; ++i) {
      Step found = step(directions, radius);
      result.evaluations += found.evaluations;
      if (!(found.cost < best - worthwhile)) {
        radius *= 0.5;
        continue;
      }
      const double excess = constraints_.excess(found.controller);
      const double beyond = excess - (result.feasible ? 0.0 : found.missed);
      if (beyond > 0.0) {
        // A peak between the points: keep more in hand. Else the step was too long.
        if (beyond < max_excess) {
          const double more = std::max(margin_growth * beyond, min_growth);
          margin_ += more;
          best += slack_cost * more;  // what the last step costs with that, at most
        } else {
          radius *= 0.5;
        }
        continue;
      }
      // Where a peak exceeds its goal, excess() does not ask for stability.
      if (excess > 0.0 && !constraints_.stable(found.controller)) {
        radius *= 0.5;
        continue;
      }
      const double rms = constraints_.largest_rms(found.controller);
      const bool feasible = !(excess > 0.0);
      // What the grid shows may be no more than its error.
      if (result.feasible && !(rms < result.boresight_rms)) {
        radius *= 0.5;
        continue;
      }
      if (feasible && options_.accepts && !options_.accepts(found.controller)) {
        if (++refused == max_refused) break;
        radius *= 0.5;
        continue;
      }
      refused = 0;
      best = found.cost;
      margin_ = std::max(first_margin, margin_fall * margin_);
      centre_ = std::move(found.parameters);
      directions = own_directions();
      radius = std::min(1.4 * radius, max_radius);
      result.controller = std::move(found.controller);
      result.boresight_rms = rms;
      result.feasible = feasible;
      ++result.steps;
      if (options_.confirms && feasible) path.push_back(result);
    }
    return confirmed(std::move(result), std::move(path));
  }

 private:
  struct Step {
    VectorXd parameters;
    plant::StateSpace controller;
    double cost = 0.0;    // with that of what is missed
    double missed = 0.0;  // ln, of the constraints
    long evaluations = 0;
  };

  // The last step that is confirmed, by bisection; `found` if none of those asked is.
  RefinementResult confirmed(RefinementResult found, std::vector<RefinementResult> path) const {
    std::size_t known = 0, end = path.size();  // of the steps: confirmed, not so
    for (std::size_t next = end; known < end; next = (known + end + 1) / 2) {
      if (options_.confirms(path[next - 1].controller)) {
        known = next;
      } else {
        end = next - 1;
      }
    }
    if (known == 0) return found;
    path[known - 1].evaluations = found.evaluations;
    return std::move(path[known - 1]);
  }

  std::vector<SampledSpectrum> spectra(std::span<const SampledSetting> settings) const {
    std::vector<SampledSpectrum> result(settings.size());
    numerics::for_each_index(settings.size(), constraints_.threads(), [&](std::size_t i) {
      result[i] = sampled_spectrum(settings[i], frequency_);
    });
    return result;
  }

  std::size_t plants() const { return plants_.size() + held_.size(); }
  const SampledSpectrum& plant(std::size_t i) const {
    return i < plants_.size() ? plants_[i] : held_[i - plants_.size()];
  }
  double peak_goal(std::size_t i) const {
    const SampledLoopGoals& goals = constraints_.goals();
    if (i < plants_.size()) return goals.sensitivity_peak;
    return i < rated_ ? goals.standstill_peak : goals.edge_peak;
  }

  // Columns: steps of the parameters of unit effect on mean square and sensitivities.
  MatrixXd own_directions() const {
    const auto response = sections_.response(centre_, frequency_);
    MatrixXd sum =
        curvature(response) / (unit_change * unit_change * static_cast<double>(plants()));
    // A pole that hardly matters must not leave all bounds either.
    for (const Index k : sections_.logarithms()) sum(k, k) += 1.0;
    VectorXd scale = sum.diagonal().cwiseSqrt();
    // A parameter of no effect, as of a sensor without noise or response, stays within its box.
    scale = (scale.array() > 0.0).select(scale.cwiseInverse(), 1.0);
    const auto parts_of = numerics::singular_values(scale.asDiagonal() * sum * scale.asDiagonal());
    const VectorXd size = (parts_of.values.array() + min_curvature).sqrt().inverse();
    return scale.asDiagonal() * parts_of.u * size.asDiagonal();
  }

  // Of the sum over the plants: as each is a quadratic form in the change of the response at each
  // frequency, the forms are added up first.
  MatrixXd curvature(const ParallelSections::Response& response) const {
    std::vector<ArrayXXcd> forms(plants());
    numerics::for_each_index(plants(), constraints_.threads(), [&](std::size_t i) {
      forms[i] = quadratic_form(plant(i), peak_goal(i), response.value, i < plants_.size());
    });
    ArrayXXcd form = ArrayXXcd::Zero(frequency_.size(), sensors * sensors);
    for (const ArrayXXcd& one : forms) form += one;
    MatrixXd result = MatrixXd::Zero(centre_.size(), centre_.size());
    for (Index i = 0; i < sensors; ++i) {
      const auto own = sections_.parameters_of(i);
      const MatrixXd left = stacked(response.by_parameters.at(static_cast<std::size_t>(i)));
      for (Index j = 0; j < sensors; ++j) {
        const MatrixXd right = stacked(form.col(sensors * i + j).matrix().asDiagonal() *
                                       response.by_parameters.at(static_cast<std::size_t>(j)));
        result(own, sections_.parameters_of(j)) += left.transpose() * right;
      }
    }
    return result;
  }

  // At each frequency the Hermitian form of a change of the response to the sensors.
  static ArrayXXcd quadratic_form(const SampledSpectrum& spectrum, double goal,
                                  const ArrayXXcd& controller, bool with_rms) {
    // Of ln S, weighted where |S| is next to its goal.
    const Eigen::ArrayXcd sensitivity = sensitivity_function(spectrum, controller);
    const ArrayXXcd factors =
        spectrum.response.colwise() * (sensitivity * (sensitivity.abs() / goal).min(1.0));
    ArrayXXcd form(factors.rows(), sensors * sensors);
    for (Index i = 0; i < sensors; ++i) {
      for (Index j = 0; j < sensors; ++j) {
        form.col(sensors * i + j) = factors.col(i).conjugate() * factors.col(j);
      }
    }
    if (!with_rms) return form;
    const Eigen::ArrayXXd of_effort = effort_curvature(spectrum, controller);
    for (Index i = 0; i < sensors; ++i) form.col((sensors + 1) * i) += of_effort.col(i);
    return form + boresight_curvature(spectrum, controller);
  }

  Step step(const MatrixXd& directions, double radius) const {
    const auto size = static_cast<std::size_t>(centre_.size());
    ConstrainedProblem problem;
    problem.lower.assign(size, -radius);
    problem.upper.assign(size, radius);
    // The last variable: by how much constraints are missed.
    problem.lower.push_back(0.0);
    problem.upper.push_back(max_slack);
    problem.objectives = rated_;
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
        result.cost = least;
        result.missed = missed;
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

  // 2 Re sum(gradient * dK) per parameter: three columns a plant.
  MatrixXd by_parameters(const std::array<MatrixXd, sensors>& derivatives,
                         std::span<const LoopFigures> figures) const {
    const Index count = figures.front().boresight_rms.gradient.rows();
    MatrixXd weights(2 * count, figures_a_plant * static_cast<Index>(figures.size()));
    MatrixXd result = MatrixXd::Zero(centre_.size(), weights.cols());
    for (Index sensor = 0; sensor < sensors; ++sensor) {
      Index column = 0;
      for (const LoopFigures& one : figures) {
        for (const LoopFigure* figure :
             {&one.boresight_rms, &one.control_effort, &one.sensitivity_peak}) {
          const auto gradient = figure->gradient.col(sensor);
          weights.col(column++) << gradient.real(), -gradient.imag();
        }
      }
      result(sections_.parameters_of(sensor), Eigen::all) +=
          2.0 * derivatives.at(static_cast<std::size_t>(sensor)).transpose() * weights;
    }
    return result;
  }

  void evaluate(const MatrixXd& directions, const std::vector<double>& point,
                ConstrainedValues& values) const {
    const VectorXd parameters = moved(directions, point);
    const auto response = sections_.response(parameters, frequency_);
    std::array<MatrixXd, sensors> derivatives;
    for (std::size_t i = 0; i < derivatives.size(); ++i) {
      derivatives.at(i) = stacked(response.by_parameters.at(i));
    }
    const Index size = centre_.size();
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
    std::vector<LoopFigures> figures(plants());
    numerics::for_each_index(plants(), constraints_.threads(), [&](std::size_t i) {
      figures[i] = loop_figures(plant(i), response.value);
    });
    // Products of some plants at a time: more would not stay in the processor's cache.
    const std::size_t blocks = (plants() + plants_a_block - 1) / plants_a_block;
    numerics::for_each_index(blocks, constraints_.threads(), [&](std::size_t block) {
      const std::size_t first = block * plants_a_block;
      const std::size_t last = std::min(first + plants_a_block, plants());
      const MatrixXd gradients =
          directions.transpose() * by_parameters(derivatives, {&figures[first], last - first});
      for (std::size_t i = first; i < last; ++i) {
        const auto gradient = [&](Index figure) {
          return gradients.col(figures_a_plant * static_cast<Index>(i - first) + figure);
        };
        if (i < rated_) {
          values.objectives[i] =
              figures[i].boresight_rms.logarithm - references_[i] + slack_cost * slack;
          store(values.objective_gradients, i, gradient(0), slack_cost);
        }
        constrain(i, figures[i].sensitivity_peak.logarithm - std::log(peak_goal(i)) + margin_,
                  gradient(2));
        if (i >= plants_.size()) continue;
        constrain(plants() + i,
                  figures[i].control_effort.logarithm - std::log(goals.control_effort) + margin_,
                  gradient(1));
      }
    });
    const auto stability = sections_.stability(parameters);
    for (Index k = 0; k < stability.conditions.size(); ++k) {
      constrain(plants() + plants_.size() + static_cast<std::size_t>(k), stability.conditions[k],
                directions.transpose() * stability.gradients.row(k).transpose());
    }
  }

  const RobustConstraints& constraints_;
  const RefinementOptions& options_;
  ParallelSections sections_;
  Eigen::ArrayXd frequency_;
  VectorXd centre_;
  std::vector<SampledSpectrum> plants_, held_;  // at standstill, then at edges
  std::size_t rated_;                           // of both, those whose rms is minimised
  std::vector<double> references_;              // of these: ln of the rms of the start
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
  if (!constraints.stable(start)) {
    throw InvalidInput(
        "refine_controller: expected a start that is stable by itself and on every plant, found "
        "one that is not");
  }
  return Refinement(start, constraints, options).run(start);
}

}  // namespace boresight::design
