#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <functional>
#include <limits>
#include <optional>

#include <Eigen/LU>
#include <fmt/format.h>

#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/hermitian_eigen.hpp>
#include <boresight/plant/antenna/motors_held_modes.hpp>
#include <boresight/plant/antenna/structure_dynamics.hpp>

namespace boresight::plant {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr std::size_t max_modes = 8;  // the number of starts is 2 to the power of it

[[noreturn]] void refuse(const std::string& message) {
  throw InvalidInput("expected " + message);
}

// What the modes' squared frequencies with the bull gear held, the unknowns, must satisfy.
struct Conditions {
  VectorXd roots;      // s_0 to s_N
  VectorXd fractions;  // r_i

  // Logarithms of left over right side.
  VectorXd residuals(const VectorXd& x) const {
    VectorXd sums = fractions.array().log() + 2.0 * x.array().log();
    for (Index i = 0; i < x.size(); ++i) {
      for (Index l = 0; l < x.size(); ++l)
        sums[i] += l == i ? 0.0 : std::log(std::abs(x[l] - x[i]));
      sums[i] -= (roots.array() - x[i]).abs().log().sum();
    }
    return sums;
  }

  Eigen::MatrixXd slopes(const VectorXd& x) const {
    Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(x.size(), x.size());
    for (Index i = 0; i < x.size(); ++i) {
      slopes(i, i) = 2.0 / x[i] + (roots.array() - x[i]).inverse().sum();
      for (Index l = 0; l < x.size(); ++l) {
        if (l == i) continue;
        slopes(i, l) = 1.0 / (x[l] - x[i]);
        slopes(i, i) -= slopes(i, l);
      }
    }
    return slopes;
  }

  // As much of a step as keeps every unknown between its two roots, nine tenths of the way at most.
  double allowed(const VectorXd& x, const VectorXd& step) const {
    double fraction = 1.0;
    for (Index i = 0; i < x.size(); ++i) {
      const double end = step[i] > 0.0 ? roots[i + 1] : roots[i];
      if (step[i] != 0.0) fraction = std::min(fraction, 0.9 * (end - x[i]) / step[i]);
    }
    return fraction;
  }
};

std::optional<VectorXd> newton(const Conditions& conditions, VectorXd x) {
  constexpr int max_steps = 60;
  constexpr double exact = 1e-12, rounding = 1e-10, shortest = 1e-4;
  VectorXd residuals = conditions.residuals(x);
  for (int step = 0; step < max_steps; ++step) {
    if (residuals.cwiseAbs().maxCoeff() < exact) return x;
    const VectorXd whole = -conditions.slopes(x).fullPivLu().solve(residuals);
    if (!whole.allFinite()) return std::nullopt;
    double fraction = conditions.allowed(x, whole);
    bool closer = false;
    for (; !closer && fraction > shortest; fraction *= 0.5) {
      const VectorXd next = x + fraction * whole;
      const VectorXd there = conditions.residuals(next);
      closer = there.norm() < (1.0 - 1e-4 * fraction) * residuals.norm();
      if (!closer) continue;
      x = next;
      residuals = there;
    }
    if (!closer) break;
  }
  if (residuals.cwiseAbs().maxCoeff() < rounding) return x;
  return std::nullopt;
}

// All solutions that are found, the largest product (softest gear spring) first.
std::vector<VectorXd> solutions(const Conditions& conditions) {
  constexpr std::array<double, 2> from_the_end{0.1, 0.001};
  constexpr double same = 1e-6;
  const VectorXd& roots = conditions.roots;
  const Index modes = conditions.fractions.size();
  std::vector<VectorXd> found;
  for (const double near : from_the_end) {
    for (unsigned ends = 0; ends < (1U << static_cast<unsigned>(modes)); ++ends) {
      VectorXd start(modes);
      for (Index i = 0; i < modes; ++i) {
        const bool lower = ((ends >> static_cast<unsigned>(i)) & 1U) != 0U;
        start[i] = roots[i] + (lower ? near : 1.0 - near) * (roots[i + 1] - roots[i]);
      }
      const auto x = newton(conditions, start);
      if (!x) continue;
      const bool known = std::ranges::any_of(found, [&](const VectorXd& other) {
        return ((*x - other).array() / other.array()).abs().maxCoeff() < same;
      });
      if (!known) found.push_back(*x);
    }
  }
  std::ranges::sort(found, std::greater{}, [](const VectorXd& x) { return x.array().log().sum(); });
  return found;
}

Conditions conditions_of(const StructureSpecification& stated) {
  const auto modes = static_cast<Index>(stated.modes.size());
  Conditions conditions{VectorXd(modes + 1), VectorXd(modes)};
  const auto root = [](double frequency) { return std::pow(two_pi * frequency, 2); };
  conditions.roots[0] = root(stated.locked_rotor_frequency);
  double rest = 1.0;
  for (Index i = 0; i < modes; ++i) {
    const auto& mode = stated.modes[static_cast<std::size_t>(i)];
    conditions.roots[i + 1] = root(mode.frequency);
    conditions.fractions[i] = mode.inertia_fraction;
    rest -= mode.inertia_fraction;
  }
  conditions.fractions /= rest;
  return conditions;
}

void check(const StructureSpecification& stated, const char* fractions) {
  double below = 0.0;
  double sum = 0.0;
  const auto rising = [&](double frequency) {
    if (!(frequency > below) || !std::isfinite(frequency)) {
      refuse(
          fmt::format("frequencies with the motors held that rise from locked_rotor_frequency, "
                      "found {:.6g} Hz behind {:.6g} Hz",
                      frequency, below));
    }
    below = frequency;
  };
  rising(stated.locked_rotor_frequency);
  for (const auto& mode : stated.modes) {
    rising(mode.frequency);
    if (!(mode.inertia_fraction > 0.0)) {
      refuse(fmt::format("positive {}, found {:.6g}", fractions, mode.inertia_fraction));
    }
    sum += mode.inertia_fraction;
  }
  if (!(sum < 1.0)) {
    refuse(fmt::format("{} that sum to less than 1, found {:.6g}", fractions, sum));
  }
}

// What of the fractions would have an antenna: of one mode alone, else of all.
[[noreturn]] void refuse_heavy(const StructureSpecification& stated) {
  constexpr int steps = 20;
  const auto exists = [&](const StructureSpecification& lighter) {
    return !solutions(conditions_of(lighter)).empty();
  };
  for (int step = steps - 1; step > 0; --step) {
    const double fraction = static_cast<double>(step) / steps;
    for (std::size_t i = 0; i < stated.modes.size(); ++i) {
      StructureSpecification lighter = stated;
      lighter.modes[i].inertia_fraction *= fraction;
      if (!exists(lighter)) continue;
      refuse(fmt::format(
          "inertia fractions of which an antenna has these frequencies with the motors held, found "
          "none: the mode of {:.6g} Hz would need an inertia_fraction of some {:.2g} instead "
          "of {:.6g}, or more distance from the frequencies beside it",
          stated.modes[i].frequency, lighter.modes[i].inertia_fraction,
          stated.modes[i].inertia_fraction));
    }
  }
  for (int step = steps - 1; step > 0; --step) {
    const double fraction = static_cast<double>(step) / steps;
    StructureSpecification lighter = stated;
    for (auto& mode : lighter.modes) mode.inertia_fraction *= fraction;
    if (!exists(lighter)) continue;
    refuse(fmt::format(
        "inertia fractions of which an antenna has these frequencies with the motors held, found "
        "none: "
        "with all of them {:.2g} times as large, and the rest at the bull gear, there is one",
        fraction));
  }
  refuse(
      "frequencies that an antenna of these inertia fractions has with the motors held, found "
      "none");
}

// G of an antenna of inertia 1, over the square of the frequency instead of the circular one.
struct GearResponse {
  Eigen::ArrayXd frequencies;  // f_j, rising
  Eigen::ArrayXd weights;      // e_j f_j^4/(sum e_l f_l^2)^2

  // From a pole to all of them.
  Eigen::ArrayXd distances(Index pole) const {
    return (frequencies - frequencies[pole]) * (frequencies + frequencies[pole]);
  }

  // With the bull gear held, between this pole and the one below: frequency and inertia.
  StructureSpecification::Mode zero_below(Index upper) const {
    const double half = 0.5 * distances(upper - 1)[upper];
    const auto response = [&](const Eigen::ArrayXd& poles, double x) {
      return (weights / (poles - x)).sum();
    };
    const bool nearer_lower = response(distances(upper - 1), half) > 0.0;
    const Index pole = nearer_lower ? upper - 1 : upper;
    const Eigen::ArrayXd poles = distances(pole);
    double near = 0.0;
    double far = nearer_lower ? half : -half;
    double middle = 0.5 * far;
    while (middle != near && middle != far) {
      if ((response(poles, middle) > 0.0) == nearer_lower) {
        far = middle;
      } else {
        near = middle;
      }
      middle = 0.5 * (near + far);
    }
    const double x = frequencies[pole] * frequencies[pole] + far;
    // Divided twice, as the square of a tiny distance would be 0.
    const double slope = (weights / (poles - far) / (poles - far)).sum();
    StructureSpecification::Mode mode;
    mode.frequency = std::sqrt(x);
    mode.inertia_fraction = 1.0 / (x * x * slope);
    return mode;
  }
};

GearResponse gear_response_of(const StructureSpecification& stated) {
  const auto modes = static_cast<Index>(stated.modes.size());
  GearResponse response{Eigen::ArrayXd(modes + 1), Eigen::ArrayXd(modes + 1)};
  response.frequencies[0] = stated.locked_rotor_frequency;
  response.weights[0] = 1.0;
  for (Index i = 0; i < modes; ++i) {
    const auto& mode = stated.modes[static_cast<std::size_t>(i)];
    response.frequencies[i + 1] = mode.frequency;
    response.weights[i + 1] = mode.inertia_fraction;
    response.weights[0] -= mode.inertia_fraction;
  }
  const Eigen::ArrayXd squares = response.frequencies.square();
  const double spring = (response.weights * squares).sum();
  response.weights *= (squares / spring).square();
  return response;
}

}  // namespace

std::vector<MotorsHeldMode> motors_held_modes(const Structure& structure) {
  if (!(structure.gear_stiffness > 0.0)) {
    throw InvalidInput(
        fmt::format("motors_held_modes: expected a positive gear stiffness, found {:g}",
                    structure.gear_stiffness));
  }
  // In the coordinates of the free antenna's modes, of which the first is the turn of all of it.
  const VibrationModes free = to_vibration_modes(structure);
  const VectorXd gear = free.force_shape.col(0);
  Eigen::MatrixXd stiffness = structure.gear_stiffness * gear * gear.transpose();
  stiffness.diagonal() += free.frequency.cwiseAbs2();
  const auto eigen = numerics::hermitian_eigen(stiffness.cast<std::complex<double>>());
  const VectorXd fractions = eigen.vectors.row(0).cwiseAbs2();
  std::vector<MotorsHeldMode> held;
  for (Index i = 0; i < fractions.size(); ++i) {
    const double turned =
        std::abs((gear.cast<std::complex<double>>().transpose() * eigen.vectors.col(i)).value());
    // Positive but for rounding.
    const double squared = std::max(eigen.values[i], std::numeric_limits<double>::min());
    held.push_back({std::sqrt(squared) / two_pi, fractions[i],
                    structure.gear_stiffness * turned * turned / squared});
  }
  return held;
}

std::vector<StructureSpecification> hold_bull_gear_of(const StructureSpecification& motors_held) {
  if (motors_held.modes.size() > max_modes) {
    refuse(fmt::format("at most {} modes by their frequencies with the motors held, found {}",
                       max_modes, motors_held.modes.size()));
  }
  check(motors_held, "inertia fractions");
  if (motors_held.modes.empty()) return {motors_held};
  const auto found = solutions(conditions_of(motors_held));
  if (found.empty()) refuse_heavy(motors_held);
  std::vector<StructureSpecification> antennas;
  for (const VectorXd& x : found) {
    antennas.push_back(motors_held);
    for (std::size_t i = 0; i < motors_held.modes.size(); ++i) {
      antennas.back().modes[i].frequency = std::sqrt(x[static_cast<Index>(i)]) / two_pi;
    }
  }
  return antennas;
}

StructureSpecification antenna_of_effective_fractions(const StructureSpecification& motors_held) {
  check(motors_held, "effective inertia fractions");
  const GearResponse response = gear_response_of(motors_held);
  StructureSpecification antenna = motors_held;
  double below = antenna.locked_rotor_frequency;
  double rest = 1.0;
  for (std::size_t i = 0; i < antenna.modes.size(); ++i) {
    auto& mode = antenna.modes[i];
    const auto held = response.zero_below(static_cast<Index>(i) + 1);
    mode.frequency = held.frequency;
    mode.inertia_fraction = held.inertia_fraction;
    rest -= mode.inertia_fraction;
    const bool sound = mode.frequency > below && mode.inertia_fraction > 0.0 && rest > 0.0;
    if (!sound) {
      refuse(fmt::format(
          "effective inertia fractions of which an antenna has these frequencies with the motors "
          "held, found none but for rounding: {:.3g} at {:.6g} Hz",
          motors_held.modes[i].inertia_fraction, motors_held.modes[i].frequency));
    }
    below = mode.frequency;
  }
  return antenna;
}

}  // namespace boresight::plant
