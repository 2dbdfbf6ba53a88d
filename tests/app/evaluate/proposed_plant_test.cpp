// The plant of a draw from the ensemble of the antenna as it is, with a proposal applied.
#include <string>

#include <gtest/gtest.h>

#include "io/edited_case.hpp"
#include <boresight/app/evaluate/evaluate_study.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/mission_of.hpp>
#include <boresight/io/proposals/proposed_case.hpp>

namespace boresight::app {
namespace {

const io::Case& as_is() {
  static const io::Case antenna = io::read_case(case_path("dss14-70m"));
  return antenna;
}

io::Case with(const std::string& text) {
  const std::string head = "name = 'a'\ndescription = 'b'\n";
  return apply_proposal(as_is(), io::parse_proposal(head + text, "p.toml")).antenna;
}

TEST(ProposedPlant, DrawsAreFactorsOnWhatTheProposalMakes) {
  const io::Case stiff = with("[oil]\nbulk_modulus = { factor = '2' }\n");
  const auto draw = design::PlantDistribution::of_ranges(mission_of(as_is())).draw(1, 5);
  const auto before = proposed_plant(as_is(), as_is(), draw);
  const auto after = proposed_plant(as_is(), stiff, draw);
  EXPECT_NEAR(after.drive.oil_stiffness / before.drive.oil_stiffness, 2.0, 1e-12);
  EXPECT_NEAR(after.drive.leakage_rate / before.drive.leakage_rate, 2.0, 1e-12);
  EXPECT_DOUBLE_EQ(after.drive.viscous_friction, before.drive.viscous_friction);
  // The friction slope is that of the same curve at another rate of the motor.
  const io::Case geared = with("[[gear_train.stage]]\nnumber = 5\ndriven_teeth = '1508'\n");
  EXPECT_NEAR(
      proposed_plant(as_is(), geared, draw).drive.viscous_friction / before.drive.viscous_friction,
      io::tracking_friction(geared) / io::tracking_friction(as_is()), 1e-12);
}

}  // namespace
}  // namespace boresight::app
