#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include <boresight/numerics/error.hpp>
#include <boresight/numerics/hermitian_eigen.hpp>
#include <boresight/plant/antenna/structure_dynamics.hpp>

namespace boresight::plant {
namespace {

using Eigen::Index;

constexpr std::array<const char*, 3> places{"bull_gear_angle", "encoder", "beam"};

void require(bool satisfied, const char* expected, double found) {
  if (!satisfied || !std::isfinite(found)) {
    throw InvalidInput(fmt::format("structure: expected {}, found {}", expected, found));
  }
}

void check(const Structure& structure) {
  require(structure.bull_gear_inertia > 0.0, "a positive bull gear inertia",
          structure.bull_gear_inertia);
  for (const auto& mode : structure.modes) {
    require(mode.inertia > 0.0, "a positive modal inertia", mode.inertia);
    require(mode.stiffness > 0.0, "a positive modal stiffness", mode.stiffness);
    require(mode.damping >= 0.0, "a modal damping of at least 0", mode.damping);
  }
}

// The row of each place among the displacements.
std::array<Index, places.size()> check(const VibrationModes& modes) {
  const Index count = modes.frequency.size();
  const auto forces = static_cast<Index>(modes.forces.size());
  const auto displacements = static_cast<Index>(modes.displacements.size());
  if (modes.damping_ratio.size() != count || modes.force_shape.rows() != count ||
      modes.force_shape.cols() != forces || modes.displacement_shape.rows() != displacements ||
      modes.displacement_shape.cols() != count) {
    throw InvalidInput(fmt::format(
        "structure: expected damping ratios, {0} x {1} force shapes and {2} x {0} displacement "
        "shapes of {0} modes, found {3}, {4} x {5} and {6} x {7}",
        count, forces, displacements, modes.damping_ratio.size(), modes.force_shape.rows(),
        modes.force_shape.cols(), modes.displacement_shape.rows(),
        modes.displacement_shape.cols()));
  }
  if (modes.forces.empty() || modes.forces.front() != "gear_torque") {
    throw InvalidInput("structure: expected gear_torque as the first force of the modes");
  }
  Index free = 0;
  for (Index i = 0; i < count; ++i) {
    require(modes.frequency[i] >= 0.0, "a frequency of at least 0", modes.frequency[i]);
    require(modes.damping_ratio[i] >= 0.0, "a damping ratio of at least 0", modes.damping_ratio[i]);
    free += modes.frequency[i] == 0.0 ? 1 : 0;
  }
  if (free != 1) {
    throw InvalidInput(fmt::format(
        "structure: expected one mode of frequency 0, the turn about the axis, found {}", free));
  }
  if (!modes.force_shape.allFinite() || !modes.displacement_shape.allFinite()) {
    throw InvalidInput("structure: expected finite mode shapes");
  }
  std::array<Index, places.size()> rows{};
  for (std::size_t k = 0; k < places.size(); ++k) {
    const auto found = std::ranges::find(modes.displacements, places[k]);
    if (found == modes.displacements.end()) {
      throw InvalidInput(
          fmt::format("structure: expected a displacement {} of the modes", places[k]));
    }
    rows[k] = found - modes.displacements.begin();
  }
  // What a force does at a place and what the place sees are one shape: by Betti's reciprocal
  // theorem, and so that the gear gives no energy of its own.
  const Eigen::VectorXd pushed = modes.force_shape.col(0);
  const Eigen::VectorXd seen = modes.displacement_shape.row(rows[0]).transpose();
  if ((pushed - seen).cwiseAbs().maxCoeff() > 1e-6 * seen.cwiseAbs().maxCoeff()) {
    throw InvalidInput(
        "structure: expected the force shape of gear_torque to be the displacement shape of "
        "bull_gear_angle, found another");
  }
  Index turn = 0;
  modes.frequency.minCoeff(&turn);
  if (seen[turn] == 0.0) {
    throw InvalidInput("structure: expected the bull gear to move in the mode of frequency 0");
  }
  return rows;
}

StateSpace empty_dynamics(Index states, std::vector<std::string> inputs) {
  const auto count = static_cast<Index>(inputs.size());
  return {Eigen::MatrixXd::Zero(states, states),
          Eigen::MatrixXd::Zero(states, count),
          Eigen::MatrixXd::Zero(4, states),
          Eigen::MatrixXd::Zero(4, count),
          std::move(inputs),
          {"bull_gear_angle", "bull_gear_rate", "encoder", "beam"},
          {}};
}

StateSpace dynamics(const Structure& structure) {
  check(structure);
  const auto modes = static_cast<Index>(structure.modes.size());
  StateSpace system = empty_dynamics(2 + 2 * modes, {"gear_torque", "wind_torque"});
  auto& a = system.a;
  const double jb = structure.bull_gear_inertia;
  a(0, 1) = 1.0;
  system.b(1, 0) = 1.0 / jb;
  system.b(1, 1) = structure.bull_gear_wind_fraction / jb;
  system.c(0, 0) = system.c(1, 1) = system.c(2, 0) = 1.0;
  system.c(3, 0) = structure.bull_gear_beam_weight;
  system.states = {"bull_gear_angle", "bull_gear_rate"};
  for (Index i = 0; i < modes; ++i) {
    const auto& mode = structure.modes[static_cast<std::size_t>(i)];
    const Index angle = 2 + 2 * i;
    const Index rate = angle + 1;
    a(1, 0) -= mode.stiffness / jb;
    a(1, angle) = mode.stiffness / jb;
    a(1, 1) -= mode.damping / jb;
    a(1, rate) = mode.damping / jb;
    a(angle, rate) = 1.0;
    a(rate, 0) = mode.stiffness / mode.inertia;
    a(rate, angle) = -mode.stiffness / mode.inertia;
    a(rate, 1) = mode.damping / mode.inertia;
    a(rate, rate) = -mode.damping / mode.inertia;
    system.b(rate, 1) = mode.wind_fraction / mode.inertia;
    system.c(3, angle) = mode.beam_weight;
    system.states.push_back(fmt::format("mode_{}_angle", i + 1));
    system.states.push_back(fmt::format("mode_{}_rate", i + 1));
  }
  return system;
}

StateSpace dynamics(const VibrationModes& modes) {
  const auto rows = check(modes);
  const Index count = modes.frequency.size();
  StateSpace system = empty_dynamics(2 * count, modes.forces);
  for (Index i = 0; i < count; ++i) {
    const double w = modes.frequency[i];
    const Index coordinate = 2 * i;
    system.a(coordinate, coordinate + 1) = 1.0;
    system.a(coordinate + 1, coordinate) = -w * w;
    system.a(coordinate + 1, coordinate + 1) = -2.0 * modes.damping_ratio[i] * w;
    system.b.row(coordinate + 1) = modes.force_shape.row(i);
    system.c(0, coordinate) = system.c(1, coordinate + 1) = modes.displacement_shape(rows[0], i);
    system.c(2, coordinate) = modes.displacement_shape(rows[1], i);
    system.c(3, coordinate) = modes.displacement_shape(rows[2], i);
    system.states.push_back(fmt::format("mode_{}", i));
    system.states.push_back(fmt::format("mode_{}_rate", i));
  }
  return system;
}

Index free_mode(const VibrationModes& modes) {
  Index mode = 0;
  modes.frequency.minCoeff(&mode);
  return mode;
}

}  // namespace

StateSpace structure_dynamics(const StructureModel& structure) {
  return std::visit([](const auto& model) { return dynamics(model); }, structure);
}

Eigen::VectorXd rigid_rotation(const StructureModel& structure) {
  if (const auto* lumped = std::get_if<Structure>(&structure)) {
    Eigen::VectorXd turn = Eigen::VectorXd::Zero(2 + 2 * static_cast<Index>(lumped->modes.size()));
    for (Index i = 0; i < turn.size(); i += 2) turn[i] = 1.0;
    return turn;
  }
  const auto& modes = std::get<VibrationModes>(structure);
  const auto rows = check(modes);
  const Index mode = free_mode(modes);
  Eigen::VectorXd turn = Eigen::VectorXd::Zero(2 * modes.frequency.size());
  turn[2 * mode] = 1.0 / modes.displacement_shape(rows[0], mode);
  return turn;
}

double antenna_inertia(const StructureModel& structure) {
  if (const auto* lumped = std::get_if<Structure>(&structure)) return antenna_inertia(*lumped);
  const auto& modes = std::get<VibrationModes>(structure);
  check(modes);
  return 1.0 / std::pow(modes.force_shape(free_mode(modes), 0), 2);
}

double structure_energy(const StructureModel& structure, const Eigen::VectorXd& state) {
  const Index states = rigid_rotation(structure).size();
  if (state.size() != states) {
    throw InvalidInput(
        fmt::format("structure_energy: expected {} states, found {}", states, state.size()));
  }
  double energy = 0.0;
  if (const auto* lumped = std::get_if<Structure>(&structure)) {
    energy = 0.5 * lumped->bull_gear_inertia * state[1] * state[1];
    for (std::size_t i = 0; i < lumped->modes.size(); ++i) {
      const auto& mode = lumped->modes[i];
      const Index angle = 2 + 2 * static_cast<Index>(i);
      energy += 0.5 * mode.inertia * std::pow(state[angle + 1], 2) +
                0.5 * mode.stiffness * std::pow(state[angle] - state[0], 2);
    }
    return energy;
  }
  const auto& modes = std::get<VibrationModes>(structure);
  for (Index i = 0; i < modes.frequency.size(); ++i) {
    energy +=
        0.5 * (std::pow(state[2 * i + 1], 2) + std::pow(modes.frequency[i] * state[2 * i], 2));
  }
  return energy;
}

VibrationModes to_vibration_modes(const Structure& structure) {
  check(structure);
  const auto masses = static_cast<Index>(structure.modes.size()) + 1;
  // Stiffness and damping, each coordinate scaled by the root of its inertia; wind and beam.
  Eigen::VectorXd inertia(masses);
  Eigen::VectorXd wind(masses);
  Eigen::VectorXd boresight(masses);
  inertia[0] = structure.bull_gear_inertia;
  wind[0] = structure.bull_gear_wind_fraction;
  boresight[0] = structure.bull_gear_beam_weight;
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(masses, masses);
  Eigen::MatrixXd damping = Eigen::MatrixXd::Zero(masses, masses);
  for (Index i = 1; i < masses; ++i) {
    const auto& mode = structure.modes[static_cast<std::size_t>(i - 1)];
    inertia[i] = mode.inertia;
    wind[i] = mode.wind_fraction;
    boresight[i] = mode.beam_weight;
    stiffness(i, i) += mode.stiffness;
    stiffness(0, 0) += mode.stiffness;
    stiffness(i, 0) = stiffness(0, i) = -mode.stiffness;
    damping(i, i) += mode.damping;
    damping(0, 0) += mode.damping;
    damping(i, 0) = damping(0, i) = -mode.damping;
  }
  const Eigen::VectorXd scale = inertia.cwiseSqrt().cwiseInverse();
  const auto eigen = numerics::hermitian_eigen(
      (scale.asDiagonal() * stiffness * scale.asDiagonal()).cast<std::complex<double>>());
  const Eigen::MatrixXd shape = scale.asDiagonal() * eigen.vectors.real();
  VibrationModes modes;
  modes.frequency = eigen.values.cwiseMax(0.0).cwiseSqrt();
  modes.frequency[0] = 0.0;
  modes.damping_ratio = Eigen::VectorXd::Zero(masses);
  for (Index i = 1; i < masses; ++i) {
    modes.damping_ratio[i] = shape.col(i).dot(damping * shape.col(i)) / (2.0 * modes.frequency[i]);
  }
  modes.forces = {"gear_torque", "wind_torque"};
  modes.displacements = {places[0], places[1], places[2]};
  modes.rates = {"bull_gear_rate", "", ""};
  modes.force_shape.resize(masses, 2);
  modes.force_shape << shape.row(0).transpose(), shape.transpose() * wind;
  modes.displacement_shape.resize(3, masses);
  modes.displacement_shape << shape.row(0), shape.row(0), boresight.transpose() * shape;
  return modes;
}

}  // namespace boresight::plant
