#include "io/campaign/broken_campaign.hpp"

#include <cmath>
#include <cstdint>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "refused_call.hpp"
#include <boresight/io/campaign/campaign_identification.hpp>
#include <boresight/io/campaign/recommended_values.hpp>
#include <boresight/numerics/normal_numbers.hpp>

namespace boresight::io {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

const std::vector<std::string> records{"slow_ramp", "constant_speed_0.02deg_s",
                                       "constant_speed_0.14deg_s", "valve_steps"};

// No value, or one within 3 % of the truth.
void expect_no_wrong_value(const CampaignSection& section) {
  const auto values = recommended(section);
  if (!values) return;
  std::ifstream file(folder_of("small-dish") + "/truth.json");
  const double truth = nlohmann::json::parse(file)["reflected_inertia"];
  EXPECT_NEAR(values->inertia.value, truth, 0.03 * truth);
}

ChannelSuspicion suspicion(const CampaignSection& section, const std::string& finding) {
  for (const auto& one : suspicions(section)) {
    if (one.finding == finding) return one;
  }
  ADD_FAILURE() << "not found: " << finding;
  return {};
}

CampaignSection identified(const std::vector<std::string>& spoiled, const Spoil& spoil) {
  return identify_campaign(broken_campaign("small-dish", records, spoiled, spoil), {});
}

TEST(BrokenCampaign, NamesTheRecordOfATachometerTenTimesTooLarge) {
  const auto section = identified({"slow_ramp"}, [](const auto& header, auto& cells) {
    std::string& rate = cell(header, cells, "tach");
    rate = std::to_string(10.0 * std::stod(rate));
  });
  expect_no_wrong_value(section);
  const auto found = suspicion(section, "scale unlike other records");
  EXPECT_THAT(found.records, ElementsAre("slow_ramp"));
  EXPECT_THAT(found.channels, ElementsAre("tach"));
  EXPECT_TRUE(found.record_refused);
}

TEST(BrokenCampaign, NamesTheRecordOfSwappedColumns) {
  const auto section = identified({"slow_ramp"}, [](const auto& header, auto& cells) {
    std::swap(cell(header, cells, "p1_in"), cell(header, cells, "p1_out"));
  });
  expect_no_wrong_value(section);
  const auto found = suspicion(section, "reversed sign");
  EXPECT_THAT(found.records, ElementsAre("slow_ramp"));
  EXPECT_TRUE(found.record_refused);
  EXPECT_THAT(found.explanation, HasSubstr("p1_in and p1_out"));
}

TEST(BrokenCampaign, IsRefusedWithTheColumnsThatAreSwappedInAllRecords) {
  const Case antenna =
      broken_campaign("small-dish", records, records, [](const auto& header, auto& cells) {
        std::swap(cell(header, cells, "p1_in"), cell(header, cells, "p1_out"));
      });
  EXPECT_THAT([&] { identify_campaign(antenna, {}); },
              testing::ThrowsMessage<InvalidInput>(
                  AllOf(HasSubstr("p1_in and p1_out"), HasSubstr("4 of 4 records"))));
}

TEST(BrokenCampaign, HasItsValueWithoutTwoPercentOfItsSamples) {
  std::uint64_t count = 0;
  const auto section = identified(records, [&](const auto&, auto& cells) {
    for (std::size_t i = 1; i < cells.size(); ++i) {
      constexpr std::uint64_t one_in = 50;
      if (numerics::splitmix64(3, ++count) % one_in == 0) cells[i].clear();
    }
  });
  expect_no_wrong_value(section);
  EXPECT_TRUE(recommended(section));
  const auto found = suspicion(section, "missing samples");
  EXPECT_EQ(found.records, records);
  EXPECT_THAT(found.channels, Contains("tach"));
  EXPECT_NEAR(found.fraction, 0.02, 0.005);
}

TEST(BrokenCampaign, NamesAChannelThatIsConstant) {
  const auto pressure = identified({"slow_ramp"}, [](const auto& header, auto& cells) {
    cell(header, cells, "p1_in") = "75.0";
  });
  expect_no_wrong_value(pressure);
  const auto dead = suspicion(pressure, "dead channel");
  EXPECT_THAT(dead.records, ElementsAre("slow_ramp"));
  EXPECT_THAT(dead.channels, ElementsAre("p1_in"));
  EXPECT_FALSE(dead.record_refused);
}

TEST(BrokenCampaign, NamesACommandThatIsConstant) {
  const auto section = identified({"valve_steps"}, [](const auto& header, auto& cells) {
    cell(header, cells, "valve_command") = "0.5";
  });
  expect_no_wrong_value(section);
  const auto found = suspicion(section, "dead channel");
  EXPECT_THAT(found.records, ElementsAre("valve_steps"));
  EXPECT_THAT(found.channels, ElementsAre("valve_command"));
}

TEST(BrokenCampaign, NamesTheRecordOfATachometerThatIsConstant) {
  const auto section = identified({"valve_steps"}, [](const auto& header, auto& cells) {
    cell(header, cells, "tach") = "10.0";
  });
  expect_no_wrong_value(section);
  const auto found = suspicion(section, "dead channel");
  EXPECT_THAT(found.records, ElementsAre("valve_steps"));
  EXPECT_THAT(found.explanation, HasSubstr("tach"));
  EXPECT_TRUE(found.record_refused);
}

}  // namespace
}  // namespace boresight::io
