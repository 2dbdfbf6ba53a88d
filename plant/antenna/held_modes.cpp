#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include <boresight/numerics/error.hpp>
#include <boresight/numerics/hermitian_eigen.hpp>
#include <boresight/plant/antenna/held_modes.hpp>
#include <boresight/plant/antenna/structure_dynamics.hpp>

namespace boresight::plant {
namespace {

using Eigen::Index;

Eigen::VectorXd displacement(const VibrationModes& modes, const char* name) {
  const auto place = std::ranges::find(modes.displacements, name) - modes.displacements.begin();
  return modes.displacement_shape.row(place).transpose();
}

// Of a place or force in the turn of the whole antenna by one radian, which is to be 1.
void require_whole(const char* what, double found) {
  if (std::abs(found - 1.0) <= 0.01) return;
  throw InvalidInput(
      fmt::format("hold_bull_gear: expected {} in the free turn as at the bull gear (within 1 %), "
                  "found {:.6g} times that",
                  what, found));
}

// Orthonormal columns, all orthogonal to a vector: those of its Householder reflection.
Eigen::MatrixXd orthogonal_to(const Eigen::VectorXd& vector) {
  const Index size = vector.size();
  Eigen::VectorXd axis = vector / vector.norm();
  axis[0] += axis[0] < 0.0 ? -1.0 : 1.0;
  const Eigen::MatrixXd reflection =
      Eigen::MatrixXd::Identity(size, size) - 2.0 / axis.squaredNorm() * axis * axis.transpose();
  return reflection.rightCols(size - 1);
}

}  // namespace

StructureSpecification hold_bull_gear(const VibrationModes& modes) {
  structure_dynamics(modes);  // checks them
  if (modes.forces.size() < 2) {
    throw InvalidInput("hold_bull_gear: expected a wind force of the modes, found none");
  }
  Index turn = 0;
  modes.frequency.minCoeff(&turn);
  const Eigen::VectorXd gear = displacement(modes, "bull_gear_angle");
  const Eigen::VectorXd encoder = displacement(modes, "encoder");
  const Eigen::VectorXd wind =
      modes.force_shape.rightCols(modes.force_shape.cols() - 1).rowwise().sum();
  const Eigen::VectorXd boresight = displacement(modes, "beam");
  const double scale = gear[turn];
  require_whole("the encoder", encoder[turn] / scale);
  require_whole("the beam", boresight[turn] / scale);
  require_whole("the wind's work", wind[turn] / scale);
  const double apart = (encoder / encoder[turn] - gear / scale).cwiseAbs().maxCoeff();
  if (apart > 1e-6 * (gear / scale).cwiseAbs().maxCoeff()) {
    throw InvalidInput(
        "hold_bull_gear: expected an encoder that follows the bull gear in every mode, found one "
        "elsewhere on the structure");
  }

  const double inertia = 1.0 / (scale * scale);
  StructureSpecification held;
  held.antenna_inertia = inertia;
  held.bull_gear_wind_fraction = 1.0;
  held.bull_gear_beam_weight = 1.0;
  if (modes.frequency.size() == 1) return held;
  const Eigen::MatrixXd basis = orthogonal_to(gear);
  const Eigen::VectorXd stiffness = modes.frequency.cwiseAbs2();
  const auto eigen = numerics::hermitian_eigen(
      (basis.transpose() * stiffness.asDiagonal() * basis).cast<std::complex<double>>());
  const Eigen::MatrixXd shapes = basis * eigen.vectors.real();
  const Eigen::VectorXd damping = 2.0 * modes.damping_ratio.cwiseProduct(modes.frequency);
  for (Index i = 0; i < shapes.cols(); ++i) {
    const auto shape = shapes.col(i);
    const double frequency = std::sqrt(std::max(eigen.values[i], 0.0));
    const double fraction = shape[turn] / scale;  // of the turn, in this mode
    const double by_wind = shape.dot(wind) * scale / wind[turn];
    const double to_boresight = shape.dot(boresight) * scale / boresight[turn];
    StructureSpecification::Mode mode;
    mode.frequency = 0.5 * frequency / std::numbers::pi;
    mode.inertia_fraction = fraction * fraction / inertia;
    if (mode.inertia_fraction < 1e-9) {
      if (std::abs(by_wind * to_boresight) * inertia > 1e-6) {
        throw InvalidInput(fmt::format(
            "hold_bull_gear: expected modes that the bull gear's motion moves, found one of {:.6g} "
            "Hz that it does not but that moves the beam in wind",
            mode.frequency));
      }
      continue;
    }
    mode.damping_ratio = shape.dot(damping.cwiseProduct(shape)) / (2.0 * frequency);
    mode.wind_fraction = fraction * by_wind;
    mode.beam_weight = fraction * to_boresight;
    held.bull_gear_wind_fraction -= mode.wind_fraction;
    held.bull_gear_beam_weight -= mode.beam_weight;
    held.modes.push_back(mode);
  }
  return held;
}

}  // namespace boresight::plant
