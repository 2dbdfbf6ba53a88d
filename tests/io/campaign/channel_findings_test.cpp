#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "io/campaign/broken_campaign.hpp"
#include <boresight/identification/records/channel_consistency.hpp>
#include <boresight/io/campaign/campaign_identification.hpp>
#include <boresight/io/campaign/channel_findings.hpp>
#include <boresight/io/campaign/designed_antenna.hpp>
#include <boresight/io/campaign/loaded_campaign.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/normal_numbers.hpp>

namespace boresight::io {
namespace {

using identification::ChannelCheck;
using identification::ChannelQuantity;
using identification::ChannelVerdict;
using identification::RawRecord;
using testing::ElementsAre;
using testing::IsEmpty;

const std::vector<std::string> campaigns{"full", "paper-like", "small-dish"};

const LoadedCampaign& loaded(const std::string& campaign) {
  static std::map<std::string, LoadedCampaign> all;
  const auto [place, is_new] = all.try_emplace(campaign);
  if (is_new) place->second = load_campaign(case_of(campaign), 2);
  return place->second;
}

// The encoder that the recorded motion makes, with the noise of a bit of 0.1 mdeg.
void add_encoder(const LoadedRecord& one, const identification::DriveKnowledge& knowledge,
                 RawRecord& raw) {
  const auto& record = one.clean.record;
  if (!record || one.clean.without_rate || record->samples() != raw.time.size()) return;
  const numerics::NormalNumbers normal(raw.name.size(), 1);
  Eigen::VectorXd angle = Eigen::VectorXd::Zero(record->samples());
  double sum = 0.0;
  for (Eigen::Index i = 0; i < angle.size(); ++i) {
    if (i > 0) {
      sum += 0.5 * record->sample_time *
             (record->motor_rate.values(i - 1) + record->motor_rate.values(i));
    }
    angle(i) =
        sum / knowledge.gear_ratio + 1e-6 * normal.pair(static_cast<std::uint64_t>(i)).real();
  }
  raw.encoder.emplace();
  raw.encoder->name = "encoder";
  raw.encoder->values = angle;
}

using SpoilRaw = std::function<void(RawRecord& raw)>;

// What the channels of a campaign are found to be where all its records are spoiled.
CampaignSection spoiled(const std::string& campaign, const SpoilRaw& spoil) {
  LoadedCampaign own = loaded(campaign);
  CampaignSection section;
  for (LoadedRecord& one : own.records) {
    add_encoder(one, own.knowledge, one.raw);
    spoil(one.raw);
    one.clean = identification::clean_record(one.raw);
    one.notes.name = one.raw.name;
    one.notes.test = one.raw.test;
    section.notes.records.push_back(one.notes);
  }
  settle_conflicts(case_of(campaign), own.records);
  std::vector<identification::EvaluatedRecord> records;
  for (const LoadedRecord& one : own.records) records.push_back({&one.raw, &one.clean});
  section.channels = identification::channel_consistency(records, own.knowledge, own.instruments);
  return section;
}

std::vector<std::string> named(const CampaignSection& section) {
  std::vector<std::string> channels;
  for (const auto& one : channel_suspicions(section)) {
    channels.insert(channels.end(), one.channels.begin(), one.channels.end());
  }
  return channels;
}

std::string likely(const CampaignSection& section, const std::string& channel) {
  for (const ChannelCheck& one : section.channels) {
    if (one.name == channel && one.record.empty() && one.likely) {
      return one.likely->name.empty() ? std::to_string(one.likely->factor) : one.likely->name;
    }
  }
  return "none";
}

TEST(Channels, AreAllRightInCleanCampaigns) {
  for (const auto& campaign : campaigns) {
    for (const bool has_encoder : {false, true}) {
      const auto section = spoiled(campaign, [&](RawRecord& raw) {
        if (!has_encoder) raw.encoder.reset();
      });
      EXPECT_FALSE(section.channels.empty()) << campaign;
      for (const ChannelCheck& one : section.channels) {
        EXPECT_NE(one.verdict, ChannelVerdict::suspect)
            << campaign << ": " << one.name << " " << departure_of(one);
      }
      EXPECT_FALSE(channels_contradict(section));
      EXPECT_THAT(channel_contradiction(section), IsEmpty());
    }
  }
}

TEST(Channels, NameTheTachometerThatIsFivePercentHigh) {
  for (const auto& campaign : campaigns) {
    const auto section = spoiled(campaign, [](RawRecord& raw) { raw.tachometer.values *= 1.05; });
    EXPECT_THAT(named(section), ElementsAre("tach")) << campaign;
    EXPECT_NEAR(std::stod(likely(section, "tach")), 1.05, 0.002) << campaign;
    EXPECT_TRUE(channels_contradict(section));
  }
}

TEST(Channels, NameOneInletTransducerAndItsFactor) {
  for (const auto& [factor, name] :
       {std::pair{0.9, "0.9"}, {10.0, "10"}, {1.0 / 6.894757, "psi read as kPa"}}) {
    for (const char* campaign : {"full", "paper-like"}) {
      const auto section =
          spoiled(campaign, [&, by = factor](RawRecord& raw) { raw.inlet[2].values *= by; });
      EXPECT_THAT(named(section), ElementsAre("p3_in")) << campaign << name;
      EXPECT_EQ(likely(section, "p3_in"), name) << campaign;
    }
  }
}

// Their values are replaced: what the records say of the drive stays right.
TEST(Channels, DoNotContradictWhereAnotherScaleOrSignIsReplaced) {
  const auto larger = spoiled("full", [](RawRecord& raw) { raw.inlet[0].values *= 10.0; });
  EXPECT_FALSE(channels_contradict(larger));
  const auto turned = spoiled("full", [](RawRecord& raw) { raw.inlet[0].values *= -1.0; });
  EXPECT_THAT(named(turned), ElementsAre("p1_in"));
  EXPECT_EQ(likely(turned, "p1_in"), "reversed sign");
  EXPECT_FALSE(channels_contradict(turned));
  const auto smaller = spoiled("full", [](RawRecord& raw) { raw.inlet[0].values *= 0.9; });
  EXPECT_TRUE(channels_contradict(smaller));
}

TEST(Channels, NameAZeroShiftedByATwentiethOfTheRange) {
  for (const char* campaign : {"full", "paper-like"}) {
    const auto section = spoiled(campaign, [](RawRecord& raw) {
      raw.outlet[1].values.array() += 0.05 * raw.outlet[1].upper_limit;
    });
    ASSERT_THAT(named(section), ElementsAre("p2_out")) << campaign;
    EXPECT_EQ(channel_suspicions(section).front().finding, "suspect zero");
  }
}

TEST(Channels, NameBothPortsOfAMotorAsOneFinding) {
  const auto section = spoiled("full", [](RawRecord& raw) {
    raw.inlet[3].values *= 0.9;
    raw.outlet[3].values *= 0.9;
  });
  const auto found = channel_suspicions(section);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_THAT(found.front().channels, ElementsAre("p4_in", "p4_out"));
  EXPECT_EQ(likely(section, "p4_in - p4_out"), "0.9");
}

TEST(Channels, NameBothOfTwoMotors) {
  const auto section = spoiled("small-dish", [](RawRecord& raw) { raw.inlet[1].values *= 0.9; });
  EXPECT_THAT(named(section), ElementsAre("p1_in", "p2_in"));
}

const std::vector<std::string> few{"slow_ramp", "constant_speed_0.02deg_s",
                                   "constant_speed_0.14deg_s", "valve_steps"};

// Records of the small dish with an encoder column, the tachometer times a factor.
CampaignSection with_encoder(double factor) {
  double angle = 0.0, last = 0.0;
  const double turns = gear_ratio(case_of("small-dish"));
  constexpr double rate_per_rpm = 0.25132741228718347;
  const Case antenna = broken_campaign(
      "small-dish", few, few,
      [&](const auto& header, auto& cells) {
        const double time = std::stod(cells.at(0));
        std::string& rate = cell(header, cells, "tach");
        if (time < last) angle = last = 0.0;
        angle += (time - last) * rate_per_rpm * std::stod(rate) / turns;
        last = time;
        rate = std::to_string(factor * std::stod(rate));
        cells.push_back(std::to_string(1000.0 * angle));
      },
      ",encoder [mrad]");
  return identify_campaign(antenna, {});
}

TEST(Channels, LeaveACampaignWithARightEncoderRecommended) {
  const auto section = with_encoder(1.0);
  EXPECT_EQ(rejection(section), Rejection::none);
  EXPECT_THAT(channel_suspicions(section), IsEmpty());
  const auto tachometer = std::ranges::find(section.channels, "tach", &ChannelCheck::name);
  ASSERT_NE(tachometer, section.channels.end());
  EXPECT_EQ(tachometer->verdict, ChannelVerdict::right);
}

TEST(Channels, MakeACampaignWithoutAValueWhereTheTachometerContradictsTheEncoder) {
  const auto section = with_encoder(1.05);
  EXPECT_EQ(rejection(section), Rejection::channels_contradict);
  EXPECT_FALSE(recommended(section));
  ASSERT_FALSE(suspicions(section).empty());
  EXPECT_THAT(suspicions(section).front().channels, ElementsAre("tach"));
  EXPECT_EQ(suspicions(section).front().records, few);
  EXPECT_THROW(designed_antenna(case_of("small-dish"), section, 1), NumericalFailure);
}

}  // namespace
}  // namespace boresight::io
