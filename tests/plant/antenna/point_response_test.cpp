#include <gtest/gtest.h>

#include "reference_antenna.hpp"
#include "reference_values.hpp"
#include <boresight/numerics/vector_clones.hpp>
#include <boresight/plant/antenna/point_response.hpp>

namespace boresight::plant {
namespace {

// More modes than fit one pack.
AntennaPlant antenna_of_many_modes() {
  auto plant = reference::antenna();
  const auto modes = plant.structure.modes;
  while (plant.structure.modes.size() < 11) {
    for (StructuralMode mode : modes) {
      mode.stiffness *= 1.0 + 0.1 * static_cast<double>(plant.structure.modes.size());
      plant.structure.modes.push_back(mode);
    }
  }
  return plant;
}

TEST(PointResponse, IsThatOnAGridPointByPoint) {
  for (const auto& plant : {reference::antenna(), antenna_of_many_modes()}) {
    const Eigen::ArrayXd w = Eigen::ArrayXd::LinSpaced(200, std::log(1e-3), std::log(600.0)).exp();
    const PlantResponse grid = plant_response(plant, w);
    const PointResponse response(plant);
    for (Eigen::Index i = 0; i < w.size(); ++i) {
      const ResponsePoint found = response(w[i]), expected = point(grid, i);
      EXPECT_LT(reference::relative_error(found.boresight_command, expected.boresight_command),
                1e-10)
          << w[i];
      EXPECT_LT(reference::relative_error(found.boresight_wind, expected.boresight_wind), 1e-10)
          << w[i];
      EXPECT_LT(reference::relative_error(found.torque_wind, expected.torque_wind), 1e-10) << w[i];
      EXPECT_LT(reference::relative_error(found.encoder_command, expected.encoder_command), 1e-10)
          << w[i];
    }
  }
}

TEST(PointResponse, HasTheSameBitsInRegistersOfEveryWidth) {
  const PointResponse response(antenna_of_many_modes());
  for (const double w : {1e-3, 2.0, 11.0, 40.0, 500.0}) {
    const ResponsePoint expected = response(w);
    for (const std::size_t lanes : {2U, 4U}) {
      const numerics::NarrowRegisters narrow(lanes);
      const ResponsePoint found = response(w);
      EXPECT_EQ(found.boresight_command, expected.boresight_command);
      EXPECT_EQ(found.boresight_wind, expected.boresight_wind);
      EXPECT_EQ(found.tachometer_command, expected.tachometer_command);
      EXPECT_EQ(found.torque_wind, expected.torque_wind);
    }
  }
}

}  // namespace
}  // namespace boresight::plant
