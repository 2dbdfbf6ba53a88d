// What of the structure an audit holds against models, stiffness and fractions of wind and beam.
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/audit/failed_checks.hpp"
#include <boresight/design/problem/static_bending.hpp>
#include <boresight/io/case/antenna_of.hpp>
#include <boresight/io/case/case_campaign.hpp>
#include <boresight/io/case/case_mechanics.hpp>
#include <boresight/io/case/case_structure.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/mission_of.hpp>
#include <boresight/plant/antenna/motors_held_modes.hpp>

namespace boresight::io {
namespace {

using testing::IsEmpty;

TEST(StructuralFractions, SayWhatASoftPartUnderTheWindMeans) {
  const std::string check = "structural_shares";
  EXPECT_THAT(failed(EditedCase(), check), IsEmpty());
  const Case antenna = parse_case(
      EditedCase()
          .replace("inertia_fraction = { value = \"0.62\"", "inertia_fraction = { value = \"0.18\"")
          .text(),
      "case.toml");
  const auto found = failed(antenna, check);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].quantity, "structure.mode[0].wind_fraction");
  ASSERT_EQ(found[0].entries.size(), 4U);
  EXPECT_EQ(found[0].entries[2].id, "structure.mode[0].beam_weight");
  EXPECT_EQ(found[0].entries[3].value, 0.18);
  ASSERT_EQ(found[0].numbers.size(), 2U);
  EXPECT_NEAR(found[0].numbers[0].value, std::abs(static_bending(make_problem(antenna))), 1e-12);
  // A part under little wind bends little.
  EXPECT_LT(found[0].numbers[1].value, 0.5 * found[0].numbers[0].value);
}

// N m/rad at the antenna's axis.
double gear_train_of(const Case& antenna, std::size_t solution = 0) {
  return linear_plant(antennas_of(antenna).at(solution)).structure.gear_stiffness *
         std::pow(gear_ratio(antenna), 2);
}

// A case with the stiffness of its gear train beside its frequencies, so many times its own.
Case with_gear_train(EditedCase edited, double times, const std::string& uncertainty = "",
                     std::size_t solution = 0) {
  const double own = gear_train_of(parse_case(edited.text(), "case.toml"), solution);
  edited.replace("\ngear_damping_ratio =",
                 fmt::format("\ngear_stiffness = {{ value = \"{:.17g} N.m/rad\"{} }}"
                             "\ngear_damping_ratio =",
                             times * own, uncertainty));
  return parse_case(edited.text(), "case.toml");
}

TEST(GearStiffness, AgreesWithinAThirdOrItsUncertainty) {
  const std::string check = "gear_stiffness";
  EXPECT_THAT(failed(EditedCase(), check), IsEmpty());
  for (const double times : {1.0, 1.28, 1.0 / 1.28}) {
    EXPECT_THAT(failed(with_gear_train(EditedCase(), times), check), IsEmpty());
  }
  EXPECT_EQ(failed(with_gear_train(EditedCase(), 1.32), check).size(), 1U);
  const auto found = [&](double times, const std::string& uncertainty, bool inertia_exact) {
    Case antenna = with_gear_train(EditedCase(), times, ", uncertainty = \"" + uncertainty + "\"");
    if (inertia_exact) antenna.antenna->inertia.uncertainty_given = false;
    return failed(antenna, check).size();
  };
  EXPECT_EQ(found(1.04, "1 %", true), 0U);
  EXPECT_EQ(found(1.06, "1 %", true), 1U);
  EXPECT_EQ(found(1.14, "5 %", true), 0U);
  EXPECT_EQ(found(1.16, "5 %", true), 1U);
  EXPECT_EQ(found(1.0 / 1.16, "5 %", true), 1U);
  // That of the inertia, 10 %, is in the plant's.
  EXPECT_EQ(found(1.29, "1 %", false), 0U);
  EXPECT_EQ(found(1.31, "1 %", false), 1U);
}

TEST(GearStiffness, IsMadeByAnotherFrequencyOfTheHeaviestMode) {
  for (const double times : {2.0, 0.5}) {
    Case antenna = with_gear_train(EditedCase(), times);
    const auto found = failed(antenna, "gear_stiffness");
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].quantity, "structure.gear_stiffness");
    ASSERT_EQ(found[0].numbers.size(), 3U);
    const double stated = found[0].numbers[0].value, frequency = found[0].numbers[2].value;
    EXPECT_NEAR(found[0].numbers[1].value / gear_train_of(antenna), 1.0, 1e-9);
    EXPECT_EQ(found[0].explanation, "heaviest_mode");
    EXPECT_EQ(found[0].entries.at(0).id, "structure.mode[0].frequency");
    EXPECT_EQ(frequency > 2.4, times < 1.0);
    antenna.structure->modes.at(0).frequency.value = frequency;
    EXPECT_NEAR(gear_train_of(antenna) / stated, 1.0, 1e-9);
    EXPECT_THAT(failed(antenna, "gear_stiffness"), IsEmpty());
  }
}

TEST(GearStiffness, MayBeMadeByNoFrequencyOfThatMode) {
  // Softer than with that mode rigid, and another unit.
  for (const double times : {0.4, 1e6}) {
    const auto found = failed(with_gear_train(EditedCase(), times), "gear_stiffness");
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].explanation, "inputs");
    EXPECT_EQ(found[0].numbers.size(), 2U);
  }
}

TEST(GearStiffness, TellsWhichAntennaHasTheFrequenciesWithTheMotorsHeld) {
  EditedCase edited;
  const std::string text = edited.text();
  const std::size_t first = text.find("[[structure.mode]]");
  edited.replace(text.substr(first, text.find("\n# What a simulated test needs") - first),
                 "[[structure.mode]]\nfrequency = \"4 Hz\"\ndamping_ratio = \"0.01\"\n"
                 "inertia_fraction = \"0.2\"\nwind_fraction = \"1\"\nbeam_weight = \"0.95\"\n");
  edited.replace("lowest_predicted_axis = \"azimuth\"",
                 "lowest_predicted_axis = \"azimuth\"\nmode_frequencies = \"motors_held\"");
  EXPECT_THAT(failed(with_gear_train(edited, 1.0), "gear_stiffness"), IsEmpty());
  const auto found = failed(with_gear_train(edited, 1.0, "", 1), "gear_stiffness");
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].explanation, "other_antenna");
  EXPECT_EQ(found[0].entries.at(0).value, 1.0);
  EXPECT_EQ(failed(with_gear_train(edited, 10.0), "gear_stiffness").at(0).explanation,
            "held_frequencies");
  const auto both = failed(edited, "motors_held");
  ASSERT_EQ(both.size(), 1U);
  ASSERT_EQ(both[0].numbers.size(), 2U);
  EXPECT_LT(both[0].numbers[0].value, both[0].numbers[1].value) << "the softest first";
}

TEST(StructuralBound, IsOfTheCasesAxis) {
  Case antenna = read_case(case_path("dss14-70m"));
  const auto found = failed(antenna, "structural_bound");
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].number("lowest predicted").value, 1.75, 1e-12);
  antenna.structure->lowest_predicted_axis = antenna.axis;
  EXPECT_THAT(failed(antenna, "structural_bound"), IsEmpty());
}

TEST(StructuralPredictions, AgreeWithinATwentieth) {
  Case antenna = read_case(case_path("dss14-70m"));
  const auto held = plant::motors_held_modes(make_plant(antenna).structure);
  Quantity predicted;
  predicted.key = "structure.prediction[0]";
  antenna.campaign->locked_rotor_frequencies = {predicted};
  const auto apart = [&](double times) {
    antenna.campaign->locked_rotor_frequencies[0].value = times * held.at(0).frequency;
    return failed(antenna, "structural_predictions");
  };
  EXPECT_THAT(apart(1.04), IsEmpty());
  EXPECT_THAT(apart(0.96), IsEmpty());
  const auto found = apart(1.06);
  ASSERT_EQ(found.size(), 1U);
  ASSERT_EQ(found[0].numbers.size(), 2U);
  EXPECT_NEAR(found[0].numbers[1].value, held.at(0).frequency, 1e-9);
  EXPECT_LT(found[0].numbers[1].value, found[0].numbers[1].lower);
}

}  // namespace
}  // namespace boresight::io
