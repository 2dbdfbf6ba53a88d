#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reference_antenna.hpp"
#include "refused_call.hpp"
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/antenna/plant_response.hpp>

namespace boresight::plant {
namespace {

using reference::relative_error;
using Complex = std::complex<double>;

// Rows as the outputs, columns as the inputs of the state space.
Eigen::Matrix<Complex, 4, 2> at(const PlantResponse& r, Eigen::Index i) {
  Eigen::Matrix<Complex, 4, 2> response;
  response << r.tachometer_command[i], r.tachometer_wind[i], r.torque_command[i], r.torque_wind[i],
      r.encoder_command[i], r.encoder_wind[i], r.boresight_command[i], r.boresight_wind[i];
  return response;
}

TEST(PlantResponse, IsThatOfTheStateSpace) {
  reference::RandomNumbers random(71);
  // The dense solution loses digits towards the free angle's pole at 0, as 1/frequency.
  double worst = 0.0, worst_scaled = 0.0;
  for (int trial = 0; trial < 200; ++trial) {
    const AntennaPlant plant =
        trial == 0 ? reference::antenna() : reference::random_antenna(random);
    const StateSpace system = to_state_space(plant);
    for (int point = 0; point < 10; ++point) {
      const double f = random.log_uniform(1e-4, 25.0);
      const double w = two_pi * f;
      const auto fast = at(plant_response(plant, Eigen::ArrayXd::Constant(1, w)), 0);
      const Eigen::MatrixXcd dense = frequency_response(system, w);
      for (Eigen::Index i = 0; i < 4; ++i) {
        for (Eigen::Index j = 0; j < 2; ++j) {
          const double error = relative_error(fast(i, j), dense(i, j));
          worst = std::max(worst, error);
          worst_scaled = std::max(worst_scaled, std::min(1.0, f) * error);
        }
      }
    }
  }
  EXPECT_LT(worst, 1e-8);
  EXPECT_LT(worst_scaled, 1e-11);
}

TEST(PlantResponse, HasTheLowFrequencyAsymptotesOfARigidBody) {
  // Towards s = 0: motor rate per command K/(K + Bf lambda); steady wind torque Tw turns the motor
  // at Tw lambda/(K + Bf lambda) and is carried by the oil but for friction's part.
  reference::RandomNumbers random(72);
  for (int trial = 0; trial < 20; ++trial) {
    const AntennaPlant plant = reference::random_antenna(random);
    const Drive& drive = plant.drive;
    const double w = 1e-12;
    const auto response = at(plant_response(plant, Eigen::ArrayXd::Constant(1, w)), 0);
    const double sum = drive.oil_stiffness + drive.viscous_friction * drive.leakage_rate;
    const double follow = drive.oil_stiffness / sum;
    const Complex s{0.0, w};
    constexpr double tolerance = 1e-9;
    EXPECT_LT(relative_error(response(0, 0), follow), tolerance);
    EXPECT_LT(std::abs(response(1, 0) - drive.viscous_friction * follow), tolerance);
    EXPECT_LT(relative_error(response(2, 0) * s, follow), tolerance);
    EXPECT_LT(relative_error(response(3, 0) * s, follow), tolerance);
    const double drift = drive.leakage_rate / sum;
    EXPECT_LT(relative_error(response(0, 1), drift), tolerance);
    EXPECT_LT(relative_error(response(1, 1), -drive.oil_stiffness / sum), tolerance);
    EXPECT_LT(relative_error(response(2, 1) * s, drift), tolerance);
    EXPECT_LT(relative_error(response(3, 1) * s, drift), tolerance);
  }
}

TEST(PlantResponse, OfTheCommandFadesLikeItsPoleExcess) {
  // Far above every pole: valve wv^2/s^2, oil K/s, motor 1/(Jm s), tachometer wt/s.
  const AntennaPlant plant = reference::antenna();
  const Drive& drive = plant.drive;
  const double w = 1e5;
  const Complex s{0.0, w};
  const auto response = at(plant_response(plant, Eigen::ArrayXd::Constant(1, w)), 0);
  const Complex expected = std::pow(drive.valve_corner, 2) * drive.oil_stiffness *
                           drive.tachometer_corner / drive.motor_inertia / (s * s * s * s * s);
  EXPECT_LT(relative_error(response(0, 0), expected), 5e-3);
}

TEST(PlantResponse, IsReciprocalBetweenMotorAndWind) {
  // Torque at the bull gear's wind input moves the motor as torque at the motor moves the point the
  // wind acts on: with beam weights equal to the wind fractions, beam per motor torque is the motor
  // per wind. The oil's torque is the command's push.
  AntennaPlant plant = reference::antenna();
  plant.structure.bull_gear_beam_weight = plant.structure.bull_gear_wind_fraction;
  for (auto& mode : plant.structure.modes) mode.beam_weight = mode.wind_fraction;
  const Drive& drive = plant.drive;
  for (const double f : {0.01, 0.8, 2.3, 9.0}) {
    const Complex s{0.0, two_pi * f};
    const auto response = at(plant_response(plant, Eigen::ArrayXd::Constant(1, two_pi * f)), 0);
    const Complex valve = std::pow(drive.valve_corner, 2) /
                          (s * s + 2.0 * drive.valve_damping * drive.valve_corner * s +
                           std::pow(drive.valve_corner, 2));
    const Complex push = drive.oil_stiffness / (s + drive.leakage_rate) * valve;
    const Complex lag = drive.tachometer_corner / (s + drive.tachometer_corner);
    EXPECT_LT(relative_error(response(3, 0) / push, response(0, 1) / (s * lag)), 1e-12);
  }
}

TEST(PlantResponse, SharesOneStructureBetweenDrives) {
  const AntennaPlant plant = reference::antenna(24.0);
  const AntennaPlant light = reference::antenna(4.0);
  const Eigen::ArrayXd w = Eigen::ArrayXd::LinSpaced(30, 0.1, 60.0);
  const auto structure = structure_response(plant.structure, w);
  for (const auto* which : {&plant, &light}) {
    const auto shared = plant_response(structure, which->drive);
    const auto whole = plant_response(*which, w);
    for (Eigen::Index i = 0; i < w.size(); ++i) EXPECT_EQ(at(shared, i), at(whole, i));
  }
}

TEST(FrequencyGrid, RisesFromTheLowestToTheHighest) {
  const Eigen::ArrayXd grid = frequency_grid(reference::antenna(), 1e-4, 25.0, 100);
  EXPECT_NEAR(grid[0], two_pi * 1e-4, 1e-12);
  EXPECT_NEAR(grid[grid.size() - 1], two_pi * 25.0, 1e-9);
  for (Eigen::Index i = 1; i < grid.size(); ++i) {
    ASSERT_GT(grid[i], grid[i - 1]);
    EXPECT_LT(std::log10(grid[i] / grid[i - 1]), 1.0001 / 100.0);
  }
}

TEST(FrequencyGrid, CoversEveryLightlyDampedPole) {
  reference::RandomNumbers random(73);
  for (int trial = 0; trial < 10; ++trial) {
    const AntennaPlant plant = reference::random_antenna(random);
    const Eigen::ArrayXd grid = frequency_grid(plant, 1e-4, 25.0, 50);
    for (const Complex pole : numerics::eigenvalues(to_state_space(plant).a)) {
      const double half_width = -pole.real();
      if (pole.imag() <= 0.0 || half_width >= 0.1 * std::abs(pole)) continue;
      if (pole.imag() + 4.0 * half_width >= two_pi * 25.0) continue;
      const auto within = ((grid - pole.imag()).abs() <= 4.0001 * half_width).count();
      EXPECT_GE(within, 25) << pole;
      EXPECT_LT((grid - pole.imag()).abs().minCoeff(), 1e-6 * pole.imag());
    }
  }
}

TEST(FrequencyGrid, RefusesAnEmptyBand) {
  const AntennaPlant plant = reference::antenna();
  EXPECT_THAT(reference::Call([&] { frequency_grid(plant, 1.0, 0.5, 100); }),
              testing::ThrowsMessage<InvalidInput>(testing::HasSubstr("frequency_grid")));
  EXPECT_THROW(frequency_grid(plant, 0.0, 1.0, 100), InvalidInput);
  EXPECT_THROW(frequency_grid(plant, 0.1, 1.0, 0), InvalidInput);
  EXPECT_THROW(frequency_grid(plant, std::nan(""), 1.0, 10), InvalidInput);
}

}  // namespace
}  // namespace boresight::plant
