#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include <boresight/plant/antenna_plant.hpp>
#include <boresight/plant/eigenvalues.hpp>
#include <boresight/plant/error.hpp>

namespace boresight::plant {
namespace {

struct Part {
  std::string description;
  std::vector<Eigen::Index> states;
};

constexpr const char* hydraulic_description = "hydraulic: motors on the oil spring";

std::vector<Part> parts_of(const AntennaPlant& plant) {
  // State order of to_state_space.
  std::vector<Part> parts{{"valve", {0, 1}},
                          {hydraulic_description, {2, 3, 4}},
                          {"gearbox: bull gear on the gear spring", {5, 6}},
                          {"tachometer lag", {7}}};
  Eigen::Index state = 8;
  for (std::size_t i = 0; i < plant.structure.modes.size(); ++i, state += 2) {
    const auto& mode = plant.structure.modes[i];
    const double locked = std::sqrt(mode.stiffness / mode.inertia) / (2.0 * std::numbers::pi);
    parts.push_back(
        {fmt::format("structure: mode {} ({:.3g} Hz with the bull gear locked)", i + 1, locked),
         {state, state + 1}});
  }
  return parts;
}

}  // namespace

std::vector<PlantMode> plant_modes(const AntennaPlant& plant) {
  const StateSpace system = to_state_space(plant);
  const EigenDecomposition eigen = eigen_decomposition(system.a);
  const std::vector<Part> parts = parts_of(plant);
  const double scale = system.a.cwiseAbs().maxCoeff();
  std::vector<PlantMode> modes;
  for (Eigen::Index i = 0; i < eigen.values.size(); ++i) {
    const std::complex<double> pole = eigen.values[i];
    if (pole.imag() < 0.0) continue;
    const double magnitude = std::abs(pole);
    PlantMode mode;
    mode.pole = pole;
    mode.frequency = magnitude / (2.0 * std::numbers::pi);
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
      double share = 0.0;
      for (const Eigen::Index state : part.states) share += weight[state];
      share /= weight.sum();
      if (part.description == hydraulic_description) mode.oil_participation = share;
      if (share > mode.participation) {
        mode.participation = share;
        mode.description = part.description;
      }
    }
    modes.push_back(std::move(mode));
  }
  return modes;
}

PlantMode hydraulic_mode(const std::vector<PlantMode>& modes) {
  // Valve and tachometer stand in series with the rest: they move no oil but by rounding.
  constexpr double rounding = 1e-9;
  std::vector<PlantMode> real, swinging;
  for (const auto& mode : modes) {
    if (mode.frequency == 0.0 || mode.oil_participation < rounding) continue;
    (mode.pole.imag() == 0.0 ? real : swinging).push_back(mode);
  }
  if (real.size() >= 2) {
    std::ranges::stable_sort(real, {}, &PlantMode::frequency);
    const double first = -real[0].pole.real(), second = -real[1].pole.real();
    PlantMode both = real[0].oil_participation > real[1].oil_participation ? real[0] : real[1];
    both.frequency = std::sqrt(first * second) / (2.0 * std::numbers::pi);
    both.damping_ratio = (first + second) / (2.0 * std::sqrt(first * second));
    both.description = "hydraulic: motors on the oil spring, overdamped";
    swinging.push_back(std::move(both));
  }
  if (swinging.empty()) {
    throw NumericalFailure("hydraulic_mode: no mode of the plant moves motors and oil");
  }
  return *std::ranges::min_element(swinging, {}, &PlantMode::frequency);
}

}  // namespace boresight::plant
