#include <gtest/gtest.h>

#include "random_numbers.hpp"
#include "reference_antenna.hpp"
#include <boresight/numerics/error.hpp>
#include <boresight/plant/antenna/antenna_modal_system.hpp>
#include <boresight/plant/modal/modal_response.hpp>

namespace boresight::plant {
namespace {

TEST(AntennaModalSystem, HasTheResponsesOfTheStateSpace) {
  auto plant = reference::antenna();
  for (int variant = 0; variant < 3; ++variant) {
    if (variant == 1) plant.structure.modes.pop_back();
    if (variant == 2) plant.structure.modes.clear();
    const auto dense = to_state_space(plant);
    const auto system = to_modal_system(plant);
    EXPECT_EQ(system.inputs, dense.inputs);
    EXPECT_EQ(system.outputs, dense.outputs);
    for (const auto& input : dense.inputs) {
      for (const auto& output : dense.outputs) {
        const ModalResponse response(system, input, output);
        for (const double w : {1e-3, 0.1, 2.0, 5.3, 12.57, 14.0, 15.08, 21.36, 38.9, 75.0, 400.0}) {
          const auto expected =
              frequency_response(dense, w)(output_index(dense, output), input_index(dense, input));
          // Far above the modes a response is the rest of larger parts.
          const double size = std::abs(expected) + 1e-9 * std::abs(response.at(0.5));
          EXPECT_LE(std::abs(response.at(w) - expected), 1e-8 * size)
              << input << " to " << output << " at " << w;
        }
      }
    }
  }
}

TEST(AntennaModalSystem, RefusesWhatTheStateSpaceRefuses) {
  auto plant = reference::antenna();
  plant.drive.motor_inertia = -1.0;
  EXPECT_THROW(to_modal_system(plant), InvalidInput);
}

}  // namespace
}  // namespace boresight::plant
