#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/QR>
#include <fmt/format.h>

#include <boresight/identification/steady_friction.hpp>
#include <boresight/plant/error.hpp>

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

}  // namespace

SteadyFrictionFit fit_steady_friction(const std::vector<SteadyFriction>& tests) {
  check(tests);
  double lowest = std::numeric_limits<double>::infinity(), highest = 0.0;
  int moving = 0;
  for (const auto& test : tests) {
    if (test.rate == 0.0) continue;
    ++moving;
    lowest = std::min(lowest, test.rate);
    highest = std::max(highest, test.rate);
  }
  if (moving == 0) {
    throw InvalidInput("fit_steady_friction: expected a test at a rate above 0, found none");
  }
  constexpr int coulomb = 1, bump = 2, viscous = 4;
  const bool at_rest = moving < static_cast<int>(tests.size());
  const bool tells_stribeck_rate = tests.size() > columns;
  const int allowed =
      coulomb | (at_rest || tells_stribeck_rate ? bump : 0) | (moving > 1 ? viscous : 0);
  const double least = lowest / 3.0;
  double rate = least;
  LinearPart best = fit_at(tests, rate, allowed);
  if (tells_stribeck_rate) {
    // A grid in the logarithm, three times about the best of the one before.
    double low = std::log(least), high = std::log(highest);
    constexpr int steps = 60, rounds = 4;
    for (int round = 0; round < rounds; ++round) {
      const double step = (high - low) / steps;
      for (int k = 0; k <= steps; ++k) {
        const double tried = std::exp(low + step * k);
        const LinearPart part = fit_at(tests, tried, allowed);
        if (part.squares < best.squares * (1.0 - 1e-12)) {
          best = part;
          rate = tried;
        }
      }
      low = std::max(std::log(least), std::log(rate) - step);
      high = std::min(std::log(highest), std::log(rate) + step);
    }
  }
  SteadyFrictionFit fit;
  fit.curve.coulomb_torque = best.values[0];
  fit.curve.breakaway_torque = best.values[0] + best.values[1];
  fit.curve.stribeck_rate = rate;
  fit.curve.saturating_torque = 0.0;
  fit.curve.saturating_rate = highest;
  fit.curve.viscous_friction = best.values[2];
  // Where Ts is Tc the Stribeck rate fits nothing.
  const bool fits_rate = tells_stribeck_rate && best.values[1] > 0.0;
  const int freedom = static_cast<int>(tests.size()) - best.free - (fits_rate ? 1 : 0);
  if (freedom > 0) fit.scatter = std::sqrt(best.squares / freedom);
  return fit;
}

}  // namespace boresight::identification
