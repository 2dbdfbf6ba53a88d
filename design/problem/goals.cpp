#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include <boresight/control/controllers/conditional_integral.hpp>
#include <boresight/control/loops/loop_constraints.hpp>
#include <boresight/design/problem/goals.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::design {
namespace {

using control::LoopBreak;
using control::LoopQuantity;

constexpr double least_static_error = 1e-12;  // rad: what a limit of 0 counts as

void expect(bool met, std::string_view goal, std::string_view expected, double found) {
  if (met) return;
  throw InvalidInput(fmt::format("constraints: expected {} {}, found {:g}", goal, expected, found));
}

void expect_positive(const std::optional<double>& limit, std::string_view goal) {
  if (limit) expect(*limit > 0.0 && std::isfinite(*limit), goal, "above 0 and finite", *limit);
}

NormalisedConstraint of_variance(GoalKind kind, double variance,
                                 const std::array<double, control::max_gains>& log_gradient,
                                 double crest, double mean, double limit) {
  NormalisedConstraint goal;
  goal.kind = kind;
  const double spread = crest * std::sqrt(variance);
  goal.ratio = (mean + spread) / limit;
  if (variance > 0.0) {
    for (std::size_t k = 0; k < log_gradient.size(); ++k) {
      goal.log_gradient[k] = 0.5 * log_gradient[k] / variance * spread / (mean + spread);
    }
  }
  return goal;
}

// Of a quantity that must be at least its limit.
NormalisedConstraint at_least(GoalKind kind, LoopBreak loop_break, const LoopQuantity& quantity,
                              double limit) {
  NormalisedConstraint goal;
  goal.kind = kind;
  goal.loop_break = loop_break;
  goal.frequency = quantity.frequency;
  goal.ratio = limit / quantity.value;
  std::ranges::transform(quantity.log_gradient, goal.log_gradient.begin(), std::negate());
  return goal;
}

}  // namespace

bool Constraints::ask_for_margins() const {
  const auto given = [](const std::optional<double>& limit) { return limit.has_value(); };
  return bandwidth.has_value() || std::ranges::any_of(gain_margin, given) ||
         std::ranges::any_of(phase_margin, given);
}

void validate(const Constraints& goals) {
  for (const double peak : goals.sensitivity_peak) {
    expect(peak > 1.0 && std::isfinite(peak), "a sensitivity peak", "above 1 and finite", peak);
  }
  if (goals.standstill) {
    const double peak = goals.standstill->sensitivity_peak;
    expect(peak > 1.0 && std::isfinite(peak), "a sensitivity peak at standstill",
           "above 1 and finite", peak);
    for (const double slope : goals.standstill->friction) {
      expect(slope > 0.0 && std::isfinite(slope), "a friction at standstill", "above 0 and finite",
             slope);
    }
  }
  for (const auto& margin : goals.gain_margin) {
    if (margin) {
      expect(*margin > 1.0 && std::isfinite(*margin), "a gain margin", "above 1 and finite",
             *margin);
    }
  }
  for (const auto& margin : goals.phase_margin) {
    if (margin) {
      expect(*margin > 0.0 && *margin < std::numbers::pi, "a phase margin", "between 0 and pi rad",
             *margin);
    }
  }
  expect_positive(goals.control_effort, "valve_effort");
  expect_positive(goals.bandwidth, "bandwidth");
  expect_positive(goals.gust_demand, "gust_demand");
  expect_positive(goals.gust_torque, "gust_torque");
  expect_positive(goals.crest_factor, "crest_factor");
  if (const auto& limit = goals.static_encoder_error) {
    expect(*limit >= 0.0 && std::isfinite(*limit), "a static_encoder_error",
           "of 0 or more, and finite", *limit);
  }
}

std::string_view to_string(ObjectiveKind kind) {
  static constexpr std::array names{"nominal", "expected", "worst_case", "quantile"};
  return names.at(static_cast<std::size_t>(kind));
}

std::string_view to_string(GoalKind kind) {
  static constexpr std::array<std::string_view, goal_kinds> names{"sensitivity peak",
                                                                  "noise-driven control effort",
                                                                  "gain margin",
                                                                  "phase margin",
                                                                  "bandwidth",
                                                                  "valve demand in gusts",
                                                                  "motor torque in gusts",
                                                                  "static encoder error",
                                                                  "sensitivity peak at standstill"};
  return names.at(static_cast<std::size_t>(kind));
}

std::string describe(const NormalisedConstraint& goal) {
  std::string text(to_string(goal.kind));
  if (goal.loop_break) text += fmt::format(" at {}", control::to_string(*goal.loop_break));
  if (goal.frequency > 0.0) {
    text += fmt::format(", {:.2f} Hz", goal.frequency / two_pi);
  }
  return text;
}

void append_normalised_constraints(const control::LoopEvaluation& evaluation,
                                   const Constraints& goals, const MeanWindLoad& mean,
                                   std::vector<NormalisedConstraint>& ratios) {
  for (std::size_t b = 0; b < control::loop_breaks.size(); ++b) {
    for (const auto& peak : evaluation.peaks[b]) {
      ratios.push_back({GoalKind::sensitivity_peak, control::loop_breaks[b], peak.frequency,
                        peak.magnitude / goals.sensitivity_peak[b], peak.log_gradient});
    }
  }
  ratios.push_back(of_variance(GoalKind::control_effort, evaluation.effort_variance,
                               evaluation.effort_log_gradient, 1.0, 0.0, goals.control_effort));
  if (goals.gust_demand) {
    ratios.push_back(of_variance(GoalKind::gust_demand, evaluation.wind_demand_variance,
                                 evaluation.wind_demand_log_gradient, goals.crest_factor,
                                 mean.demand, *goals.gust_demand));
  }
  if (goals.gust_torque) {
    ratios.push_back(of_variance(GoalKind::gust_torque, evaluation.wind_torque_variance,
                                 evaluation.wind_torque_log_gradient, goals.crest_factor,
                                 mean.torque, *goals.gust_torque));
  }
}

double static_encoder_error(const control::Controller& controller, double demand,
                            double gear_ratio) {
  if (const auto integral = control::conditional_integral(controller)) {
    return integral->width / gear_ratio;
  }
  return std::abs(demand) / control::static_encoder_gain(controller) / gear_ratio;
}

NormalisedConstraint static_error_constraint(const control::Controller& controller, double demand,
                                             double gear_ratio, double limit) {
  NormalisedConstraint goal;
  goal.kind = GoalKind::static_encoder_error;
  goal.ratio =
      static_encoder_error(controller, demand, gear_ratio) / std::max(limit, least_static_error);
  // A width is not searched.
  if (controller.structure.has_conditional_integral()) return goal;
  std::size_t k = 0;
  for (const auto& block : controller.structure.blocks()) {
    const bool in_loop =
        block.path == control::LoopPath::rate || block.path == control::LoopPath::position;
    if (in_loop && block.kind == control::BlockKind::gain) goal.log_gradient.at(k) = -1.0;
    k += block.gains.size();
  }
  return goal;
}

double found_static_error(const NormalisedConstraint& constraint, double limit) {
  return constraint.ratio * std::max(limit, least_static_error);
}

void append_standstill_peaks(const control::LoopEvaluation& evaluation,
                             const Standstill& standstill,
                             std::vector<NormalisedConstraint>& ratios) {
  constexpr LoopBreak cut = LoopBreak::valve_command;
  for (const auto& peak : evaluation.peaks[static_cast<std::size_t>(cut)]) {
    ratios.push_back({GoalKind::standstill_peak, cut, peak.frequency,
                      peak.magnitude / standstill.sensitivity_peak, peak.log_gradient});
  }
}

void append_margin_ratios(const control::LoopChannels& channels, double delay,
                          const control::Controller& controller, const Constraints& goals,
                          std::vector<NormalisedConstraint>& ratios) {
  for (std::size_t b = 0; b < control::loop_breaks.size(); ++b) {
    const LoopBreak cut = control::loop_breaks[b];
    if (!control::has_break(controller, cut)) continue;
    if (const auto& limit = goals.gain_margin[b]) {
      for (const auto& margin : control::smallest_gain_margins(channels, delay, controller, cut)) {
        ratios.push_back(at_least(GoalKind::gain_margin, cut, margin, *limit));
      }
    }
    if (const auto& limit = goals.phase_margin[b]) {
      for (const auto& margin : control::smallest_phase_margins(channels, delay, controller, cut)) {
        ratios.push_back(at_least(GoalKind::phase_margin, cut, margin, *limit));
      }
    }
  }
  if (goals.bandwidth) {
    const double lowest = channels.response.frequency[0];
    const auto bandwidth = control::position_bandwidth(channels, delay, controller)
                               .value_or(LoopQuantity{lowest, lowest, {}});
    ratios.push_back(
        at_least(GoalKind::bandwidth, LoopBreak::position_loop, bandwidth, *goals.bandwidth));
  }
}

}  // namespace boresight::design
