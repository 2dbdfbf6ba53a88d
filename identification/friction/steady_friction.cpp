#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include <Eigen/QR>
#include <fmt/format.h>

#include <boresight/identification/friction/steady_friction.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::identification {
namespace {

constexpr int columns = 3;  // Tc, Ts - Tc, Bv

struct LinearPart {
  Eigen::Vector3d values = Eigen::Vector3d::Zero();
  double squares = std::numeric_limits<double>::infinity();
  int free = 0;  // values off their bounds
};

// At least 0 all three, and 0 those that are not `allowed`: of all sets of values off their bounds
// the one of the least squares.
LinearPart fit_at(const std::vector<SteadyFriction>& tests, double stribeck_rate, int allowed) {
  const auto rows = static_cast<Eigen::Index>(tests.size());
  Eigen::MatrixXd full(rows, columns);
  Eigen::VectorXd torque(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const auto& test = tests[static_cast<std::size_t>(i)];
    const double turns = test.rate / stribeck_rate;
    full.row(i) << 1.0, std::exp(-turns * turns), test.rate;
    torque[i] = test.torque;
  }
  LinearPart best;
  for (int set = 0; set < 1 << columns; ++set) {
    if ((set & ~allowed) != 0) continue;
    std::vector<int> chosen;
    for (int c = 0; c < columns; ++c) {
      if ((set >> c & 1) != 0) chosen.push_back(c);
    }
    LinearPart part;
    part.free = static_cast<int>(chosen.size());
    if (!chosen.empty()) {
      const Eigen::VectorXd found = full(Eigen::all, chosen).colPivHouseholderQr().solve(torque);
      if (!(found.minCoeff() >= 0.0)) continue;
      for (std::size_t k = 0; k < chosen.size(); ++k) {
        part.values[chosen[k]] = found[static_cast<Eigen::Index>(k)];
      }
    }
    part.squares = (full * part.values - torque).squaredNorm();
    // Rounding must not buy a further value.
    if (part.squares < best.squares * (1.0 - 1e-9) - 1e-24 * torque.squaredNorm()) best = part;
  }
  return best;
}

void check(const std::vector<SteadyFriction>& tests) {
  for (std::size_t i = 0; i < tests.size(); ++i) {
    if (tests[i].rate < 0.0 || tests[i].torque < 0.0 || !std::isfinite(tests[i].rate) ||
        !std::isfinite(tests[i].torque)) {
      throw InvalidInput(fmt::format(
          "fit_steady_friction: expected rates and torques of at least 0, found {:g} and {:g}",
          tests[i].rate, tests[i].torque));
    }
    for (std::size_t j = 0; j < i; ++j) {
      if (tests[i].rate == tests[j].rate) {
        throw InvalidInput(
            fmt::format("fit_steady_friction: expected one test a rate, found two at {:g} rad/s",
                        tests[i].rate));
      }
    }
  }
}

constexpr int coulomb = 1;
constexpr int bump = 2;
constexpr int viscous = 4;

// Which numbers the tests are asked for, and between what the Stribeck rate is searched.
struct Question {
  int allowed = coulomb;
  bool stribeck_rate = false;
  double minimum = 0.0;
  double highest = 0.0;
};

Question question_of(const std::vector<SteadyFriction>& tests) {
  check(tests);
  Question asked;
  double lowest = std::numeric_limits<double>::infinity();
  int moving = 0;
  for (const auto& test : tests) {
    if (test.rate == 0.0) continue;
    ++moving;
    lowest = std::min(lowest, test.rate);
    asked.highest = std::max(asked.highest, test.rate);
  }
  if (moving == 0) {
    throw InvalidInput("fit_steady_friction: expected a test at a rate above 0, found none");
  }
  const bool at_rest = moving < static_cast<int>(tests.size());
  asked.stribeck_rate = tests.size() > columns;
  if (at_rest || asked.stribeck_rate) asked.allowed |= bump;
  if (moving > 1) asked.allowed |= viscous;
  asked.minimum = lowest / 3.0;
  return asked;
}

struct Answer {
  LinearPart part;
  double rate = 0.0;
};

Answer answer_of(const std::vector<SteadyFriction>& tests, const Question& asked) {
  Answer best{fit_at(tests, asked.minimum, asked.allowed), asked.minimum};
  if (!asked.stribeck_rate) return best;
  // A grid in the logarithm, three times about the best of the one before.
  double low = std::log(asked.minimum), high = std::log(asked.highest);
  constexpr int steps = 60, rounds = 4;
  for (int round = 0; round < rounds; ++round) {
    const double step = (high - low) / steps;
    for (int k = 0; k <= steps; ++k) {
      const double tried = std::exp(low + step * k);
      const LinearPart part = fit_at(tests, tried, asked.allowed);
      if (part.squares < best.part.squares * (1.0 - 1e-12)) best = {part, tried};
    }
    low = std::max(std::log(asked.minimum), std::log(best.rate) - step);
    high = std::min(std::log(asked.highest), std::log(best.rate) + step);
  }
  return best;
}

constexpr std::size_t curve_numbers = 4;  // Tc, Ts, Bv, ws
using Intervals = std::array<FrictionInterval, curve_numbers>;

Intervals points_of(const Answer& answer, const Question& asked) {
  const auto point = [](double value) {
    return FrictionInterval{value, value, false, false, std::nullopt};
  };
  FrictionInterval rate = point(answer.rate);
  if (answer.part.values[1] > 0.0) {
    constexpr double rounding = 1e-9;
    rate.min_open = answer.rate <= asked.minimum * (1.0 + rounding);
    rate.largest_open = answer.rate >= asked.highest * (1.0 - rounding);
  } else {
    rate = {asked.minimum, asked.highest, true, true, std::nullopt};
  }
  return {point(answer.part.values[0]), point(answer.part.values[0] + answer.part.values[1]),
          point(answer.part.values[2]), rate};
}

void widen(FrictionInterval& interval, const FrictionInterval& other) {
  interval.minimum = std::min(interval.minimum, other.minimum);
  interval.largest = std::max(interval.largest, other.largest);
  interval.min_open |= other.min_open;
  interval.largest_open |= other.largest_open;
}

}  // namespace

SteadyFrictionFit fit_steady_friction(const std::vector<SteadyFriction>& tests) {
  const Question asked = question_of(tests);
  const auto [best, rate] = answer_of(tests, asked);
  SteadyFrictionFit fit;
  fit.curve.coulomb_torque = best.values[0];
  fit.curve.breakaway_torque = best.values[0] + best.values[1];
  fit.curve.stribeck_rate = rate;
  fit.curve.saturating_torque = 0.0;
  fit.curve.saturating_rate = asked.highest;
  fit.curve.viscous_friction = best.values[2];
  // Where Ts is Tc the Stribeck rate fits nothing.
  const bool fits_rate = asked.stribeck_rate && best.values[1] > 0.0;
  const int freedom = static_cast<int>(tests.size()) - best.free - (fits_rate ? 1 : 0);
  if (freedom > 0) fit.scatter = std::sqrt(best.squares / freedom);
  return fit;
}

int steady_friction_freedom(const std::vector<SteadyFriction>& tests) {
  const Question asked = question_of(tests);
  return static_cast<int>(tests.size()) - std::popcount(static_cast<unsigned>(asked.allowed)) -
         (asked.stribeck_rate ? 1 : 0);
}

SteadyFrictionIntervals steady_friction_intervals(const std::vector<SteadyFriction>& tests) {
  const Question asked = question_of(tests);
  const Answer as_seen = answer_of(tests, asked);
  const Intervals points = points_of(as_seen, asked);
  Intervals whole = points;
  bool falls = as_seen.part.values[1] > 0.0;
  std::array<double, curve_numbers> widest{};
  for (std::size_t k = 0; k < curve_numbers; ++k) widest[k] = points[k].largest - points[k].minimum;
  for (std::size_t i = 0; i < tests.size(); ++i) {
    const double leeway = tests[i].leeway;
    if (!(leeway >= 0.0) || !std::isfinite(leeway)) {
      throw InvalidInput(fmt::format(
          "steady_friction_intervals: expected leeways of at least 0, found {:g}", leeway));
    }
    if (leeway == 0.0) continue;
    Intervals by_this = points;
    for (const double side : {-1.0, 1.0}) {
      auto moved = tests;
      moved[i].torque = std::max(0.0, tests[i].torque + side * leeway);
      const Answer answer = answer_of(moved, asked);
      falls |= answer.part.values[1] > 0.0;
      const Intervals refit = points_of(answer, asked);
      for (std::size_t k = 0; k < curve_numbers; ++k) widen(by_this[k], refit[k]);
    }
    for (std::size_t k = 0; k < curve_numbers; ++k) {
      widen(whole[k], by_this[k]);
      const double width = by_this[k].largest - by_this[k].minimum;
      if (width > widest[k]) {
        widest[k] = width;
        whole[k].moved_most_by = i;
      }
    }
  }
  SteadyFrictionIntervals found{whole[0], whole[1], whole[2], std::nullopt};
  if (asked.stribeck_rate && falls) found.stribeck_rate = whole[3];
  return found;
}

}  // namespace boresight::identification
