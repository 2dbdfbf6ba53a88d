// What a redesign takes for the antenna where the case's numbers contradict one another.
#include <algorithm>
#include <stdexcept>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/edited_case.hpp"
#include <boresight/app/redesign/choices.hpp>
#include <boresight/io/case/antenna_of.hpp>
#include <boresight/io/case/drive_evidence.hpp>

namespace boresight::app {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;

// The 70-m antenna with a measured frequency.
EditedCase measured_at(const std::string& frequency) {
  EditedCase edited;
  edited.replace("frequency = { value = \"0.97 Hz\"",
                 "frequency = { value = \"" + frequency + "\"");
  return edited;
}

EditedCase leaking_by_flow(EditedCase edited) {
  return edited.replace_line("leakage_rate = ",
                             "leakage_flow = \"6 L/min\"\nleakage_pressure = \"10 MPa\"");
}

PlantChoice choice_of(const io::Case& antenna, const std::string& name) {
  const auto choices = plant_choices(antenna);
  const auto found = std::ranges::find_if(
      choices, [&](const PlantChoice& choice) { return choice.result.name == name; });
  if (found == choices.end()) throw std::runtime_error("no such choice: " + name);
  return *found;
}

plant::Drive drive_of(const PlantChoice& choice) {
  return linear_plant(choice.antenna.value()).drive;
}

TEST(PlantChoices, SoftenTheOilWithTheLeakageThatItsFlowGives) {
  const io::Case flow = io::parse_case(leaking_by_flow(measured_at("0.3 Hz")).text(), "case.toml");
  const io::Case rate = io::parse_case(measured_at("0.3 Hz").text(), "case.toml");
  const auto softer = choice_of(flow, "masses right, stiffness from resonance");
  const auto own = make_plant(flow).drive, drive = drive_of(softer);
  EXPECT_LT(drive.oil_stiffness, 0.2 * own.oil_stiffness);
  // One conductance of leakage.
  EXPECT_NEAR(drive.leakage_rate / drive.oil_stiffness, own.leakage_rate / own.oil_stiffness,
              1e-12 * own.leakage_rate / own.oil_stiffness);
  EXPECT_THAT(softer.result.says,
              AllOf(HasSubstr("oil spring lowered by a factor of 8."),
                    HasSubstr(", and the leakage rate with it, so that"), HasSubstr("0.3 Hz")));
  // A decay that was measured stays.
  const auto measured = choice_of(rate, "masses right, stiffness from resonance");
  EXPECT_EQ(drive_of(measured).leakage_rate, make_plant(rate).drive.leakage_rate);
  EXPECT_THAT(measured.result.says, Not(HasSubstr("leakage")));
}

TEST(PlantChoices, HaveOilByWhichTheFlexibleAntennaHasTheMeasuredFrequency) {
  const std::string name = "oil for the resonance of the flexible antenna";
  const auto frequency = [](const plant::Antenna& antenna) {
    return plant::hydraulic_mode(plant::plant_modes(linear_plant(antenna))).frequency;
  };
  for (const auto& edited : {measured_at("0.97 Hz"), leaking_by_flow(measured_at("0.97 Hz"))}) {
    const io::Case antenna = io::parse_case(edited.text(), "case.toml");
    const auto flexible = choice_of(antenna, name);
    EXPECT_NEAR(frequency(flexible.antenna.value()), 0.97, 1e-6);
    EXPECT_TRUE(flexible.result.contradicts);
    EXPECT_THAT(flexible.result.says, EndsWith("by which the flexible antenna has the measured "
                                               "0.97 Hz"));
  }
  // Neither the case's own oil nor any.
  const io::Case reference = io::read_case(case_path("dss14-70m"));
  const auto own = measured_at(fmt::format("{:.9f} Hz", frequency(antenna_of(reference))));
  for (const auto& edited : {own, measured_at("20 Hz")}) {
    EXPECT_THROW(choice_of(io::parse_case(edited.text(), "case.toml"), name), std::runtime_error);
  }
}

TEST(PlantChoices, SayWhichRestOnTheRigidFormula) {
  const io::Case antenna = io::read_case(case_path("dss14-70m"));
  for (const std::string name :
       {"masses right, stiffness from resonance", "stiffness right, inertia from resonance",
        "inertia from resonance, no efficiencies", "stiffness right, all masses scaled"}) {
    EXPECT_THAT(choice_of(antenna, name).result.says, HasSubstr("rigid masses"));
  }
}

TEST(PlantChoices, SayHowTheOilSpringIsMoved) {
  const io::Case antenna = io::read_case(case_path("dss14-70m"));
  EXPECT_THAT(choice_of(antenna, "masses right, stiffness from resonance").result.says,
              HasSubstr("oil spring raised by a factor of 1.28 so that"));
}

TEST(PlantChoices, KeepSpringsWhereTheAlternativeDoes) {
  const auto with_alternative = [](const std::string& keeps) {
    return io::parse_case(EditedCase()
                              .replace("[[antenna.alternative]]\n",
                                       "[[antenna.alternative]]\nkeeps = \"" + keeps + "\"\n")
                              .text(),
                          "case.toml");
  };
  const auto structure_of = [](const io::Case& antenna) {
    const auto& name = antenna.antenna.alternatives.front().name;
    return linear_plant(choice_of(antenna, "antenna of " + name).antenna.value()).structure;
  };
  const io::Case springs = with_alternative("springs"),
                 frequencies = with_alternative("frequencies");
  const auto own = make_plant(springs).structure, kept = structure_of(springs);
  const auto choice = [](const io::Case& antenna) {
    return choice_of(antenna, "antenna of " + antenna.antenna.alternatives.front().name).result;
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

TEST(PlantChoices, SayWhatContradictsBecauseItLeavesNoAntenna) {
  io::Case antenna = io::read_case(case_path("dss14-70m"));
  ASSERT_FALSE(antenna.impulse_results.empty());
  antenna.impulse_results.front().reflected_inertia.value = 0.01;
  const auto none = choice_of(
      antenna, "inertia from impulse, " + antenna.impulse_results.front().name + " friction");
  EXPECT_FALSE(none.antenna);
  EXPECT_THAT(none.result.impossible, HasSubstr("for an antenna of"));
  EXPECT_TRUE(none.result.contradicts);
  EXPECT_FALSE(none.result.other_shares || none.result.other_attitude);
}

TEST(PlantChoices, KeepTheLeakageOfTheOtherConvention) {
  const io::Case antenna = io::parse_case(leaking_by_flow(EditedCase()).text(), "case.toml");
  const auto other = choice_of(antenna, "stiffness without efficiencies");
  EXPECT_EQ(drive_of(other).leakage_rate, make_plant(antenna).drive.leakage_rate);
  EXPECT_FALSE(other.result.contradicts);
  EXPECT_TRUE(choice_of(antenna, "inertia from resonance, no efficiencies").result.contradicts);
}

}  // namespace
}  // namespace boresight::app
