// What the plants that may be the true one are drawn from, where a case states uncertainties.
#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/edited_case.hpp"
#include <boresight/app/audit/case_graph.hpp>
#include <boresight/app/audit/plausibility.hpp>
#include <boresight/io/case/member_ranges.hpp>

namespace boresight::app {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const double root_of_three = std::sqrt(3.0);

// The 70-m antenna with uncertainties of the locked rotor and of leakage, and another [ensemble].
io::Case uncertain(const std::string& of_rotor, const std::string& of_leakage,
                   const std::string& ensemble = "") {
  EditedCase edited;
  edited.replace(
      "\nlocked_rotor_frequency = { value = \"2.0 Hz\"",
      "\nlocked_rotor_frequency = { value = \"2.0 Hz\", uncertainty = \"" + of_rotor + "\"");
  edited.replace("\nleakage_rate = { value = \"1.219 1/s\"",
                 "\nleakage_rate = { value = \"1.219 1/s\", uncertainty = \"" + of_leakage + "\"");
  return io::parse_case(edited.text() + "\n" + ensemble, "case.toml");
}

std::string said_of(const io::Case& antenna) {
  for (const auto& one : implausibilities(antenna, case_graph(antenna))) {
    if (one.check == "ensemble range") return one.reasoning;
  }
  return "nothing";
}

TEST(MemberRanges, AreAtLeastAsWideAsWhatTheCaseStates) {
  const auto plain = member_ranges(io::read_case(case_path("dss14-70m")));
  EXPECT_EQ(plain.structure_frequency.lower, 0.95);
  EXPECT_EQ(plain.structure_frequency.upper, 1.05);
  EXPECT_EQ(plain.oil_stiffness.lower, 0.8) << "1.5 % of the bulk modulus are less";
  const auto wide = member_ranges(uncertain("10 %", "50 %"));
  EXPECT_NEAR(wide.structure_frequency.lower, 1.0 - 0.1 * root_of_three, 1e-12);
  EXPECT_NEAR(wide.structure_frequency.upper, 1.0 + 0.1 * root_of_three, 1e-12);
  EXPECT_NEAR(wide.leakage_rate.lower, 1.219 * (1.0 - 0.5 * root_of_three), 1e-12);
  EXPECT_NEAR(wide.leakage_rate.upper, 1.219 * (1.0 + 0.5 * root_of_three), 1e-12);
  EXPECT_EQ(wide.viscous_friction.upper, plain.viscous_friction.upper);
  const auto narrow = member_ranges(uncertain("1 %", "10 %"));
  EXPECT_EQ(narrow.structure_frequency.lower, 0.95);
  EXPECT_EQ(narrow.leakage_rate.lower, plain.leakage_rate.lower);
  EXPECT_NEAR(narrow.leakage_rate.upper, 1.219 * (1.0 + 0.1 * root_of_three), 1e-12);
  EXPECT_EQ(member_ranges(uncertain("90 %", "10 %")).structure_frequency.lower, 0.05);
}

TEST(MemberRanges, OfTheEnsembleHoldAndTheAuditSaysWhereTheyAreNarrow) {
  const std::string stated =
      "[ensemble]\nstructure_frequency = { lower = \"0.95\", upper = \"1.05\" }\n";
  const io::Case antenna = uncertain("10 %", "10 %", stated);
  EXPECT_EQ(member_ranges(antenna).structure_frequency.lower, 0.95);
  EXPECT_THAT(said_of(antenna),
              AllOf(HasSubstr("ensemble.structure_frequency of 0.95 to 1.05"),
                    HasSubstr("structure.locked_rotor_frequency leaves 0.827 to 1.17")));
  EXPECT_EQ(said_of(uncertain("1 %", "10 %", stated)), "nothing");
  EXPECT_EQ(said_of(uncertain("10 %", "10 %")), "nothing");
}

}  // namespace
}  // namespace boresight::app
