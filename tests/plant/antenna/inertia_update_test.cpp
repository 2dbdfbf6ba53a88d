#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "reference_antenna.hpp"
#include <boresight/numerics/error.hpp>
#include <boresight/plant/antenna/inertia_update.hpp>

namespace boresight::plant {
namespace {

double largest_difference(const PlantResponse& found, const PlantResponse& wanted) {
  double largest = 0.0;
  const auto compare = [&](const Eigen::ArrayXcd& x, const Eigen::ArrayXcd& y) {
    largest = std::max(largest, ((x - y).abs() / y.abs()).maxCoeff());
  };
  compare(found.tachometer_command, wanted.tachometer_command);
  compare(found.torque_command, wanted.torque_command);
  compare(found.encoder_command, wanted.encoder_command);
  compare(found.beam_command, wanted.beam_command);
  compare(found.tachometer_wind, wanted.tachometer_wind);
  compare(found.torque_wind, wanted.torque_wind);
  compare(found.encoder_wind, wanted.encoder_wind);
  compare(found.beam_wind, wanted.beam_wind);
  return largest;
}

double worst_over_factors(const AntennaPlant& plant) {
  const Eigen::ArrayXd frequency = frequency_grid(plant, 1e-4, 100.0, 100);
  const PlantResponse response = plant_response(plant, frequency);
  double worst = 0.0;
  for (const double factor : {0.01, 0.1, 0.5, 0.99, 1.01, 2.0, 10.0, 100.0}) {
    AntennaPlant changed = plant;
    changed.drive.motor_inertia *= factor;
    worst = std::max(worst, largest_difference(with_motor_inertia(response, plant.drive,
                                                                  changed.drive.motor_inertia),
                                               plant_response(changed, frequency)));
  }
  return worst;
}

TEST(InertiaUpdate, EqualsAFreshPlantOnTheReferenceAntenna) {
  EXPECT_LT(worst_over_factors(reference::antenna()), 1e-10);
}

TEST(InertiaUpdate, EqualsAFreshPlantWithoutLeakageAndFriction) {
  AntennaPlant plant = reference::antenna();
  plant.drive.leakage_rate = plant.drive.viscous_friction = 0.0;
  EXPECT_LT(worst_over_factors(plant), 1e-10);
}

TEST(InertiaUpdate, EqualsAFreshPlantOnRandomStructures) {
  reference::RandomNumbers random(7);
  for (int i = 0; i < 30; ++i) {
    EXPECT_LT(worst_over_factors(reference::random_antenna(random)), 1e-10) << i;
  }
}

TEST(InertiaUpdate, OnePointIsThatOfTheGrid) {
  const AntennaPlant plant = reference::antenna();
  const Eigen::ArrayXd frequency = Eigen::ArrayXd::LinSpaced(5, 1.0, 30.0);
  const PlantResponse response = plant_response(plant, frequency);
  const PlantResponse updated = with_motor_inertia(response, plant.drive, 0.5);
  for (Eigen::Index i = 0; i < frequency.size(); ++i) {
    const ResponsePoint one =
        with_motor_inertia(point(response, i), plant.drive, 0.5, frequency[i]);
    EXPECT_EQ(one.beam_wind, updated.beam_wind[i]);
    EXPECT_EQ(one.torque_command, updated.torque_command[i]);
  }
}

TEST(InertiaUpdate, ThereAndBackIsTheSame) {
  const AntennaPlant plant = reference::antenna();
  const Eigen::ArrayXd frequency = frequency_grid(plant, 1e-4, 100.0, 50);
  const PlantResponse response = plant_response(plant, frequency);
  Drive heavy = plant.drive;
  heavy.motor_inertia *= 5.0;
  const PlantResponse there = with_motor_inertia(response, plant.drive, heavy.motor_inertia);
  EXPECT_LT(
      largest_difference(with_motor_inertia(there, heavy, plant.drive.motor_inertia), response),
      1e-10);
}

TEST(InertiaUpdate, RefusesWhatIsNoInertia) {
  const AntennaPlant plant = reference::antenna();
  const PlantResponse response = plant_response(plant, Eigen::ArrayXd::Ones(1));
  for (const double inertia : {0.0, -1.0, std::numeric_limits<double>::infinity(),
                               std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(with_motor_inertia(response, plant.drive, inertia), InvalidInput);
    EXPECT_THROW(with_motor_inertia(point(response, 0), plant.drive, inertia, 1.0), InvalidInput);
  }
  try {
    with_motor_inertia(response, plant.drive, -1.0);
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_STREQ(error.what(),
                 "with_motor_inertia: expected a positive, finite motor_inertia (kg m2), found -1");
  }
}

}  // namespace
}  // namespace boresight::plant
