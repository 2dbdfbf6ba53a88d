#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/edited_case.hpp"
#include <boresight/io/case/antenna_of.hpp>
#include <boresight/io/case/case_drive.hpp>
#include <boresight/io/case/case_mechanics.hpp>
#include <boresight/io/case/case_structure.hpp>
#include <boresight/io/case/case_wind.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/movable_numbers.hpp>

namespace boresight::io {
namespace {

Case own_case() {
  return read_case(case_path("dss14-70m"));
}

MovableNumber number_of(const std::vector<MovableNumber>& numbers, const std::string& key) {
  const auto found = std::ranges::find_if(
      numbers, [&](const MovableNumber& one) { return one.quantity.key == key; });
  if (found == numbers.end()) throw std::runtime_error("no number " + key);
  return *found;
}

double wind_fractions(const Case& antenna) {
  double sum = antenna.structure->bull_gear_wind_fraction.value;
  for (const auto& mode : antenna.structure->modes) sum += mode.wind_fraction.value;
  return sum;
}

double boresight_fractions(const Case& antenna) {
  double sum = antenna.structure->bull_gear_beam_weight.value;
  for (const auto& mode : antenna.structure->modes) sum += mode.beam_weight.value;
  return sum;
}

TEST(MovableNumbers, MoveByWhatTheCaseSaysOrATenth) {
  const Case antenna =
      parse_case(EditedCase()
                     .replace_line("air_density = {",
                                   "air_density = { value = \"1.1 kg/m3\", uncertainty = \"3 %\" }")
                     .text(),
                 "case.toml");
  const auto numbers = movable_numbers(antenna);
  const auto density = number_of(numbers, "wind.air_density");
  EXPECT_FALSE(density.unstated);
  EXPECT_NEAR(density.moved_by, 0.033, 1e-12);
  EXPECT_NEAR(moved(antenna, density, true).wind->air_density.value, 1.133, 1e-12);
  EXPECT_NEAR(moved(antenna, density, false).wind->air_density.value, 1.067, 1e-12);
  const auto coefficient = number_of(numbers, "wind.torque_coefficient");
  EXPECT_TRUE(coefficient.unstated);
  EXPECT_DOUBLE_EQ(coefficient.moved_by, 0.1 * antenna.wind->torque_coefficient.value);
  EXPECT_FALSE(coefficient.fraction_of_mode);
  // The gusts' strength is kept as the plant takes it.
  const auto drag = number_of(numbers, "wind.surface_drag");
  EXPECT_NEAR(moved(antenna, drag, true).wind->gusts.surface_drag,
              1.1 * antenna.wind->gusts.surface_drag, 1e-12);
}

TEST(MovableNumbers, LeaveOutWhatRecordsGave) {
  Case antenna = own_case();
  const auto has_inertia = [&] {
    const auto numbers = movable_numbers(antenna);
    return std::ranges::any_of(
        numbers, [](const MovableNumber& one) { return one.quantity.key == "antenna.inertia"; });
  };
  EXPECT_TRUE(has_inertia());
  antenna.antenna->inertia.text.clear();
  EXPECT_FALSE(has_inertia());
}

// Where the case states the gear train's stiffness, that is what is moved, by a tenth of it.
TEST(MovableNumbers, MoveTheStiffnessThatTheCaseStates) {
  const Case own = own_case();
  const double stiffness = make_plant(own).structure.gear_stiffness * std::pow(gear_ratio(own), 2);
  const auto with = [](double of) {
    return parse_case(EditedCase()
                          .replace_line("locked_rotor_frequency",
                                        fmt::format("gear_stiffness = {{ value = \"{:.15g} "
                                                    "N.m/rad\", basis = \"assumed\", source = "
                                                    "\"drawing\" }}",
                                                    of))
                          .text(),
                      "case.toml");
  };
  const Case antenna = with(stiffness);
  const auto number = number_of(movable_numbers(antenna), "structure.gear_stiffness");
  EXPECT_EQ(number.quantity.kind, Kind::stiffness);
  EXPECT_NEAR(number.moved_by, 0.1 * stiffness, 1e-9 * stiffness);
  const auto stiffer = make_plant(moved(antenna, number, true)).structure.gear_stiffness;
  EXPECT_NEAR(stiffer, make_plant(with(1.1 * stiffness)).structure.gear_stiffness, 1e-6 * stiffer);
}

// More of the beam on the lowest mode, less on all others in proportion.
TEST(MovableNumbers, KeepTheSumOfFractions) {
  const Case antenna = own_case();
  const auto weight = number_of(movable_numbers(antenna), "structure.mode[0].beam_weight");
  EXPECT_EQ(weight.fraction_of_mode, 0U);
  const Case weighted = moved(antenna, weight, true);
  const double maximum = weight.range.value().second;
  EXPECT_NEAR(weighted.structure->modes[0].beam_weight.value, maximum, 1e-12);
  EXPECT_NEAR(boresight_fractions(weighted), boresight_fractions(antenna), 1e-12);
  EXPECT_EQ(wind_fractions(weighted), wind_fractions(antenna));
  const double left = (1.0 - maximum) / (1.0 - antenna.structure->modes[0].beam_weight.value);
  for (std::size_t i = 1; i < antenna.structure->modes.size(); ++i) {
    EXPECT_NEAR(weighted.structure->modes[i].beam_weight.value,
                left * antenna.structure->modes[i].beam_weight.value, 1e-12);
  }
}

// What the dish loses of the wind the light parts do not gain.
TEST(MovableNumbers, GiveWhatAFractionLosesToTheOthersInertias) {
  const Case antenna = own_case();
  const auto wind = number_of(movable_numbers(antenna), "structure.mode[0].wind_fraction");
  const Case lighter = moved(antenna, wind, false);
  const auto &before = antenna.structure->modes, &after = lighter.structure->modes;
  const double lost = before[0].wind_fraction.value - wind.range.value().first;
  ASSERT_GT(lost, 0.1);
  EXPECT_NEAR(wind_fractions(lighter), wind_fractions(antenna), 1e-12);
  const double others = 1.0 - before[0].inertia_fraction.value;
  for (std::size_t i = 1; i < before.size(); ++i) {
    EXPECT_NEAR(after[i].wind_fraction.value - before[i].wind_fraction.value,
                lost * before[i].inertia_fraction.value / others, 1e-12);
  }
}

TEST(MovableNumbers, MoveGuessedSharesToTheInertia) {
  const Case antenna =
      parse_case(EditedCase()
                     .replace("wind_fraction = { value = \"0.75\", basis = \"assumed\"",
                              "wind_fraction = { value = \"0.75\", uncertainty = \"4 %\", basis = "
                              "\"assumed\"")
                     .text(),
                 "case.toml");
  const auto numbers = movable_numbers(antenna);
  const auto range = [&](const std::string& key) { return number_of(numbers, key).range; };
  // 0.80 of the beam on 0.62 of the inertia, and 0.15 of the wind on 0.14: half of either is more.
  EXPECT_NEAR(range("structure.mode[0].beam_weight").value().first, 0.4, 1e-12);
  EXPECT_NEAR(range("structure.mode[0].beam_weight").value().second, 1.0, 1e-12);
  EXPECT_NEAR(range("structure.mode[1].wind_fraction").value().first, 0.075, 1e-12);
  // The bull gear has 0.13 of the inertia and no wind, and cannot have less.
  EXPECT_EQ(range("structure.bull_gear_wind_fraction").value().first, 0.0);
  EXPECT_NEAR(range("structure.bull_gear_wind_fraction").value().second, 0.13, 1e-12);
  EXPECT_FALSE(range("structure.mode[0].wind_fraction"));
  // A weight of -0.15 moves by a tenth.
  EXPECT_FALSE(range("structure.mode[2].beam_weight"));
}

TEST(MovableNumbers, MoveTheLeakageRateThatAFlowMakes) {
  const auto with = [](const std::string& volume) {
    return parse_case(EditedCase()
                          .replace("leakage_rate = { value = \"1.219 1/s\"",
                                   "leakage_pressure = \"7 MPa\"\nleakage_flow = { value = \"1.1 "
                                   "L/min\"")
                          .replace("volume_1 = { value = \"0.02455 m3\"",
                                   "volume_1 = { value = \"" + volume + "\"")
                          .text(),
                      "case.toml");
  };
  const Case antenna = with("0.02455 m3");
  // Its uncertainty is 1 %.
  const Case larger = moved(antenna, number_of(movable_numbers(antenna), "oil.volume_1"), true);
  const double expected = with("0.0247955 m3").drive->leakage_rate.value;
  EXPECT_NE(expected, antenna.drive->leakage_rate.value);
  EXPECT_NEAR(larger.drive->leakage_rate.value, expected, 1e-6 * expected);
}

}  // namespace
}  // namespace boresight::io
