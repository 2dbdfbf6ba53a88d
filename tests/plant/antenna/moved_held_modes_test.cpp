#include <cstddef>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include <boresight/plant/antenna/antenna.hpp>
#include <boresight/plant/antenna/motors_held_modes.hpp>
#include <boresight/plant/antenna/moved_held_modes.hpp>

namespace boresight::plant {
namespace {

using Frequencies = std::vector<std::optional<double>>;

std::vector<double> held_frequencies(const StructureSpecification& antenna) {
  std::vector<double> frequencies;
  for (const auto& mode : motors_held_modes(make_structure(antenna))) {
    frequencies.push_back(mode.frequency);
  }
  return frequencies;
}

TEST(MovedHeldModes, HaveTheStatedFrequenciesWithTheMotorsHeld) {
  const auto own = structure_specification(demo_antenna());
  const Frequencies stated{2.03, 3.1817, 4.4725, 6.0089};
  const auto moved = with_motors_held_frequencies(own, stated);
  ASSERT_TRUE(moved);
  const auto held = held_frequencies(*moved);
  for (std::size_t j = 0; j < stated.size(); ++j) {
    EXPECT_NEAR(held[j], stated[j].value_or(0.0), 1e-7) << j;
  }
  for (std::size_t i = 0; i < own.modes.size(); ++i) {
    EXPECT_EQ(moved->modes[i].inertia_fraction, own.modes[i].inertia_fraction);
    EXPECT_EQ(moved->modes[i].wind_fraction, own.modes[i].wind_fraction);
  }
}

TEST(MovedHeldModes, ScaleAllAlikeWhereOnlyTheLowestIsKnown) {
  const auto own = structure_specification(demo_antenna());
  const auto before = held_frequencies(own);
  const auto moved = with_motors_held_frequencies(own, {1.1 * own.locked_rotor_frequency});
  ASSERT_TRUE(moved);
  const auto after = held_frequencies(*moved);
  for (std::size_t j = 0; j < before.size(); ++j) EXPECT_NEAR(after[j] / before[j], 1.1, 1e-9) << j;
}

TEST(MovedHeldModes, MoveAModeBetweenOthersThatAreNotStated) {
  const auto own = structure_specification(demo_antenna());
  const auto moved = with_motors_held_frequencies(own, {2.0, std::nullopt, 4.6});
  ASSERT_TRUE(moved);
  EXPECT_NEAR(held_frequencies(*moved)[2], 4.6, 1e-7);
  EXPECT_EQ(moved->modes[1].frequency, own.modes[1].frequency);
}

TEST(MovedHeldModes, AreNoneWhereNoAntennaHasThem) {
  const auto own = structure_specification(demo_antenna());
  EXPECT_FALSE(with_motors_held_frequencies(own, {}));
  EXPECT_FALSE(with_motors_held_frequencies(own, {std::nullopt, 3.0}));
  EXPECT_FALSE(with_motors_held_frequencies(own, {2.03, 2.2, 2.3}));
}

}  // namespace
}  // namespace boresight::plant
