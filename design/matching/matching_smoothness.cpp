#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <boresight/design/matching/matching_smoothness.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::design {
namespace {

std::string name_of(const ActiveConstraint& goal) {
  return fmt::format("{}{}", describe(goal.goal),
                     goal.member.empty() ? "" : fmt::format(" on {}", goal.member));
}

bool same(const ActiveConstraint& one, const ActiveConstraint& other) {
  constexpr double apart = 1.15;
  const double x = one.goal.frequency, y = other.goal.frequency;
  return one.goal.kind == other.goal.kind && one.goal.loop_break == other.goal.loop_break &&
         one.member == other.member && x <= apart * y && y <= apart * x;
}

// A goal of the first that the second is not held by.
const ActiveConstraint* missing(const std::vector<ActiveConstraint>& from,
                                const std::vector<ActiveConstraint>& in) {
  for (const auto& goal : from) {
    if (std::ranges::none_of(in, [&](const auto& other) { return same(goal, other); })) {
      return &goal;
    }
  }
  return nullptr;
}

// What changes between two controllers; empty: nothing.
std::string change_between(const MatchedController& one, const MatchedController& other) {
  const ActiveConstraint* gone = missing(one.active_constraints, other.active_constraints);
  const ActiveConstraint* come = missing(other.active_constraints, one.active_constraints);
  if (gone != nullptr && come != nullptr) {
    return fmt::format("from {} to {}", name_of(*gone), name_of(*come));
  }
  if (gone != nullptr) return fmt::format("{} no longer holds", name_of(*gone));
  if (come != nullptr) return fmt::format("{} holds from here", name_of(*come));
  if (one.gains_at_bound != other.gains_at_bound) return "a gain reaches or leaves its bound";
  constexpr double step = 1.5;
  for (std::size_t k = 0; k < one.controller.gains.size(); ++k) {
    const double ratio = one.controller.gains[k] / other.controller.gains[k];
    if (ratio > step || ratio < 1.0 / step) {
      return fmt::format("another family: {} changes by a factor of {:.2g}",
                         control::gain_descriptions(one.controller.structure)[k].name, 1.0 / ratio);
    }
  }
  return {};
}

}  // namespace

CurveSmoothness smoothness(const MatchingCurve& curve, const std::vector<std::size_t>& points) {
  for (const std::size_t i : points) {
    if (i >= curve.controllers.size()) {
      throw InvalidInput(fmt::format("smoothness: expected points below {}, found {}",
                                     curve.controllers.size(), i));
    }
  }
  CurveSmoothness result;
  std::vector<char> kinked(points.size(), 0);
  std::vector<double> cost(points.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const MatchedController& controller = curve.controllers[points[i]];
    if (controller.status == TuningStatus::optimal) cost[i] = std::log(controller.soft_rms);
    if (i + 1 == points.size()) break;
    const MatchedController& next = curve.controllers[points[i + 1]];
    if (controller.status != TuningStatus::optimal || next.status != TuningStatus::optimal)
      continue;
    std::string change = change_between(controller, next);
    if (change.empty()) continue;
    kinked[i] = 1;
    result.kinks.push_back({i, std::move(change)});
  }
  for (std::size_t i = 0; i + 3 < points.size(); ++i) {
    const double third = cost[i + 3] - 3.0 * cost[i + 2] + 3.0 * cost[i + 1] - cost[i];
    result.third_differences.push_back(third);
    if (!std::isfinite(third)) continue;
    if (kinked[i] != 0 || kinked[i + 1] != 0 || kinked[i + 2] != 0) {
      result.largest_at_kinks = std::max(result.largest_at_kinks, std::abs(third));
    } else {
      ++result.even_stretches;
      result.largest_even = std::max(result.largest_even, std::abs(third));
    }
  }
  return result;
}

}  // namespace boresight::design
