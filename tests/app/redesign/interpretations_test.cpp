// What a redesign takes for the antenna where the case's numbers contradict one another.
#include <algorithm>
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/oil_case.hpp"
#include <boresight/app/redesign/interpretations.hpp>
#include <boresight/io/case/case_tests.hpp>

namespace boresight::app {
namespace {

using io::leaking_by_flow;
using io::measured_at;
using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;

PlantInterpretation choice_of(const io::Case& antenna, const std::string& name) {
  const auto interpretations = plant_interpretations(antenna);
  const auto found = std::ranges::find_if(interpretations, [&](const PlantInterpretation& choice) {
    return choice.result.name == name;
  });
  if (found == interpretations.end()) throw std::runtime_error("no such choice: " + name);
  return *found;
}

TEST(PlantInterpretations, SayWhetherTheLeakageGoesWithTheOil) {
  const io::Case flow = io::parse_case(leaking_by_flow(measured_at("0.3 Hz")).text(), "case.toml");
  const io::Case rate = io::parse_case(measured_at("0.3 Hz").text(), "case.toml");
  EXPECT_THAT(choice_of(flow, "masses right, stiffness from resonance").result.says,
              AllOf(HasSubstr("oil spring lowered by a factor of 8."),
                    HasSubstr(", and the leakage rate with it, so that"), HasSubstr("0.3 Hz")));
  EXPECT_THAT(choice_of(rate, "masses right, stiffness from resonance").result.says,
              Not(HasSubstr("leakage")));
  const std::string flexible = "oil for the resonance of the flexible antenna";
  for (const auto& edited : {measured_at("0.97 Hz"), leaking_by_flow(measured_at("0.97 Hz"))}) {
    EXPECT_THAT(choice_of(io::parse_case(edited.text(), "case.toml"), flexible).result.says,
                EndsWith("for which the flexible antenna resonates at the measured 0.97 Hz"));
  }
}

TEST(PlantInterpretations, SayWhichRestOnTheRigidFormula) {
  const io::Case antenna = io::read_case(case_path("dss14-70m"));
  for (const std::string name :
       {"masses right, stiffness from resonance", "stiffness right, inertia from resonance",
        "inertia from resonance, no efficiencies", "stiffness right, all masses scaled"}) {
    EXPECT_THAT(choice_of(antenna, name).result.says, HasSubstr("rigid"));
  }
}

TEST(PlantInterpretations, SayHowTheOilSpringIsMoved) {
  const io::Case antenna = io::read_case(case_path("dss14-70m"));
  EXPECT_THAT(choice_of(antenna, "masses right, stiffness from resonance").result.says,
              HasSubstr("oil spring raised by a factor of 1.28 so that"));
}

TEST(PlantInterpretations, SayWhatContradictsBecauseItLeavesNoAntenna) {
  io::Case antenna = io::read_case(case_path("dss14-70m"));
  ASSERT_FALSE(antenna.impulse_results.empty());
  antenna.impulse_results.front().reflected_inertia.value = 0.01;
  const auto none = choice_of(
      antenna, "inertia from impulse, " + antenna.impulse_results.front().name + " friction");
  EXPECT_FALSE(none.antenna);
  EXPECT_THAT(none.result.impossible, HasSubstr("for an antenna of"));
  EXPECT_TRUE(none.result.contradicts);
  EXPECT_FALSE(none.result.other_fractions || none.result.other_attitude);
}

}  // namespace
}  // namespace boresight::app
