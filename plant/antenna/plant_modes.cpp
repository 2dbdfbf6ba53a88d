#include <cmath>
#include <map>

#include <fmt/format.h>

#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/antenna/antenna_plant.hpp>

namespace boresight::plant {
namespace {

struct Part {
  std::string description;
  std::vector<Eigen::Index> states;
};

constexpr const char* oil_part = "motors between oil and gear springs";
constexpr const char* gear_part = "gearbox: bull gear on the gear spring";
constexpr const char* hydraulic_description =
    "hydraulic: antenna on oil and gear springs in series";

std::vector<Part> parts_of(const AntennaPlant& plant) {
  // State order of to_state_space.
  std::vector<Part> parts{
      {"valve", {0, 1}}, {oil_part, {2, 3, 4}}, {gear_part, {5, 6}}, {"tachometer lag", {7}}};
  Eigen::Index state = 8;
  for (std::size_t i = 0; i < plant.structure.modes.size(); ++i, state += 2) {
    const auto& mode = plant.structure.modes[i];
    const double locked = std::sqrt(mode.stiffness / mode.inertia) / two_pi;
    parts.push_back(
        {fmt::format("structure: mode {} ({:.3g} Hz with the bull gear locked)", i + 1, locked),
         {state, state + 1}});
  }
  return parts;
}

// Valve and tachometer stand in series with the rest: they move no oil but by rounding.
bool moves_oil(const PlantMode& mode) {
  constexpr double rounding = 1e-9;
  return mode.oil_participation >= rounding;
}

// Which of the modes, in order of frequency, hydraulic_mode is: one, both poles of an overdamped
// one, the lower first, or none.
std::vector<std::size_t> hydraulic_poles(const std::vector<PlantMode>& modes) {
  std::vector<std::size_t> real, swinging;
  for (std::size_t i = 0; i < modes.size(); ++i) {
    if (modes[i].frequency == 0.0 || !moves_oil(modes[i])) continue;
    (modes[i].pole.imag() == 0.0 ? real : swinging).push_back(i);
  }
  if (real.size() >= 2 &&
      (swinging.empty() || std::sqrt(modes[real[0]].frequency * modes[real[1]].frequency) <
                               modes[swinging.front()].frequency)) {
    return {real[0], real[1]};
  }
  if (swinging.empty()) return {};
  return {swinging.front()};
}

void number_the_alike(std::vector<PlantMode>& modes) {
  std::map<std::string, int> alike, seen;
  for (const auto& mode : modes) ++alike[mode.description];
  for (auto& mode : modes) {
    const int count = alike[mode.description];
    if (count == 1) continue;
    const int number = ++seen[mode.description];
    mode.description += fmt::format(", {} of {}", number, count);
  }
}

}  // namespace

std::vector<PlantMode> plant_modes(const AntennaPlant& plant) {
  const StateSpace system = to_state_space(plant);
  const numerics::EigenDecomposition eigen = numerics::eigen_decomposition(system.a);
  const std::vector<Part> parts = parts_of(plant);
  const double scale = system.a.cwiseAbs().maxCoeff();
  // State order of to_state_space.
  constexpr Eigen::Index torque = 2, motor_rate = 3, motor = 4, bull = 5, bull_rate = 6;
  std::vector<PlantMode> modes;
  std::vector<double> gear_participation;
  for (Eigen::Index i = 0; i < eigen.values.size(); ++i) {
    const std::complex<double> pole = eigen.values[i];
    if (pole.imag() < 0.0) continue;
    const double magnitude = std::abs(pole);
    PlantMode mode;
    gear_participation.push_back(0.0);
    mode.pole = pole;
    mode.frequency = magnitude / two_pi;
    if (magnitude < 1e-12 * scale) {
      mode.description = "free rotation of the antenna";
      mode.participation = 1.0;
      mode.frequency = 0.0;
      mode.pole = 0.0;
      modes.push_back(std::move(mode));
      continue;
    }
    mode.damping_ratio = -pole.real() / magnitude;
    const Eigen::VectorXd weight =
        eigen.left.col(i).cwiseAbs().cwiseProduct(eigen.right.col(i).cwiseAbs());
    for (const auto& part : parts) {
      double fraction = 0.0;
      for (const Eigen::Index state : part.states) fraction += weight[state];
      fraction /= weight.sum();
      if (part.description == oil_part) mode.oil_participation = fraction;
      if (part.description == gear_part) gear_participation.back() = fraction;
      if (fraction > mode.participation) {
        mode.participation = fraction;
        mode.description = part.description;
      }
    }
    if (moves_oil(mode)) {
      // l^H (dA/d ln K) r: K stands in the torque's row, at the motors' rate and at the valve's
      // flow, which the poles do not depend on.
      const std::complex<double> moved = -plant.drive.oil_stiffness *
                                         std::conj(eigen.left(torque, i)) *
                                         eigen.right(motor_rate, i);
      mode.oil_fraction = 2.0 * (moved / pole).real();
      const std::complex<double> by_gear =
          plant.structure.gear_stiffness *
          (std::conj(eigen.left(motor_rate, i)) / plant.drive.motor_inertia -
           std::conj(eigen.left(bull_rate, i)) / plant.structure.bull_gear_inertia) *
          (eigen.right(bull, i) - eigen.right(motor, i));
      mode.gear_fraction = 2.0 * (by_gear / pole).real();
    }
    modes.push_back(std::move(mode));
  }
  for (const std::size_t i : hydraulic_poles(modes)) {
    PlantMode& mode = modes[i];
    const double fraction = mode.oil_participation + gear_participation[i];
    if (fraction < mode.participation) {
      mode.description += ", the hydraulic mode";
      continue;
    }
    mode.description = hydraulic_description;
    mode.participation = fraction;
  }
  number_the_alike(modes);
  return modes;
}

PlantMode hydraulic_mode(const std::vector<PlantMode>& modes) {
  const auto poles = hydraulic_poles(modes);
  if (poles.empty()) {
    throw NumericalFailure("hydraulic_mode: no mode of the plant moves motors and oil");
  }
  if (poles.size() == 1) return modes[poles.front()];
  const PlantMode& slow = modes[poles[0]];
  const PlantMode& fast = modes[poles[1]];
  const double first = -slow.pole.real(), second = -fast.pole.real();
  PlantMode both = slow.oil_participation > fast.oil_participation ? slow : fast;
  both.frequency = std::sqrt(first * second) / two_pi;
  both.damping_ratio = (first + second) / (2.0 * std::sqrt(first * second));
  both.oil_fraction = 0.5 * (slow.oil_fraction + fast.oil_fraction);
  both.gear_fraction = 0.5 * (slow.gear_fraction + fast.gear_fraction);
  both.description = fmt::format("{}, overdamped", hydraulic_description);
  return both;
}

PlantMode mode_of_oil(const std::vector<PlantMode>& modes) {
  PlantMode maximum = hydraulic_mode(modes);
  for (const auto& mode : modes) {
    if (mode.pole.imag() != 0.0 && mode.oil_fraction > maximum.oil_fraction) maximum = mode;
  }
  return maximum;
}

}  // namespace boresight::plant
