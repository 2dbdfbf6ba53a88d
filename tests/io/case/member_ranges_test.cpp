// What ensemble members are drawn from, where a case states uncertainties.
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "io/edited_case.hpp"
#include "io/uncertain_case.hpp"
#include <boresight/io/case/member_ranges.hpp>

namespace boresight::io {
namespace {

const double root_of_three = std::sqrt(3.0);

TEST(MemberRanges, AreAtLeastAsWideAsWhatTheCaseStates) {
  const auto plain = member_ranges(read_case(case_path("dss14-70m")));
  EXPECT_EQ(plain.structure_frequency.lower, 0.95);
  EXPECT_EQ(plain.structure_frequency.upper, 1.05);
  EXPECT_EQ(plain.oil_stiffness.lower, 0.8) << "1.5 % of the bulk modulus are less";
  const auto wide = member_ranges(uncertain_case("10 %", "50 %"));
  EXPECT_NEAR(wide.structure_frequency.lower, 1.0 - 0.1 * root_of_three, 1e-12);
  EXPECT_NEAR(wide.structure_frequency.upper, 1.0 + 0.1 * root_of_three, 1e-12);
  EXPECT_NEAR(wide.leakage_rate.lower, 1.219 * (1.0 - 0.5 * root_of_three), 1e-12);
  EXPECT_NEAR(wide.leakage_rate.upper, 1.219 * (1.0 + 0.5 * root_of_three), 1e-12);
  EXPECT_EQ(wide.viscous_friction.upper, plain.viscous_friction.upper);
  const auto narrow = member_ranges(uncertain_case("1 %", "10 %"));
  EXPECT_EQ(narrow.structure_frequency.lower, 0.95);
  EXPECT_EQ(narrow.leakage_rate.lower, plain.leakage_rate.lower);
  EXPECT_NEAR(narrow.leakage_rate.upper, 1.219 * (1.0 + 0.1 * root_of_three), 1e-12);
  EXPECT_EQ(member_ranges(uncertain_case("90 %", "10 %")).structure_frequency.lower, 0.05);
}

TEST(MemberRanges, OfTheEnsembleHold) {
  const Case antenna = uncertain_case(
      "10 %", "10 %", "[ensemble]\nstructure_frequency = { lower = \"0.95\", upper = \"1.05\" }\n");
  EXPECT_EQ(member_ranges(antenna).structure_frequency.lower, 0.95);
}

}  // namespace
}  // namespace boresight::io
