// What an audit holds the measured resonance, its damping and the oil lines' waves against.
#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/audit/failed_checks.hpp"
#include <boresight/io/case/antenna_of.hpp>
#include <boresight/io/case/case_oil.hpp>
#include <boresight/io/case/case_statements.hpp>
#include <boresight/io/case/case_structure.hpp>
#include <boresight/io/case/case_tests.hpp>

namespace boresight::io {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Truly;

plant::PlantMode mode_of(const Case& antenna) {
  return plant::hydraulic_mode(plant::plant_modes(make_plant(antenna)));
}

Checks damped(const std::string& ratio) {
  return failed(
      EditedCase().replace("[resonance]\n", "[resonance]\ndamping_ratio = \"" + ratio + "\"\n"),
      "resonance_damping");
}

TEST(ResonanceExpected, IsThatOfTheFlexibleAntenna) {
  const Case antenna = read_case(case_path("dss14-70m"));
  const auto found = failed(antenna, "resonance_expected");
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].number("expected").value, mode_of(antenna).frequency, 1e-9);
  EXPECT_NEAR(found[0].number("expected").value, 0.848, 5e-4);
  EXPECT_NEAR(found[0].number("all masses rigid").value, 0.856, 5e-4);
  EXPECT_GT(found[0].number("standard uncertainties").value, 3.0);
  EXPECT_GT(found[0].number("bulk modulus for it").value, 1.229e9);
}

TEST(ResonanceExpected, LeavesAloneAnAntennaThatBendsAsMuchAsItsResonanceSays) {
  // A soft gear spring: far below the rigid masses, where the flexible antenna is.
  Case antenna = read_case(case_path("dss14-70m"));
  antenna.structure->locked_rotor_frequency.value = 0.7;
  const double frequency = mode_of(antenna).frequency;
  EXPECT_LT(frequency, 0.8 * 0.856);
  antenna.resonance->frequency->value = frequency;
  EXPECT_THAT(failed(antenna, "resonance_expected"), IsEmpty());
}

TEST(ResonanceDamping, IsComparedWithTheHydraulicModeByAFactorOfTwo) {
  // The case's mode has 0.152.
  EXPECT_THAT(damped("0.09"), IsEmpty());
  EXPECT_THAT(damped("0.3"), IsEmpty());
  const auto small = damped("0.07");
  ASSERT_EQ(small.size(), 1U);
  EXPECT_EQ(small[0].quantity, "resonance.damping_ratio");
  EXPECT_EQ(small[0].number("measured").value, 0.07);
  EXPECT_NEAR(small[0].number("expected").value, 0.152, 5e-4);
  const auto large = damped("0.31");
  ASSERT_EQ(large.size(), 1U);
  EXPECT_EQ(large[0].numbers.at(0).upper, 2.0 * large[0].numbers.at(1).value);
}

TEST(ResonanceDamping, IsARatioUpToOne) {
  const auto edited =
      EditedCase().replace("[resonance]\n", "[resonance]\ndamping_ratio = \"1.2\"\n");
  EXPECT_THAT(refusal_of(edited.text()), HasSubstr("resonance.damping_ratio: expected"));
}

TEST(WaveSpeed, IsOneForTheOilOfAllLines) {
  Case antenna = read_case(case_path("dss14-70m"));
  const auto found = failed(antenna, "wave_speed");
  ASSERT_FALSE(found.empty());
  for (const auto& check : found) {
    const auto& other = check.numbers.at(1);
    EXPECT_TRUE(other.value < other.lower || other.value > other.upper);
  }
  const double shortest = 2.0 * 13.11 * 46.3;
  EXPECT_THAT(found, Contains(Truly([&](const design::PhysicalCheck& check) {
                return check.quantity == "line.longest.slosh_frequency" &&
                       check.numbers[0].name == "line.shortest.slosh_frequency" &&
                       std::abs(check.numbers[0].value - shortest) < 1e-9;
              })));
  antenna.stated.clear();
  for (auto& line : antenna.oil->lines) {
    line.slosh_frequency.value = shortest / (2.0 * line.length.value);
  }
  EXPECT_THAT(failed(antenna, "wave_speed"), IsEmpty());
}

}  // namespace
}  // namespace boresight::io
