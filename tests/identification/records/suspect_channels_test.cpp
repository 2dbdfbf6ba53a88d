#include <algorithm>

#include <gtest/gtest.h>

#include "identification/prescribed_channels.hpp"
#include <boresight/identification/records/suspect_channels.hpp>

namespace boresight::identification {
namespace {

using prescribed::Drive;
using prescribed::Records;
using Verdict = ChannelVerdict;

// One wrong port makes zero, torque and the torque's zero wrong too: one fault.
TEST(SuspectChannels, AreListedOnceAFault) {
  Drive drive;
  drive.inlet[1].gain = 0.9;
  const auto rows = Records(drive, 3, 15).check();
  EXPECT_GT(std::ranges::count(rows, Verdict::suspect, &ChannelCheck::verdict), 1);
  const auto places = unexplained_suspects(rows);
  ASSERT_EQ(places.size(), 1U);
  EXPECT_EQ(rows[places[0]].name, "p2_in");
  drive.outlet[1].gain = 0.9;
  const auto both = Records(drive, 3, 15).check();
  const auto two = unexplained_suspects(both);
  ASSERT_EQ(two.size(), 2U);
  EXPECT_TRUE(is_one_fault(both[two[0]], both[two[1]]));
  EXPECT_FALSE(is_one_fault(both[two[0]], both[0]));  // the tachometer's
}

ChannelCheck suspect(ChannelCheck::Channel channel, ChannelQuantity quantity) {
  ChannelCheck check;
  check.channel = channel;
  check.quantity = quantity;
  check.verdict = Verdict::suspect;
  return check;
}

TEST(Contradicts, IsOfUsedValuesAndNotOfTheEncodersSignZeroAndDelay) {
  EXPECT_TRUE(contradicts(suspect(ChannelCheck::Channel::tachometer, ChannelQuantity::gain)));
  for (const auto quantity :
       {ChannelQuantity::sign, ChannelQuantity::zero, ChannelQuantity::delay}) {
    EXPECT_FALSE(contradicts(suspect(ChannelCheck::Channel::tachometer, quantity)));
  }
  ChannelCheck pressure = suspect(ChannelCheck::Channel::inlet, ChannelQuantity::zero);
  EXPECT_TRUE(contradicts(pressure));
  pressure.is_used = false;
  EXPECT_FALSE(contradicts(pressure));
  pressure.is_used = true;
  pressure.verdict = Verdict::right;
  EXPECT_FALSE(contradicts(pressure));
}

// What one record shows does not explain the others.
TEST(SuspectChannels, OfOneRecordExplainThatRecordOnly) {
  std::vector<ChannelCheck> rows{suspect(ChannelCheck::Channel::inlet, ChannelQuantity::gain),
                                 suspect(ChannelCheck::Channel::inlet, ChannelQuantity::zero)};
  EXPECT_EQ(unexplained_suspects(rows), std::vector<std::size_t>{0});
  rows[0].record = "one";
  EXPECT_EQ(unexplained_suspects(rows).size(), 2U);
  rows[1].record = "one";
  EXPECT_EQ(unexplained_suspects(rows), std::vector<std::size_t>{0});
}

}  // namespace
}  // namespace boresight::identification
