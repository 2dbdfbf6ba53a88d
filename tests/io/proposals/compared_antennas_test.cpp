#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/edited_case.hpp"
#include "refused_call.hpp"
#include <boresight/io/case/mission_of.hpp>
#include <boresight/io/proposals/compared_antennas.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::io {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

const Case& as_stated() {
  static const Case antenna = read_case(case_path("dss14-70m"));
  return antenna;
}

Proposal proposal(const std::string& name, const std::string& rest,
                  const std::string& currency = "kUSD") {
  return parse_proposal("name = '" + name +
                            "'\ndescription = 'b'\n[cost]\namount = '25'\ncurrency = '" + currency +
                            "'\n" + rest,
                        name + ".toml");
}

TEST(ComparedAntennas, AreTheAntennaAsItIsAndWhatEachProposalMakesOfIt) {
  const auto compared = compared_antennas(
      as_stated(), {proposal("fewer", "[motor]\nflywheel_disks = '12'\n")}, {"PI"});
  ASSERT_EQ(compared.antennas.size(), 2U);
  ASSERT_EQ(compared.cases.size(), 2U);
  EXPECT_EQ(compared.currency, "kUSD");
  const auto& base = compared.antennas[0];
  EXPECT_EQ(base.name, as_it_is);
  EXPECT_EQ(base.cost, 0.0);
  EXPECT_FALSE(base.changed);
  EXPECT_EQ(motor_inertia(base.mission.antenna), motor_inertia(mission_of(as_stated()).antenna));
  const auto& fewer = compared.antennas[1];
  EXPECT_EQ(fewer.cost, 25.0);
  EXPECT_TRUE(fewer.changed);
  EXPECT_EQ(fewer.mission.antenna.flywheels.disks, 12.0);
  ASSERT_EQ(fewer.structures.loops.size(), 1U);
  EXPECT_EQ(fewer.structures.loops[0].name, "PI");
}

TEST(ComparedAntennas, RefuseWhatCannotStandSideBySide) {
  const std::string change = "[motor]\nflywheel_disks = '12'\n";
  const auto refused = [&](const std::string& first, const std::string& second,
                           const std::string& currency) {
    return reference::Call([=] {
      check_proposals(as_stated(), {proposal(first, change), proposal(second, change, currency)});
    });
  };
  EXPECT_THAT(
      refused("a", "a", "kUSD"),
      ThrowsMessage<InvalidInput>(HasSubstr("a.toml:1:8: name: expected a name of its own")));
  EXPECT_THAT(refused("a", "as it is", "kUSD"),
              ThrowsMessage<InvalidInput>(HasSubstr("which is the antenna without proposals")));
  EXPECT_THAT(refused("a", "b", "EUR"),
              ThrowsMessage<InvalidInput>(HasSubstr("cost.currency: expected the currency of")));
  EXPECT_NO_THROW(refused("a", "b", "kUSD")());
}

}  // namespace
}  // namespace boresight::io
