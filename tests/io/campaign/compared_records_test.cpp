#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boresight/io/campaign/compared_records.hpp>
#include <boresight/io/case/case_campaign.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::io {
namespace {

using testing::HasSubstr;

Case recorded_case() {
  return read_case(BORESIGHT_SOURCE_DIR "/cases/dss14-70m/campaign.toml");
}

TEST(ComparedRecords, SayThatAFasterMotionMovesMore) {
  const Case antenna = recorded_case();
  // Constant speeds of 0.25 V and 0.5 V: the faster one moves more, in every channel.
  const auto channels =
      compare_records_of(antenna, "constant-speed-0.25V", "constant-speed-0.5V", 1);
  ASSERT_GE(channels.size(), 2U);
  for (const auto& channel : channels) {
    EXPECT_LT(channel.comparison.whole.lower, channel.comparison.whole.ratio);
    EXPECT_LT(channel.comparison.whole.ratio, channel.comparison.whole.upper);
    EXPECT_GE(channel.comparison.bands.size(), 3U);
    if (channel.quantity == design::ComparedQuantity::motor_rate) {
      EXPECT_EQ(channel.comparison.whole.change, design::Change::worse);
    }
  }
}

TEST(ComparedRecords, AreTwoUsableRecordsOfTheCase) {
  const Case antenna = recorded_case();
  const auto refusal = [&](const std::string& before, const std::string& after) -> std::string {
    try {
      compare_records_of(antenna, before, after, 1);
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "nothing was thrown";
  };
  EXPECT_THAT(refusal("slosh", "slosh"), HasSubstr("found 'slosh' twice"));
  EXPECT_THAT(refusal("slosh", "none"), HasSubstr("expected a record of the case"));
  Case without = antenna;
  without.campaign->records.clear();
  EXPECT_THROW(compare_records_of(without, "slosh", "none", 1), InvalidInput);
}

}  // namespace
}  // namespace boresight::io
