#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reference_antenna.hpp"
#include "refused_call.hpp"
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/antenna/antenna_plant.hpp>
#include <boresight/plant/antenna/plant_response.hpp>

namespace boresight::plant {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

AntennaPlant without_damping(AntennaPlant plant) {
  plant.drive.leakage_rate = plant.drive.viscous_friction = plant.drive.valve_damping = 0.0;
  plant.structure.gear_damping = 0.0;
  for (auto& mode : plant.structure.modes) mode.damping = 0.0;
  return plant;
}

// Everything of torque times a factor: inertias, springs, dampers.
AntennaPlant scaled(AntennaPlant plant, double inertia, double spring, double damper) {
  plant.drive.motor_inertia *= inertia;
  plant.drive.oil_stiffness *= spring;
  plant.drive.viscous_friction *= damper;
  plant.structure.bull_gear_inertia *= inertia;
  plant.structure.gear_stiffness *= spring;
  plant.structure.gear_damping *= damper;
  for (auto& mode : plant.structure.modes) {
    mode.inertia *= inertia;
    mode.stiffness *= spring;
    mode.damping *= damper;
  }
  return plant;
}

double response_difference(const PlantResponse& one, const PlantResponse& other) {
  const auto worst = [](const Eigen::ArrayXcd& x, const Eigen::ArrayXcd& y) {
    return ((x - y).abs() / y.abs()).maxCoeff();
  };
  double difference = 0.0;
  for (const auto member : {&PlantResponse::tachometer_command, &PlantResponse::torque_command,
                            &PlantResponse::encoder_command, &PlantResponse::boresight_command,
                            &PlantResponse::tachometer_wind, &PlantResponse::torque_wind,
                            &PlantResponse::encoder_wind, &PlantResponse::boresight_wind}) {
    difference = std::max(difference, worst(one.*member, other.*member));
  }
  return difference;
}

Eigen::ArrayXd frequencies() {
  return two_pi * Eigen::ArrayXd::LinSpaced(60, std::log(1e-4), std::log(25.0)).exp();
}

TEST(AntennaPlant, WithoutDampingHasPolesOnTheImaginaryAxis) {
  const AntennaPlant plant = without_damping(reference::antenna());
  int on_axis = 0;
  for (const auto pole : numerics::eigenvalues(to_state_space(plant).a)) {
    if (std::abs(pole + plant.drive.tachometer_corner) < 1e-6) continue;  // the only lag
    EXPECT_NEAR(pole.real(), 0.0, 1e-9) << pole;
    ++on_axis;
  }
  EXPECT_EQ(on_axis, 15);
}

TEST(AntennaPlant, LosesEnergyInItsDampersOnly) {
  // E = Tm^2/2K + sum J w^2/2 + sum k (difference)^2/2; dE/dt = -(lambda/K) Tm^2 - Bf w^2 - sum c
  // (rate difference)^2 with the valve closed.
  reference::RandomNumbers random(51);
  for (int trial = 0; trial < 20; ++trial) {
    const AntennaPlant plant = reference::random_antenna(random);
    const StateSpace system = to_state_space(plant);
    const Eigen::Index n = system.a.rows();
    Eigen::VectorXd x = random.matrix(n, 1);
    x[0] = x[1] = 0.0;
    Eigen::VectorXd gradient = Eigen::VectorXd::Zero(n);
    const Drive& drive = plant.drive;
    const Structure& structure = plant.structure;
    enum { torque = 2, motor_rate, motor, bull, bull_rate };
    gradient[torque] = x[torque] / drive.oil_stiffness;
    gradient[motor_rate] = drive.motor_inertia * x[motor_rate];
    gradient[bull_rate] = structure.bull_gear_inertia * x[bull_rate];
    const double twist = structure.gear_stiffness * (x[motor] - x[bull]);
    gradient[motor] = twist;
    gradient[bull] = -twist;
    double loss = drive.leakage_rate / drive.oil_stiffness * x[torque] * x[torque] +
                  drive.viscous_friction * x[motor_rate] * x[motor_rate] +
                  structure.gear_damping * std::pow(x[motor_rate] - x[bull_rate], 2);
    for (std::size_t i = 0; i < structure.modes.size(); ++i) {
      const auto& mode = structure.modes[i];
      const auto angle = static_cast<Eigen::Index>(8 + 2 * i);
      const double stretch = mode.stiffness * (x[bull] - x[angle]);
      gradient[bull] += stretch;
      gradient[angle] -= stretch;
      gradient[angle + 1] = mode.inertia * x[angle + 1];
      loss += mode.damping * std::pow(x[bull_rate] - x[angle + 1], 2);
    }
    const Eigen::VectorXd change = system.a * x;
    const double power = gradient.dot(change);
    const double size = gradient.cwiseAbs().dot(change.cwiseAbs());
    EXPECT_NEAR(power, -loss, 1e-13 * size);
  }
}

TEST(AntennaPlant, IsFreeToRotateAndOtherwiseStable) {
  reference::RandomNumbers random(52);
  for (int trial = 0; trial < 10; ++trial) {
    const Eigen::VectorXcd poles =
        numerics::eigenvalues(to_state_space(reference::random_antenna(random)).a);
    EXPECT_LT(std::abs(poles[0]), 1e-9);
    EXPECT_LT(poles.tail(poles.size() - 1).real().maxCoeff(), -1e-6);
  }
}

TEST(AntennaPlant, WithAStiffStructureHasTheRigidHydraulicMode) {
  StructureSpecification specification = reference::structure();
  specification.locked_rotor_frequency *= 1e4;
  for (auto& mode : specification.modes) mode.frequency *= 1e4;
  AntennaPlant plant = reference::antenna();
  plant.structure = make_structure(specification);
  for (const double friction : {0.0, 0.9, 12.0}) {
    plant.drive.viscous_friction = friction;
    const double j = reflected_inertia(plant);
    const double leakage = plant.drive.leakage_rate;
    const double half = 0.5 * (friction / j + leakage);
    const double square = (plant.drive.oil_stiffness + friction * leakage) / j;
    const std::complex<double> root{-half, std::sqrt(square - half * half)};
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto pole : numerics::eigenvalues(to_state_space(plant).a)) {
      nearest = std::min(nearest, std::abs(pole - root));
    }
    EXPECT_LT(nearest, 1e-5);
  }
}

TEST(MakeStructure, MakesTheLockedRotorFrequencyTheLowestWithTheMotorHeld) {
  const auto specification = reference::structure();
  const Structure structure = make_structure(specification);
  // q'' = -M^-1 K q of bull gear and modes, motor held.
  const Eigen::Index n = 5;
  Eigen::MatrixXd springs = Eigen::MatrixXd::Zero(n, n);
  springs(0, 0) = structure.gear_stiffness / structure.bull_gear_inertia;
  for (Eigen::Index i = 1; i < n; ++i) {
    const auto& mode = structure.modes[static_cast<std::size_t>(i - 1)];
    springs(0, 0) += mode.stiffness / structure.bull_gear_inertia;
    springs(0, i) = -mode.stiffness / structure.bull_gear_inertia;
    springs(i, 0) = -mode.stiffness / mode.inertia;
    springs(i, i) = mode.stiffness / mode.inertia;
  }
  EXPECT_NEAR(std::sqrt(numerics::eigenvalues(springs)[0].real()) / two_pi, 2.0, 1e-12);
  EXPECT_NEAR(structure.gear_damping, 2.0 * 0.01 * structure.gear_stiffness / (two_pi * 2.0),
              1e-12);
  EXPECT_NEAR(antenna_inertia(structure), specification.antenna_inertia, 1e-15);
  for (std::size_t i = 0; i < 4; ++i) {
    const auto& mode = structure.modes[i];
    EXPECT_NEAR(std::sqrt(mode.stiffness / mode.inertia) / two_pi, specification.modes[i].frequency,
                1e-12);
  }
}

TEST(AntennaPlant, OfTwoMassesResonatesAboveItsAntiresonance) {
  // Oil so soft that the motor is free: f_res/f_antires = sqrt(1 + J_L/J_m).
  AntennaPlant plant = without_damping(reference::antenna());
  plant.structure.modes.clear();
  plant.structure.bull_gear_inertia = reference::antenna_inertia();
  plant.drive.oil_stiffness = 1e-9;
  const double kg = plant.structure.gear_stiffness;
  const double antires = std::sqrt(kg / plant.structure.bull_gear_inertia);
  const double ratio =
      std::sqrt(1.0 + plant.structure.bull_gear_inertia / plant.drive.motor_inertia);
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto pole : numerics::eigenvalues(to_state_space(plant).a)) {
    nearest = std::min(nearest, std::abs(pole.imag() / antires - ratio));
  }
  EXPECT_LT(nearest, 1e-8);
  // At the antiresonance the load holds the motor: no motion per command there.
  Eigen::ArrayXd w(2);
  w << antires, 0.9 * antires;
  const auto response = plant_response(plant, w);
  EXPECT_LT(std::abs(response.tachometer_command[0] / response.tachometer_command[1]), 1e-9);
}

TEST(AntennaPlant, DoesNotChangeWhenAModeIsCutInTwoEqualHalves) {
  reference::RandomNumbers random(53);
  for (int trial = 0; trial < 10; ++trial) {
    const AntennaPlant whole = reference::random_antenna(random);
    AntennaPlant halves = whole;
    auto& mode = halves.structure.modes.front();
    mode.inertia *= 0.5;
    mode.stiffness *= 0.5;
    mode.damping *= 0.5;
    mode.wind_fraction *= 0.5;
    mode.beam_weight *= 0.5;
    halves.structure.modes.push_back(mode);
    EXPECT_LT(response_difference(plant_response(halves, frequencies()),
                                  plant_response(whole, frequencies())),
              1e-9);
    const double w = two_pi * random.log_uniform(1e-2, 20.0);
    const Eigen::MatrixXcd one = frequency_response(to_state_space(halves), w);
    const Eigen::MatrixXcd other = frequency_response(to_state_space(whole), w);
    EXPECT_LT(((one - other).array().abs() / other.array().abs()).maxCoeff(), 1e-9);
  }
}

TEST(AntennaPlant, DoesNotDependOnTheUnitOfTorque) {
  const AntennaPlant plant = reference::antenna();
  const double unit = 8.8507;  // in lbf a N m
  const auto other = plant_response(scaled(plant, unit, unit, unit), frequencies());
  auto expected = plant_response(plant, frequencies());
  expected.torque_command *= unit;
  expected.tachometer_wind /= unit;
  expected.encoder_wind /= unit;
  expected.boresight_wind /= unit;
  EXPECT_LT(response_difference(other, expected), 1e-12);
}

TEST(AntennaPlant, DoesNotDependOnTheUnitOfTime) {
  const double rate = 60.0;  // per minute
  const AntennaPlant plant = reference::antenna();
  AntennaPlant slow = scaled(plant, 1.0, rate * rate, rate);
  slow.drive.leakage_rate *= rate;
  slow.drive.valve_corner *= rate;
  slow.drive.tachometer_corner *= rate;
  const Eigen::VectorXcd minutes = numerics::eigenvalues(to_state_space(slow).a);
  const Eigen::VectorXcd seconds = numerics::eigenvalues(to_state_space(plant).a);
  EXPECT_LT((minutes / rate - seconds).norm(), 1e-8);
  const auto other = plant_response(slow, rate * frequencies());
  auto expected = plant_response(plant, frequencies());
  expected.torque_command *= rate;  // N m per rad/min
  expected.encoder_command /= rate;
  expected.boresight_command /= rate;
  expected.tachometer_wind /= rate;
  expected.torque_wind *= 1.0;
  expected.encoder_wind /= rate * rate;
  expected.boresight_wind /= rate * rate;
  EXPECT_LT(response_difference(other, expected), 1e-12);
}

TEST(ToStateSpace, RefusesParametersWithoutMeaning) {
  const auto refused = [](auto change, const char* message) {
    for (const double bad : {-1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
      AntennaPlant plant = reference::antenna();
      change(plant) = bad;
      EXPECT_THAT(reference::Call([&] { to_state_space(plant); }),
                  ThrowsMessage<InvalidInput>(HasSubstr(message)));
    }
  };
  refused([](AntennaPlant& p) -> double& { return p.drive.oil_stiffness; }, "oil stiffness");
  refused([](AntennaPlant& p) -> double& { return p.drive.leakage_rate; }, "leakage rate");
  refused([](AntennaPlant& p) -> double& { return p.drive.viscous_friction; }, "friction");
  refused([](AntennaPlant& p) -> double& { return p.drive.motor_inertia; }, "motor inertia");
  refused([](AntennaPlant& p) -> double& { return p.drive.valve_corner; }, "valve corner");
  refused([](AntennaPlant& p) -> double& { return p.drive.valve_damping; }, "valve damping");
  refused([](AntennaPlant& p) -> double& { return p.drive.tachometer_corner; }, "tachometer");
  refused([](AntennaPlant& p) -> double& { return p.structure.bull_gear_inertia; }, "bull gear");
  refused([](AntennaPlant& p) -> double& { return p.structure.gear_stiffness; }, "gear stiffness");
  refused([](AntennaPlant& p) -> double& { return p.structure.modes[1].inertia; }, "modal inertia");
  refused([](AntennaPlant& p) -> double& { return p.structure.modes[1].damping; }, "modal damping");
}

TEST(MakeStructure, RefusesSharesAndFrequenciesThatDoNotFit) {
  const auto refused = [](auto change, const char* message) {
    StructureSpecification specification = reference::structure();
    change(specification);
    EXPECT_THAT(reference::Call([&] { make_structure(specification); }),
                ThrowsMessage<InvalidInput>(HasSubstr(message)));
  };
  refused([](auto& s) { s.modes[0].inertia_fraction = 0.75; }, "sum to less than 1, found 1");
  refused([](auto& s) { s.modes[0].inertia_fraction = 0.0; }, "positive inertia fractions");
  refused([](auto& s) { s.modes[0].wind_fraction = 0.8; }, "wind fractions that sum to 1");
  refused([](auto& s) { s.bull_gear_beam_weight = 0.1; }, "beam weights that sum to 1");
  refused([](auto& s) { s.locked_rotor_frequency = 2.5; }, "above the locked-rotor frequency");
  refused([](auto& s) { s.locked_rotor_frequency = 0.0; }, "positive locked-rotor frequency");
  refused([](auto& s) { s.antenna_inertia = 0.0; }, "positive antenna inertia");
  refused([](auto& s) { s.modes[2].damping_ratio = -0.1; }, "modal damping");
  refused([](auto& s) { s.modes[2].frequency = std::nan(""); }, "mode");
}

}  // namespace
}  // namespace boresight::plant
