#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <boresight/design/limits/refinement_problem.hpp>
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
constexpr double spacing = 1.005;
// Below the grid, where slow poles of a controller act.
constexpr double slow_spacing = 1.3, slow_decades = 3.0;
// Logarithmic reserves of peaks and effort, and the violation of them that counts as none.
constexpr double peak_margin = 2e-3, effort_margin = 4e-3, tolerance = 1e-3;
// Factor on corrections that an accepted step does not need.
constexpr double correction_fall = 0.7;
// Weight of the rms at standstill: its ratio to the start's may be larger by this factor.
constexpr double allowance_at_standstill = 1.15;
// Penalty per logarithmic violation, above what a violation can gain.
constexpr double slack_cost = 5.0, max_slack = 3.0;
constexpr int evaluations_a_step = 30;
constexpr std::size_t plants_a_block = 6;
constexpr Index figures_a_plant = 2;
// A unit of the coordinates changes figures by about this fraction of themselves, over all plants.
constexpr double unit_change = 0.4;
// Added to the curvature, which is scaled to 1 for each parameter alone: directions with less
// hardly matter and get no more room.
constexpr double min_curvature = 5e-3;

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

// Per sensor, parameters_of(it) x 2 frequencies: first the real parts, then the imaginary ones.
std::array<MatrixXd, sensors> transposed_derivatives(const ParallelSections::Response& response) {
  std::array<MatrixXd, sensors> result;
  for (std::size_t i = 0; i < result.size(); ++i) {
    result.at(i) = stacked(response.by_parameters.at(i)).transpose();
  }
  return result;
}

// 1/abs(K) from the encoder at the lowest frequency, three decades below the plants' grid: at rest.
PeakFigure inverse_at_rest(const ArrayXXcd& controller) {
  constexpr Index encoder = 1;
  const std::complex<double> gain = controller(0, encoder);
  PeakFigure figure;
  figure.logarithm = -std::log(std::abs(gain));
  // d(-ln abs(K)) = -Re(dK/K) = 2 Re(gradient dK).
  PeakFigure::Point point;
  point.frequency = 0;
  point.gradient.at(encoder) = -0.5 / gain;
  figure.points.push_back(point);
  return figure;
}

// At each frequency the Hermitian form of a change of the response to the sensors.
ArrayXXcd quadratic_form(const SampledSpectrum& spectrum, double goal, const ArrayXXcd& controller,
                         bool with_rms) {
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

}  // namespace

RefinementProblem::RefinementProblem(const plant::StateSpace& start,
                                     const RobustConstraints& constraints, const PoleBounds& bounds)
    : constraints_(constraints),
      sections_(start, bounds),
      frequency_(refinement_frequencies(constraints.plants().front().frequency())),
      centre_(sections_.parameters()),
      moving_(constraints.plants().size()),
      rated_(moving_ + constraints.at_standstill().size()),
      limited_positions_(constraints.goals().position_peak ? rated_ : 0) {
  std::vector<const SampledSetting*> settings;
  for (const auto group : {constraints.plants(), constraints.at_standstill(),
                           constraints.at_edges(), constraints.corners()}) {
    for (const SampledSetting& one : group) settings.push_back(&one);
  }
  const std::size_t loops = settings.size();
  if (constraints.goals().locked_motor_gain) {
    for (const SampledSetting& one : constraints.motor_locked()) settings.push_back(&one);
  }
  spectra_.resize(settings.size());
  numerics::for_each_index(settings.size(), constraints.threads(), [&](std::size_t i) {
    spectra_[i] = sampled_spectrum(*settings[i], frequency_);
  });
  for (std::size_t i = 0; i < spectra_.size(); ++i) {
    (i < loops ? evaluators_ : locked_).emplace_back(spectra_[i]);
  }
  spectra_.resize(loops);
  const std::size_t at_rest = constraints.goals().static_gain ? 1 : 0;
  corrections_ = of_centre_ = VectorXd::Constant(
      static_cast<Index>(loops + limited_positions_ + locked_.size() + at_rest), peak_margin);
  references_ = constraints.rms(start).array().log();
  references_.tail(static_cast<Index>(rated_ - moving_)).array() +=
      std::log(allowance_at_standstill);
  choose_directions();
}

double RefinementProblem::peak_goal(std::size_t i) const {
  const SampledLoopGoals& goals = constraints_.goals();
  if (i < moving_) return goals.sensitivity_peak;
  if (i < rated_) return goals.standstill_peak;
  return i < rated_ + constraints_.at_edges().size() ? goals.edge_peak : goals.sensitivity_peak;
}

double RefinementProblem::objective(const VectorXd& rms) const {
  return (rms.array().log() - references_.array()).maxCoeff();
}

void RefinementProblem::move_to(const Step& step) {
  centre_ = step.parameters;
  choose_directions();
}

bool RefinementProblem::correct(const Step& step, const VectorXd& exact, Correction how) {
  const VectorXd needed = (exact - step.peaks).cwiseMax(0.0).array() + peak_margin;
  const bool rose = (needed.array() > corrections_.array()).any();
  const double kept = how == Correction::afresh ? correction_fall : 1.0;
  corrections_ = (kept * corrections_).cwiseMax(needed);
  if (how == Correction::afresh) of_centre_ = needed;
  return rose;
}

void RefinementProblem::ease_corrections() {
  corrections_ = 0.5 * (corrections_ + of_centre_);
}

void RefinementProblem::choose_directions() {
  const auto response = sections_.response(centre_, frequency_);
  MatrixXd sum = curvature(response) / (unit_change * unit_change * static_cast<double>(all()));
  // A pole that hardly matters must not leave all bounds either.
  for (const Index k : sections_.logarithms()) sum(k, k) += 1.0;
  VectorXd scale = sum.diagonal().cwiseSqrt();
  // A parameter of no effect, as of a sensor without noise or response, stays within its box.
  scale = (scale.array() > 0.0).select(scale.cwiseInverse(), 1.0);
  const auto parts_of = numerics::singular_values(scale.asDiagonal() * sum * scale.asDiagonal());
  const VectorXd size = (parts_of.values.array() + min_curvature).sqrt().inverse();
  directions_ = scale.asDiagonal() * parts_of.u * size.asDiagonal();
}

// Of the sum over the plants: as each is a quadratic form in the change of the response at each
// frequency, the forms are added up first.
MatrixXd RefinementProblem::curvature(const ParallelSections::Response& response) const {
  std::vector<ArrayXXcd> forms(all());
  numerics::for_each_index(all(), constraints_.threads(), [&](std::size_t i) {
    forms[i] = quadratic_form(spectra_[i], peak_goal(i), response.value, i < moving_);
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

VectorXd RefinementProblem::moved(const std::vector<double>& point) const {
  return centre_ + directions_ * Eigen::Map<const VectorXd>(point.data(), directions_.cols());
}

RefinementProblem::Figures RefinementProblem::figures(const ArrayXXcd& response,
                                                      bool with_rms) const {
  const std::vector<SensorPack> controller = packed_response(response);
  Figures result{std::vector<LoopFigures>(all()), {}, {}};
  numerics::for_each_index(all(), constraints_.threads(), [&](std::size_t i) {
    if (with_rms && i < rated_) {
      result.loops[i] = evaluators_[i].figures(controller);
    } else {
      result.loops[i].peaks = evaluators_[i].peaks(controller);
    }
  });
  for (const LoopFigureEvaluator& one : locked_) {
    result.locked.push_back(one.locked_motor_gain(controller));
  }
  if (constraints_.goals().static_gain) result.at_rest.push_back(inverse_at_rest(response));
  return result;
}

VectorXd RefinementProblem::peaks(const Figures& figures) const {
  VectorXd result(corrections_.size());
  for (std::size_t i = 0; i < all(); ++i) {
    result[static_cast<Index>(i)] =
        figures.loops[i].peaks.sensitivity_peak.logarithm - std::log(peak_goal(i));
  }
  const SampledLoopGoals& goals = constraints_.goals();
  for (std::size_t i = 0; i < limited_positions_; ++i) {
    const double goal = i < moving_ ? *goals.position_peak : goals.standstill_peak;
    result[static_cast<Index>(all() + i)] =
        figures.loops[i].peaks.position_peak.logarithm - std::log(goal);
  }
  for (std::size_t i = 0; i < locked_.size(); ++i) {
    result[static_cast<Index>(all() + limited_positions_ + i)] =
        figures.locked[i].logarithm - std::log(*goals.locked_motor_gain);
  }
  for (const PeakFigure& one : figures.at_rest) {
    result[result.size() - 1] = one.logarithm + std::log(*goals.static_gain);
  }
  return result;
}

// 2 Re sum(gradient * dK) per parameter.
MatrixXd RefinementProblem::by_parameters(const Derivatives& derivatives,
                                          std::span<const RmsFigure* const> figures) const {
  const Index count = frequency_.size();
  constexpr auto pack = static_cast<Index>(numerics::pack_size);
  MatrixXd weights(2 * count, static_cast<Index>(figures.size()));
  MatrixXd result = MatrixXd::Zero(centre_.size(), weights.cols());
  for (std::size_t sensor = 0; sensor < derivatives.size(); ++sensor) {
    for (Index column = 0; column < weights.cols(); ++column) {
      const auto& gradient = figures[static_cast<std::size_t>(column)]->gradient;
      for (Index k = 0; k < count; ++k) {
        const auto& at = gradient[static_cast<std::size_t>(k / pack)].at(sensor);
        const auto lane = static_cast<std::size_t>(k % pack);
        weights(k, column) = at.re[lane];
        weights(count + k, column) = -at.im[lane];
      }
    }
    result(sections_.parameters_of(static_cast<Index>(sensor)), Eigen::all) +=
        2.0 * derivatives.at(sensor) * weights;
  }
  return result;
}

VectorXd RefinementProblem::by_parameters(const Derivatives& derivatives,
                                          const PeakFigure& figure) const {
  const Index count = frequency_.size();
  VectorXd result = VectorXd::Zero(centre_.size());
  for (std::size_t sensor = 0; sensor < derivatives.size(); ++sensor) {
    const MatrixXd& derivative = derivatives.at(sensor);
    VectorXd sum = VectorXd::Zero(derivative.rows());
    for (const PeakFigure::Point& point : figure.points) {
      const std::complex<double>& weight = point.gradient.at(sensor);
      sum += weight.real() * derivative.col(point.frequency) -
             weight.imag() * derivative.col(count + point.frequency);
    }
    result(sections_.parameters_of(static_cast<Index>(sensor))) += 2.0 * sum;
  }
  return result;
}

// The last variable is the violation that is allowed, at a cost. Constraints: peaks, efforts,
// conditions of stability.
void RefinementProblem::evaluate(const std::vector<double>& point,
                                 ConstrainedValues& values) const {
  const VectorXd parameters = moved(point);
  const auto response = sections_.response(parameters, frequency_);
  const Derivatives derivatives = transposed_derivatives(response);
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
  const Figures found = figures(response.value, true);
  const std::vector<LoopFigures>& of = found.loops;
  const VectorXd peak = peaks(found) + corrections_;
  const auto efforts = static_cast<std::size_t>(peak.size());
  const double effort_goal = std::log(constraints_.goals().control_effort) - effort_margin;
  // Products of some plants at a time: more would not stay in the processor's cache.
  const std::size_t blocks = (rated_ + plants_a_block - 1) / plants_a_block;
  numerics::for_each_index(blocks, constraints_.threads(), [&](std::size_t block) {
    const std::size_t first = block * plants_a_block;
    const std::size_t last = std::min(first + plants_a_block, rated_);
    std::vector<const RmsFigure*> figures;
    for (std::size_t i = first; i < last; ++i) {
      figures.insert(figures.end(), {&of[i].boresight_rms, &of[i].control_effort});
    }
    const MatrixXd gradients = directions_.transpose() * by_parameters(derivatives, figures);
    for (std::size_t i = first; i < last; ++i) {
      const Index column = figures_a_plant * static_cast<Index>(i - first);
      values.objectives[i] =
          of[i].boresight_rms.logarithm - references_[static_cast<Index>(i)] + slack_cost * slack;
      store(values.objective_gradients, i, gradients.col(column), slack_cost);
      if (i < moving_) {
        constrain(efforts + i, of[i].control_effort.logarithm - effort_goal,
                  gradients.col(column + 1));
      }
    }
  });
  MatrixXd by_peaks(size, peak.size());
  for (std::size_t i = 0; i < all(); ++i) {
    const LoopPeaks& on = of[i].peaks;
    by_peaks.col(static_cast<Index>(i)) = by_parameters(derivatives, on.sensitivity_peak);
    if (i < limited_positions_) {
      by_peaks.col(static_cast<Index>(all() + i)) = by_parameters(derivatives, on.position_peak);
    }
  }
  for (std::size_t i = 0; i < locked_.size(); ++i) {
    by_peaks.col(static_cast<Index>(all() + limited_positions_ + i)) =
        by_parameters(derivatives, found.locked[i]);
  }
  for (const PeakFigure& one : found.at_rest) {
    by_peaks.col(by_peaks.cols() - 1) = by_parameters(derivatives, one);
  }
  const MatrixXd gradients = directions_.transpose() * by_peaks;
  for (Index row = 0; row < peak.size(); ++row) {
    constrain(static_cast<std::size_t>(row), peak[row], gradients.col(row));
  }
  const auto stability = sections_.stability(parameters);
  for (Index k = 0; k < stability.conditions.size(); ++k) {
    constrain(efforts + moving_ + static_cast<std::size_t>(k), stability.conditions[k],
              directions_.transpose() * stability.gradients.row(k).transpose());
  }
}

RefinementProblem::Step RefinementProblem::step(double radius) const {
  const auto size = static_cast<std::size_t>(centre_.size());
  ConstrainedProblem problem;
  problem.lower.assign(size, -radius);
  problem.upper.assign(size, radius);
  problem.lower.push_back(0.0);
  problem.upper.push_back(max_slack);
  problem.objectives = rated_;
  problem.constraints = static_cast<std::size_t>(corrections_.size() + static_cast<Index>(moving_) +
                                                 sections_.stability(centre_).conditions.size());
  // FeasibleSearch records only points without any violation; curved constraints always leave a
  // small one.
  Step result;
  double at_centre = std::numeric_limits<double>::quiet_NaN(), least = HUGE_VAL;
  problem.evaluate = [&](const std::vector<double>& point, ConstrainedValues& values) {
    evaluate(point, values);
    const double violation = std::max(0.0, values.violation() + point.back() - tolerance);
    const double cost = values.cost() - slack_cost * point.back() + slack_cost * violation;
    if (std::isnan(at_centre)) at_centre = cost;
    if (cost < least) {
      least = cost;
      result.violation = violation;
      result.parameters = moved(point);
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
  result.gain = at_centre - least;
  result.evaluations = search.evaluations();
  result.controller = sections_.state_space(result.parameters);
  result.peaks = peaks(figures(sections_.response(result.parameters, frequency_).value, false));
  return result;
}

}  // namespace boresight::design
