// What the numbers of a case may mean where they contradict one another.
#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/oil_case.hpp"
#include <boresight/io/audit/antenna_readings.hpp>
#include <boresight/io/case/antenna_of.hpp>
#include <boresight/io/case/case_mechanics.hpp>
#include <boresight/io/case/case_structure.hpp>
#include <boresight/io/case/case_tests.hpp>
#include <boresight/io/case/drive_evidence.hpp>
#include <boresight/io/case/guessed_fractions.hpp>

namespace boresight::io {
namespace {

using testing::IsEmpty;

AntennaReading reading_of(const Case& antenna, const std::string& name) {
  const auto readings = antenna_readings(antenna);
  const auto found = std::ranges::find_if(
      readings, [&](const AntennaReading& reading) { return reading.name == name; });
  if (found == readings.end()) throw std::runtime_error("no such reading: " + name);
  return *found;
}

plant::Drive drive_of(const AntennaReading& reading) {
  return linear_plant(reading.antenna.value()).drive;
}

TEST(AntennaReadings, SoftenTheOilWithTheLeakageThatItsFlowGives) {
  const Case flow = parse_case(leaking_by_flow(measured_at("0.3 Hz")).text(), "case.toml");
  const Case rate = parse_case(measured_at("0.3 Hz").text(), "case.toml");
  const auto softer = reading_of(flow, "masses right, stiffness from resonance");
  const auto own = make_plant(flow).drive, drive = drive_of(softer);
  EXPECT_LT(drive.oil_stiffness, 0.2 * own.oil_stiffness);
  // One conductance of leakage.
  EXPECT_NEAR(drive.leakage_rate / drive.oil_stiffness, own.leakage_rate / own.oil_stiffness,
              1e-12 * own.leakage_rate / own.oil_stiffness);
  // A decay that was measured stays.
  const auto measured = reading_of(rate, "masses right, stiffness from resonance");
  EXPECT_EQ(drive_of(measured).leakage_rate, make_plant(rate).drive.leakage_rate);
}

TEST(AntennaReadings, HaveOilByWhichTheFlexibleAntennaHasTheMeasuredFrequency) {
  const std::string name = "oil for the resonance of the flexible antenna";
  const auto frequency = [](const plant::Antenna& antenna) {
    return plant::hydraulic_mode(plant::plant_modes(linear_plant(antenna))).frequency;
  };
  for (const auto& edited : {measured_at("0.97 Hz"), leaking_by_flow(measured_at("0.97 Hz"))}) {
    const Case antenna = parse_case(edited.text(), "case.toml");
    const auto flexible = reading_of(antenna, name);
    EXPECT_NEAR(frequency(flexible.antenna.value()), 0.97, 1e-6);
    EXPECT_TRUE(flexible.contradicts);
  }
  // Neither the case's own oil nor any.
  const Case reference = read_case(case_path("dss14-70m"));
  const auto own = measured_at(fmt::format("{:.9f} Hz", frequency(antenna_of(reference))));
  for (const auto& edited : {own, measured_at("20 Hz")}) {
    EXPECT_THROW(reading_of(parse_case(edited.text(), "case.toml"), name), std::runtime_error);
  }
}

TEST(AntennaReadings, KeepSpringsWhereTheAlternativeDoes) {
  const auto with_alternative = [](const std::string& keeps) {
    return parse_case(EditedCase()
                          .replace("[[antenna.alternative]]\n",
                                   "[[antenna.alternative]]\nkeeps = \"" + keeps + "\"\n")
                          .text(),
                      "case.toml");
  };
  const auto structure_of = [](const Case& antenna) {
    const auto& name = antenna.antenna->alternatives.front().name;
    return linear_plant(reading_of(antenna, "antenna of " + name).antenna.value()).structure;
  };
  const Case springs = with_alternative("springs"), frequencies = with_alternative("frequencies");
  const auto own = make_plant(springs).structure, kept = structure_of(springs);
  const auto choice = [](const Case& antenna) {
    return reading_of(antenna, "antenna of " + antenna.antenna->alternatives.front().name);
  };
  EXPECT_TRUE(choice(springs).other_attitude && !choice(springs).contradicts);
  EXPECT_TRUE(choice(frequencies).contradicts && !choice(frequencies).other_attitude);
  // Nor is it another reading of the inertia.
  EXPECT_EQ(make_evidence(springs).antenna.size(), 1U);
  EXPECT_EQ(make_evidence(frequencies).antenna.size(), 2U);
  const double lighter = plant::antenna_inertia(kept) / plant::antenna_inertia(own);
  EXPECT_LT(lighter, 0.95);
  EXPECT_NEAR(kept.gear_stiffness, own.gear_stiffness, 1e-12 * own.gear_stiffness);
  EXPECT_NEAR(kept.modes[0].stiffness, own.modes[0].stiffness, 1e-12 * own.modes[0].stiffness);
  EXPECT_NEAR(structure_of(frequencies).gear_stiffness, lighter * own.gear_stiffness,
              1e-12 * own.gear_stiffness);
}

TEST(AntennaReadings, HaveNoAntennaWhereATestLeavesNone) {
  Case antenna = read_case(case_path("dss14-70m"));
  ASSERT_FALSE(antenna.impulse_results.empty());
  antenna.impulse_results.front().reflected_inertia.value = 0.01;
  const auto none = reading_of(
      antenna, "inertia from impulse, " + antenna.impulse_results.front().name + " friction");
  EXPECT_FALSE(none.antenna);
  ASSERT_TRUE(none.tested.has_value());
  EXPECT_LT(none.tested->left(), 0.05 * none.tested->stated);
  EXPECT_TRUE(none.contradicts);
  EXPECT_FALSE(none.other_fractions || none.other_attitude);
}

TEST(AntennaReadings, KeepTheLeakageOfTheOtherConvention) {
  const Case antenna = parse_case(leaking_by_flow(EditedCase()).text(), "case.toml");
  const auto other = reading_of(antenna, "stiffness without efficiencies");
  EXPECT_EQ(drive_of(other).leakage_rate, make_plant(antenna).drive.leakage_rate);
  EXPECT_FALSE(other.contradicts);
  EXPECT_TRUE(reading_of(antenna, "inertia from resonance, no efficiencies").contradicts);
}

// The 70-m antenna: all fractions assumed, the third mode's `beam_weight` below 0.
Case guessing_antenna() {
  return read_case(case_path("dss14-70m"));
}

std::vector<std::string> share_readings(const Case& antenna) {
  std::vector<std::string> names;
  for (const auto& reading : antenna_readings(antenna)) {
    if (!reading.other_fractions) continue;
    names.push_back(reading.name);
    EXPECT_FALSE(reading.contradicts);
  }
  return names;
}

TEST(AntennaReadings, TakeOtherSharesOfGuessesOnly) {
  EXPECT_THAT(share_readings(guessing_antenna()),
              testing::ElementsAre("wind and boresight fractions as inertia",
                                   "wind and boresight fractions all at one"));
  // None where no fraction is assumed, and not the case's own again.
  Case known = guessing_antenna(), own = guessing_antenna();
  const auto fractions = [](Case& antenna) {
    std::vector<Quantity*> all{&antenna.structure->bull_gear_wind_fraction,
                               &antenna.structure->bull_gear_beam_weight};
    for (auto& mode : antenna.structure->modes) {
      all.insert(all.end(), {&mode.wind_fraction, &mode.beam_weight});
    }
    return all;
  };
  for (Quantity* fraction : fractions(known)) fraction->basis = Basis::measured;
  EXPECT_THAT(share_readings(known), IsEmpty());
  double rest = 1.0;
  for (auto& mode : own.structure->modes) {
    rest -= mode.inertia_fraction.value;
    mode.wind_fraction.value = mode.beam_weight.value = mode.inertia_fraction.value;
  }
  own.structure->bull_gear_wind_fraction.value = own.structure->bull_gear_beam_weight.value = rest;
  EXPECT_FALSE(moves_guessed_fractions(*own.structure, GuessedFractions::as_inertia));
  EXPECT_THAT(share_readings(own), testing::ElementsAre("wind and boresight fractions all at one"));
  // A guess that says how far it may be off is one of the ensemble's, not of these.
  for (Quantity* fraction : fractions(own)) fraction->uncertainty_given = true;
  EXPECT_THAT(share_readings(own), IsEmpty());
}

}  // namespace
}  // namespace boresight::io
