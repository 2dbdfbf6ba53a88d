#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reference_nonlinear_antenna.hpp"
#include <boresight/numerics/error.hpp>
#include <boresight/plant/antenna/structure_dynamics.hpp>
#include <boresight/plant/nonlinear/operating_point.hpp>

namespace boresight::plant {
namespace {

using Eigen::Index;

Structure undamped() {
  auto structure = reference::antenna().structure;
  for (auto& mode : structure.modes) mode.damping = 0.0;
  return structure;
}

TEST(StructureDynamics, IsNewtonsLawForTheWholeAntenna) {
  // A torque at the gear or the wind turns all of it; far above its modes the bull gear alone.
  const auto structure = reference::antenna().structure;
  const auto system = structure_dynamics(structure);
  const double inertia = antenna_inertia(structure);
  const double slow = 1e-3;
  const auto angle = frequency_response(system, slow);
  for (Index output : {0, 2, 3}) {
    for (Index input : {0, 1}) {
      EXPECT_NEAR(std::abs(angle(output, input)) * inertia * slow * slow, 1.0, 1e-6);
    }
  }
  const double fast = 1e4;
  EXPECT_NEAR(
      std::abs(frequency_response(system, fast)(0, 0)) * structure.bull_gear_inertia * fast * fast,
      1.0, 1e-3);
  EXPECT_LT((system.a * rigid_rotation(structure)).norm(), 1e-9 * system.a.norm());
}

TEST(StructureDynamics, VibrationModesAreTheSameMotion) {
  const Structure structure = undamped();
  const StructureModel modes = to_vibration_modes(structure);
  EXPECT_NEAR(antenna_inertia(modes), antenna_inertia(structure),
              1e-12 * antenna_inertia(structure));
  const auto expected = structure_dynamics(structure);
  const auto found = structure_dynamics(modes);
  EXPECT_EQ(found.inputs, expected.inputs);
  EXPECT_EQ(found.outputs, expected.outputs);
  for (const double w : {0.1, 5.0, 14.0, 17.3, 25.0, 90.0}) {
    const Eigen::MatrixXcd reference = frequency_response(expected, w);
    EXPECT_LT(
        ((frequency_response(found, w) - reference).array() / reference.array()).abs().maxCoeff(),
        1e-9)
        << w;
  }
  const Eigen::VectorXd turn = rigid_rotation(modes);
  const Eigen::VectorXd outputs = found.c * turn;
  EXPECT_NEAR(outputs[0], 1.0, 1e-12);
  EXPECT_NEAR(outputs[2], 1.0, 1e-12);
  EXPECT_NEAR(outputs[3], 1.0, 1e-12);
  EXPECT_LT((found.a * turn).norm(), 1e-12);
}

TEST(StructureDynamics, EnergyIsTheSameInEitherForm) {
  const Structure structure = undamped();
  const auto modes = to_vibration_modes(structure);
  const Index masses = static_cast<Index>(structure.modes.size()) + 1;
  // Coordinates from angles: shapes are orthonormal in the inertias.
  Eigen::VectorXd angles = Eigen::VectorXd::LinSpaced(masses, 0.3, -0.2);
  Eigen::VectorXd rates = Eigen::VectorXd::LinSpaced(masses, -1.0, 2.0);
  // Each mass's own shape: the response of its angle per unit force on it.
  Eigen::VectorXd lumped(2 * masses);
  Eigen::VectorXd modal = Eigen::VectorXd::Zero(2 * masses);
  Eigen::MatrixXd shape(masses, masses);
  shape.row(0) = modes.displacement_shape.row(0);
  for (Index i = 1; i < masses; ++i) {
    // (w_i^2 - w^2) q_i = w_i^2 theta_b in mode shape.
    const auto& mode = structure.modes[static_cast<std::size_t>(i - 1)];
    const double squared = mode.stiffness / mode.inertia;
    for (Index k = 0; k < masses; ++k) {
      shape(i, k) = shape(0, k) * squared / (squared - std::pow(modes.frequency[k], 2));
    }
  }
  for (Index i = 0; i < masses; ++i) {
    lumped[2 * i] = angles[i];
    lumped[2 * i + 1] = rates[i];
    const double inertia = i == 0 ? structure.bull_gear_inertia
                                  : structure.modes[static_cast<std::size_t>(i - 1)].inertia;
    for (Index k = 0; k < masses; ++k) {
      modal[2 * k] += shape(i, k) * inertia * angles[i];
      modal[2 * k + 1] += shape(i, k) * inertia * rates[i];
    }
  }
  const double energy = structure_energy(structure, lumped);
  EXPECT_NEAR(structure_energy(modes, modal), energy, 1e-9 * energy);
}

TEST(StructureDynamics, AntennaOnVibrationModesIsTheAntenna) {
  auto antenna = reference::nonlinear_antenna();
  const auto point = trim(antenna, {3.0, 0.0, {}});
  const auto expected = linearise(to_feedback_system(antenna), point.state, point.input);
  antenna.structure = to_vibration_modes(std::get<Structure>(antenna.structure));
  const auto modal_point = trim(antenna, {3.0, 0.0, {}});
  EXPECT_NEAR(modal_point.input[0], point.input[0], 1e-9);
  const auto found = linearise(to_feedback_system(antenna), modal_point.state, modal_point.input);
  for (const double w : {0.3, 5.0, 12.4, 20.0, 60.0}) {
    const Eigen::MatrixXcd reference = frequency_response(expected, w);
    // The damping that couples modes is left out: second order in 1 % of damping.
    EXPECT_LT((frequency_response(found, w) - reference).norm(), 2e-2 * reference.norm()) << w;
  }
}

TEST(StructureDynamics, RefusesModesThatDoNotFit) {
  const auto refused = [](auto change, const char* what) {
    auto modes = to_vibration_modes(reference::antenna().structure);
    change(modes);
    try {
      structure_dynamics(modes);
      ADD_FAILURE() << what;
    } catch (const InvalidInput& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr(what));
    }
  };
  refused([](auto& m) { m.frequency[0] = 1.0; }, "frequency 0");
  refused([](auto& m) { m.displacements[1] = "encodr"; }, "encoder");
  refused([](auto& m) { m.forces[0] = "torque"; }, "gear_torque");
  refused([](auto& m) { m.damping_ratio.conservativeResize(2); }, "damping ratios");
  refused([](auto& m) { m.force_shape(0, 0) = std::nan(""); }, "finite mode shapes");
  refused([](auto& m) { m.force_shape(2, 0) *= -1.0; }, "displacement shape");
  auto structure = reference::antenna().structure;
  structure.modes[0].inertia = -1.0;
  EXPECT_THROW(structure_dynamics(structure), InvalidInput);
}

}  // namespace
}  // namespace boresight::plant
