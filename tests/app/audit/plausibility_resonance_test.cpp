#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/edited_case.hpp"
#include <boresight/app/audit/case_graph.hpp>
#include <boresight/app/audit/plausibility.hpp>
#include <boresight/io/case/antenna_of.hpp>

namespace boresight::app {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

std::optional<Implausibility> found_in(const io::Case& antenna, const std::string& check) {
  for (const Implausibility& one : implausibilities(antenna, case_graph(antenna))) {
    if (one.check == check) return one;
  }
  return std::nullopt;
}

std::optional<Implausibility> damped(const std::string& ratio) {
  const auto edited =
      EditedCase().replace("[resonance]\n", "[resonance]\ndamping_ratio = \"" + ratio + "\"\n");
  return found_in(io::parse_case(edited.text(), "case.toml"), "resonance damping");
}

plant::PlantMode mode_of(const io::Case& antenna) {
  return plant::hydraulic_mode(plant::plant_modes(make_plant(antenna)));
}

TEST(ResonanceExpected, IsThatOfTheFlexibleAntenna) {
  const io::Case antenna = io::read_case(case_path("dss14-70m"));
  const auto found = found_in(antenna, "resonance expected");
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->numbers.at(1).value, mode_of(antenna).frequency, 1e-9);
  EXPECT_GT(found->numbers.at(2).value, found->numbers.at(1).value) << "masses rigid";
  EXPECT_THAT(found->reasoning,
              AllOf(HasSubstr("0.848 Hz of the case's flexible antenna"),
                    HasSubstr("All masses rigid on the oil spring would make it 0.856 Hz"),
                    HasSubstr("a bulk modulus of")));
}

TEST(ResonanceExpected, LeavesAloneAnAntennaThatBendsAsMuchAsItsResonanceSays) {
  // A soft gear spring: far below the rigid masses, where the flexible antenna is.
  io::Case antenna = io::read_case(case_path("dss14-70m"));
  antenna.structure.locked_rotor_frequency.value = 0.7;
  const double frequency = mode_of(antenna).frequency;
  EXPECT_LT(frequency, 0.8 * 0.856);
  antenna.resonance_frequency->value = frequency;
  EXPECT_FALSE(found_in(antenna, "resonance expected"));
}

TEST(ResonanceDamping, IsComparedWithTheHydraulicModeByAFactorOfTwo) {
  // The case's mode has 0.152.
  EXPECT_FALSE(damped("0.09"));
  EXPECT_FALSE(damped("0.3"));
  const auto small = damped("0.07");
  ASSERT_TRUE(small);
  EXPECT_EQ(small->id, "resonance.damping_ratio");
  EXPECT_THAT(small->reasoning,
              AllOf(HasSubstr("damping ratio 0.152"), HasSubstr("measured is 0.07"),
                    HasSubstr("leakage or friction is smaller than stated."),
                    Not(HasSubstr("dry friction"))));
  const auto large = damped("0.31");
  ASSERT_TRUE(large);
  EXPECT_THAT(large->reasoning,
              HasSubstr("larger than stated, or what no linear plant has damped that test"));
}

TEST(ResonanceDamping, TellsLittleOfLeakageWhereTheGearSpringIsSoft) {
  const auto edited =
      EditedCase().replace("[resonance]\n", "[resonance]\ndamping_ratio = \"0.3\"\n");
  io::Case antenna = io::parse_case(edited.text(), "case.toml");
  antenna.structure.locked_rotor_frequency.value = 0.2;
  const auto found = found_in(antenna, "resonance damping");
  ASSERT_TRUE(found);
  EXPECT_THAT(found->reasoning, AllOf(HasSubstr("The hydraulic mode of the case has"),
                                      HasSubstr("% of that mode's elastic energy is in the oil")));
  EXPECT_THAT(damped("0.07")->reasoning, Not(HasSubstr("elastic energy")));
  antenna.resonance_of_oil = true;
  antenna.resonance_damping->value = 1.0;
  const auto of_oil = found_in(antenna, "resonance damping");
  ASSERT_TRUE(of_oil);
  EXPECT_THAT(of_oil->reasoning, HasSubstr("The mode of most oil of the case has"));
}

// The motors and the gear train alone ring on the oil: that is no antenna without inertia.
TEST(InertiaRemainder, IsNoneOfAResonanceOfTheOilAlone) {
  io::Case antenna = io::read_case(case_path("dss14-70m"));
  std::erase_if(antenna.stated, [](const io::StatedEntry& entry) {
    return entry.quantity == "resonance.reflected_inertia";
  });
  antenna.impulse_results.clear();
  antenna.structure.locked_rotor_frequency.value = 0.2;
  const auto modes = plant::plant_modes(make_plant(antenna));
  antenna.resonance_frequency->value = plant::mode_of_oil(modes).frequency;
  antenna.resonance_of_oil = true;
  EXPECT_FALSE(found_in(antenna, "inertia remainder"));
  antenna.structure.locked_rotor_frequency.value = 2.0;
  antenna.resonance_of_oil = false;
  EXPECT_TRUE(found_in(antenna, "inertia remainder"));
}

TEST(ResonanceDamping, IsARatioUpToOne) {
  const auto edited =
      EditedCase().replace("[resonance]\n", "[resonance]\ndamping_ratio = \"1.2\"\n");
  EXPECT_THAT(refusal_of(edited.text()), HasSubstr("resonance.damping_ratio: expected"));
}

}  // namespace
}  // namespace boresight::app
