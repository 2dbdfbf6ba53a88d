#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <boresight/design/benchmark/rejection_benchmark.hpp>
#include <boresight/design/benchmark/rejection_response.hpp>
#include <boresight/design/limits/pointing_limit.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/parallel_loop.hpp>
#include <boresight/plant/linear/response_grid.hpp>

namespace boresight::design {
namespace {

constexpr std::array wind_models{plant::WindModel::coherence, plant::WindModel::vickery,
                                 plant::WindModel::uniform};
// An eigenvalue of 1 to rounding: the free angle of an antenna whose position loop is open.
constexpr double free_angle = 1.0 + 1e-8;
constexpr double largest_disagreement = 0.02;

// Integrals of something over a wind's torque spectrum, for any torque coefficient: that of its
// square, and the part from gradients over the dish that does not know it.
struct WindIntegral {
  double by_square = 0.0;
  double by_gradient = 0.0;

  double at(double coefficient) const {
    return coefficient * coefficient * by_square + by_gradient;
  }
};

struct WindIntegrals {
  WindIntegral torque;     // (N m)^2 at the motor
  WindIntegral boresight;  // rad^2 of motor
};

WindIntegrals wind_integrals(const TrackingProblem& problem, const RejectionResponse& response,
                             plant::WindModel model, double speed) {
  TrackingProblem windy = problem;
  windy.climate.clear();
  windy.wind.model = model;
  windy.wind.mean_speed = speed;
  const auto add = [&](double WindIntegral::*part, WindIntegrals& result) {
    const WindTable table(windy);
    for (Eigen::Index i = 0; i < response.frequency.size(); ++i) {
      const double weight = response.wind_weight[i];
      if (weight == 0.0) continue;
      const double power = weight * table.spectrum(response.frequency[i]);
      result.torque.*part += power;
      result.boresight.*part += power * response.boresight_by_wind_square[i];
    }
  };
  WindIntegrals result;
  windy.wind.site.torque_coefficient = 1.0;
  const double gradient = windy.wind.site.gradient_coefficient;
  windy.wind.site.gradient_coefficient = 0.0;
  add(&WindIntegral::by_square, result);
  if (model == plant::WindModel::coherence && gradient != 0.0) {
    windy.wind.site.torque_coefficient = 0.0;
    windy.wind.site.gradient_coefficient = gradient;
    add(&WindIntegral::by_gradient, result);
  }
  return result;
}

WindScore wind_score(const TrackingProblem& problem, const WindIntegrals& integrals,
                     const WindAttitudeCoefficient& attitude, plant::WindModel model, double speed,
                     double noise_variance) {
  WindScore score;
  score.attitude = attitude.name;
  score.torque_coefficient = attitude.torque_coefficient;
  score.model = model;
  score.mean_speed = speed;
  const double ratio = problem.gear_ratio;
  const double wind = integrals.boresight.at(attitude.torque_coefficient);
  score.torque_rms = std::sqrt(integrals.torque.at(attitude.torque_coefficient)) * ratio;
  score.wind_rms = std::sqrt(wind) / ratio;
  score.boresight_rms = std::sqrt(wind + noise_variance) / ratio;
  return score;
}

std::vector<WindScore> ladder(const TrackingProblem& problem, const RejectionResponse& response,
                              const RejectionOptions& options) {
  const WindAttitudeCoefficient own{"", problem.wind.site.torque_coefficient};
  constexpr std::size_t speeds = rejection_speeds.size();
  std::vector<std::vector<WindScore>> parts(wind_models.size() * speeds);
  numerics::for_each_index(parts.size(), options.threads, [&](std::size_t i) {
    const plant::WindModel model = wind_models.at(i / speeds);
    const double speed = rejection_speeds.at(i % speeds);
    const WindIntegrals integrals = wind_integrals(problem, response, model, speed);
    const auto add = [&](const WindAttitudeCoefficient& attitude) {
      parts[i].push_back(
          wind_score(problem, integrals, attitude, model, speed, response.noise_variance));
    };
    add(own);
    if (model == problem.wind.model) std::ranges::for_each(options.attitudes, add);
  });
  std::vector<WindScore> winds;
  for (const auto& part : parts) winds.insert(winds.end(), part.begin(), part.end());
  // The problem's own coefficient model by model, then attitude by attitude.
  const auto place = [&](const WindScore& score) {
    const auto found =
        std::ranges::find(options.attitudes, score.attitude, &WindAttitudeCoefficient::name);
    return score.attitude.empty() ? std::ptrdiff_t{-1} : found - options.attitudes.begin();
  };
  std::ranges::stable_sort(winds, {}, place);
  return winds;
}

// The mean speed at which the beam's rms reaches a budget, as wind_speed_limit.
double speed_limit(const TrackingProblem& problem, const RejectionResponse& response,
                   double budget) {
  const double wanted = std::pow(budget * problem.gear_ratio, 2) - response.noise_variance;
  if (!(wanted > 0.0)) return 0.0;
  const double coefficient = problem.wind.site.torque_coefficient;
  const auto excess = [&](double log_speed) {
    const auto integrals =
        wind_integrals(problem, response, problem.wind.model, std::exp(log_speed));
    return std::log(integrals.boresight.at(coefficient) / wanted);
  };
  double low = std::log(0.1), high = std::log(60.0);
  double below = excess(low), above = excess(high);
  if (!(above > 0.0)) return std::numeric_limits<double>::infinity();
  if (!(below < 0.0)) return 0.1;
  // Nearly straight in the logarithms: false position, the end that stays halved (Illinois).
  int side = 0;
  double middle = low;
  for (int iteration = 0; iteration < 60; ++iteration) {
    middle = (low * above - high * below) / (above - below);
    const double value = excess(middle);
    if (std::abs(value) < 1e-9 || high - low < 1e-12) break;
    if (value > 0.0) {
      high = middle;
      above = value;
      if (side == 1) below *= 0.5;
      side = 1;
    } else {
      low = middle;
      below = value;
      if (side == -1) above *= 0.5;
      side = -1;
    }
  }
  return std::exp(middle);
}

RejectionMember evaluate_member(const TrackingProblem& problem, const EnsembleMember& member,
                                const Constraints& goals, const plant::StateSpace& controller,
                                const WindTable& wind) {
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  RejectionMember result{member.name, false, false, nothing, nothing, {nothing, nothing, nothing}};
  TrackingProblem other = problem;
  other.plant = member.plant;
  if (!control::ClosedLoopResponse(member.plant, controller, problem.delay).stable()) return result;
  result.stable = true;
  const RejectionResponse response = rejection_response(other, controller);
  double variance = response.noise_variance;
  for (Eigen::Index i = 0; i < response.frequency.size(); ++i) {
    if (response.wind_weight[i] == 0.0) continue;
    variance += response.wind_weight[i] * response.boresight_by_wind_square[i] *
                wind.spectrum(response.frequency[i]);
  }
  result.boresight_rms = std::sqrt(variance) / problem.gear_ratio;
  result.control_effort = std::sqrt(response.effort_variance);
  constexpr double rounding = 1.0 + 1e-4;  // of a tuned controller that stands at its goal
  // Without a rate command of its own it has neither of the other loops.
  const bool has_loops = std::ranges::count(controller.inputs, "rate_disturbance") > 0;
  result.within_constraints = result.control_effort <= goals.control_effort * rounding;
  for (std::size_t b = 0; b < control::loop_breaks.size(); ++b) {
    const double peak = response.peak(b);
    result.sensitivity_peaks.at(b) = peak;
    const bool counts = has_loops || control::loop_breaks[b] == control::LoopBreak::valve_command;
    if (counts && peak > goals.sensitivity_peak.at(b) * rounding) result.within_constraints = false;
  }
  return result;
}

RejectionEnsemble evaluate_members(const TrackingProblem& problem, const Constraints& goals,
                                   const plant::StateSpace& controller,
                                   const RejectionOptions& options) {
  RejectionEnsemble result;
  result.members.resize(options.members.size());
  const WindTable wind(problem);
  numerics::for_each_index(options.members.size(), options.threads, [&](std::size_t i) {
    result.members[i] = evaluate_member(problem, options.members[i], goals, controller, wind);
  });
  for (const auto& member : result.members) {
    result.stable += member.stable ? 1 : 0;
    result.within_constraints += member.within_constraints ? 1 : 0;
    if (member.stable) result.largest_rms = std::max(result.largest_rms, member.boresight_rms);
  }
  return result;
}

RejectionReference reference_of(const TrackingProblem& problem, const Constraints& goals,
                                double sample_time, double effort, unsigned threads) {
  RejectionReference reference;
  reference.flexure_rms = flexure_rms(problem);
  const auto& noise = problem.noise;
  if (!(noise.encoder_rms > 0.0) || !(noise.tachometer_rms > 0.0) || !(sample_time > 0.0)) {
    return reference;
  }
  const PointingLimit limit =
      pointing_limit(problem, goals, {}, {}, {.sample_time = sample_time, .threads = threads});
  reference.min_rms = limit.min_rms;
  reference.min_rms_at_own_effort = limit.bound.min_rms(effort);
  return reference;
}

// From the motor's axis, per torque there, to the sky, per torque at the antenna's axis.
control::ResponseScore at_sky(control::ResponseScore score, double gear_ratio) {
  const double square = gear_ratio * gear_ratio;
  score.final_value /= square;
  score.peak /= square;
  score.largest_error /= square;
  score.integral_squared_error /= square * square;
  return score;
}

std::array<BreakScore, 3> break_scores(const TrackingProblem& problem,
                                       const plant::StateSpace& controller,
                                       const RejectionResponse& response) {
  control::ControlledAntenna loop(problem.plant, controller, problem.delay);
  // Every third of the quadrature's points is the middle of an interval that follows the poles.
  std::vector<double> places;
  for (Eigen::Index i = 1; i < response.frequency.size(); i += 3) {
    if (response.frequency[i] < loop.nyquist_frequency()) places.push_back(response.frequency[i]);
  }
  const Eigen::ArrayXd grid =
      Eigen::Map<const Eigen::ArrayXd>(places.data(), static_cast<Eigen::Index>(places.size()));
  std::array<BreakScore, 3> scores;
  for (std::size_t b = 0; b < control::loop_breaks.size(); ++b) {
    scores.at(b).loop_break = control::loop_breaks.at(b);
    if (!loop.has(control::loop_breaks.at(b))) continue;
    scores.at(b).margins = control::margins(
        [&](double frequency) { return loop.at(frequency).loop_gain.at(b); }, grid);
  }
  return scores;
}

}  // namespace

std::vector<double> compliance_frequencies() {
  constexpr int points_per_decade = 40, first = -120;
  std::vector<double> result;
  for (int k = first;; ++k) {
    const double frequency = std::pow(10.0, static_cast<double>(k) / points_per_decade);
    if (frequency > 25.0) return result;
    result.push_back(frequency);
  }
}

RejectionScore rejection_benchmark(const TrackingProblem& problem, const Constraints& goals,
                                   const plant::StateSpace& controller,
                                   const RejectionOptions& options) {
  validate(goals);
  const plant::StateSpace antenna_form = control::antenna_state_space_controller(controller);
  const double square = problem.gear_ratio * problem.gear_ratio;
  RejectionScore score;
  const control::ClosedLoopResponse course(problem.plant, antenna_form, problem.delay);
  score.abscissa = course.abscissa();
  score.stable = course.stable();
  control::ControlledAntenna loop(problem.plant, antenna_form, problem.delay);
  if (loop.has(control::LoopBreak::rate_loop_alone)) {
    score.rate_loop_stable = control::ClosedLoopResponse(
                                 problem.plant, control::rate_loop_of(antenna_form), problem.delay)
                                 .spectral_radius() < free_angle;
  }
  if (!score.stable) return score;

  score.step = at_sky(course.score(control::DisturbanceType::step), problem.gear_ratio);
  score.impulse = at_sky(course.score(control::DisturbanceType::impulse), problem.gear_ratio);
  score.static_compliance = std::abs(score.step.final_value);
  score.worst = control::worst_compliance(problem.plant, antenna_form, problem.delay);
  score.worst.lower /= square;
  score.worst.upper /= square;
  for (const auto& mode : problem.plant.structure.modes) {
    score.flexure_compliance += mode.beam_weight * mode.wind_fraction / mode.stiffness;
  }
  score.flexure_compliance = std::abs(score.flexure_compliance) / square;
  for (const double frequency : compliance_frequencies()) {
    score.compliance.push_back(
        {frequency, std::abs(loop.at(two_pi * frequency).boresight_by_wind) / square});
  }
  const RejectionResponse response = rejection_response(problem, antenna_form);
  score.breaks = break_scores(problem, antenna_form, response);
  score.noise_rms = std::sqrt(response.noise_variance) / problem.gear_ratio;
  score.control_effort = std::sqrt(response.effort_variance);
  const WindAttitudeCoefficient own{"", problem.wind.site.torque_coefficient};
  score.design_wind = wind_score(
      problem, wind_integrals(problem, response, problem.wind.model, problem.wind.mean_speed), own,
      problem.wind.model, problem.wind.mean_speed, response.noise_variance);
  TrackingProblem windy = problem;
  windy.climate.clear();
  score.lyapunov_rms = rejection_lyapunov_rms(windy, antenna_form) / problem.gear_ratio;
  const double disagreement = std::abs(score.lyapunov_rms / score.design_wind.boresight_rms - 1.0);
  if (!(disagreement < largest_disagreement)) {
    throw NumericalFailure(fmt::format(
        "rejection_benchmark: the boresight rms is {:.6g} rad by its spectrum and {:.6g} rad by "
        "Lyapunov equations: no trustworthy result",
        score.design_wind.boresight_rms, score.lyapunov_rms));
  }

  const auto part = [&](const char* name, const std::function<void()>& work) {
    if (!score.left_out.empty() || (options.stop && options.stop())) {
      score.left_out.emplace_back(name);
    } else {
      work();
    }
  };
  part("ladder of winds", [&] { score.winds = ladder(windy, response, options); });
  part("wind speeds of the budgets", [&] {
    score.budget_speeds.resize(options.budgets.size());
    numerics::for_each_index(options.budgets.size(), options.threads, [&](std::size_t i) {
      score.budget_speeds[i] = speed_limit(windy, response, options.budgets[i]);
    });
  });
  part("ensemble", [&] {
    if (!options.members.empty())
      score.ensemble = evaluate_members(windy, goals, antenna_form, options);
  });
  part("best that any controller can do", [&] {
    const double sample_time = antenna_form.sample_time > 0.0 ? antenna_form.sample_time
                               : options.sample_time > 0.0    ? options.sample_time
                                                              : problem.delay / 1.5;
    score.reference =
        reference_of(windy, goals, sample_time, score.control_effort, options.threads);
  });
  return score;
}

}  // namespace boresight::design
