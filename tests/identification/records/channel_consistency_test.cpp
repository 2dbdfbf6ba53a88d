#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "identification/prescribed_channels.hpp"
#include "random_numbers.hpp"
#include <boresight/identification/records/channel_consistency.hpp>
#include <boresight/identification/records/suspect_channels.hpp>

namespace boresight::identification {
namespace {

using Quantity = ChannelQuantity;
using Verdict = ChannelVerdict;
using prescribed::Drive;
using prescribed::Records;
using testing::ElementsAre;
using testing::IsEmpty;

const ChannelCheck* row_of(const std::vector<ChannelCheck>& rows, const std::string& channel,
                           Quantity quantity, const std::string& record = "") {
  const auto found = std::ranges::find_if(rows, [&](const ChannelCheck& one) {
    return one.name == channel && one.quantity == quantity && one.record == record;
  });
  return found == rows.end() ? nullptr : &*found;
}

// Pressures and the tachometer that have a row with the verdict suspect.
std::vector<std::string> suspects(const std::vector<ChannelCheck>& rows) {
  std::vector<std::string> names;
  for (const ChannelCheck& one : rows) {
    if (one.verdict != Verdict::suspect || one.channel == ChannelCheck::Channel::torque) continue;
    if (names.empty() || names.back() != one.name) names.push_back(one.name);
  }
  return names;
}

std::string likely(const ChannelCheck* row) {
  return row != nullptr && row->likely ? row->likely->name : "none";
}

TEST(ChannelConsistency, FindsAllRightWhereErrorsStayWithinTheStatedAccuracy) {
  reference::RandomNumbers random(5);
  for (std::uint64_t trial = 0; trial < 20; ++trial) {
    Drive drive;
    for (auto* side : {&drive.inlet, &drive.outlet}) {
      for (auto& errors : *side) {
        errors = {1.0 + 0.006 * random.uniform(-1.7, 1.7), 2e4 * random.uniform(-1.7, 1.7)};
      }
    }
    drive.tachometer_gain = 1.0 + 0.003 * random.uniform(-1.7, 1.7);
    drive.line_loss = random.uniform(0.0, 2e4);
    const auto rows = Records(drive, 3, 10 * trial).check();
    EXPECT_THAT(suspects(rows), IsEmpty()) << trial;
    EXPECT_EQ(row_of(rows, "tach", Quantity::gain)->verdict, Verdict::right);
    EXPECT_EQ(row_of(rows, "p1_in", Quantity::gain)->verdict, Verdict::right);
    EXPECT_EQ(row_of(rows, "p1_in - p1_out", Quantity::gain)->verdict, Verdict::right);
  }
}

// Normal errors of the stated accuracy: one campaign in some hundred has a suspect, as documented.
TEST(ChannelConsistency, SuspectsOneHonestCampaignInSomeHundred) {
  constexpr int campaigns = 300;
  reference::RandomNumbers random(21);
  const numerics::NormalNumbers normals(21, 0);
  std::uint64_t number = 0;
  const auto normal = [&] { return normals.pair(number++).real(); };
  int suspected = 0;
  for (int trial = 0; trial < campaigns; ++trial) {
    Drive drive;
    for (auto* side : {&drive.inlet, &drive.outlet}) {
      for (auto& errors : *side) {
        errors = {1.0 + 0.006 * normal(), 2e4 * normal()};
      }
    }
    drive.tachometer_gain = 1.0 + 0.003 * normal();
    drive.line_loss = random.uniform(0.0, 2e4);
    const auto rows = Records(drive, 3, 200000 + 10 * static_cast<std::uint64_t>(trial)).check();
    if (std::ranges::any_of(rows, contradicts)) ++suspected;
  }
  EXPECT_LE(suspected, 9);
}

// Neither says that a value of the drive is wrong: a reversed tachometer is refused by the torque,
// and the lag of a display is no error of the tachometer.
TEST(ChannelConsistency, ForbidsNoValueForAReversedOrLateEncoder) {
  Records reversed(Drive{}, 3, 12);
  for (std::size_t i = 0; i < 3; ++i) {
    reversed.clean(i).record->encoder->values *= -1.0;
    reversed.raw(i).encoder->values *= -1.0;
  }
  const auto turned = reversed.check();
  const ChannelCheck* sign = row_of(turned, "tach", Quantity::sign);
  ASSERT_NE(sign, nullptr);
  EXPECT_EQ(sign->verdict, Verdict::suspect);
  EXPECT_TRUE(std::ranges::none_of(turned, contradicts));
  Drive drive;
  drive.tachometer_delay = -0.15;
  const auto late = Records(drive, 3, 13).check();
  const ChannelCheck* delay = row_of(late, "tach", Quantity::delay);
  ASSERT_NE(delay, nullptr);
  EXPECT_EQ(delay->verdict, Verdict::suspect);
  EXPECT_NEAR(delay->interval->value, -0.15, 0.01);
  EXPECT_TRUE(std::ranges::none_of(late, contradicts));
  drive = {};
  drive.tachometer_gain = 1.05;
  const auto wrong = Records(drive, 3, 14).check();
  EXPECT_EQ(std::ranges::count_if(wrong, contradicts), 1);
}

struct Coverage {
  int gain = 0, zero = 0, delay = 0;
};

void count(int& covered, const ChannelCheck* row, double truth) {
  ASSERT_NE(row, nullptr);
  ASSERT_TRUE(row->interval);
  if (row->interval->lower <= truth && truth <= row->interval->upper) ++covered;
}

constexpr int trials = 200;
void expect_95(int covered, const char* what) {
  EXPECT_GE(covered, 0.90 * trials) << what;
  EXPECT_LE(covered, 0.995 * trials) << what;
}

TEST(ChannelConsistency, IntervalsHoldTheTachometersTruthInNineteenOfTwenty) {
  reference::RandomNumbers random(11);
  Coverage covered;
  for (int trial = 0; trial < trials; ++trial) {
    Drive drive;
    drive.motors = 1;
    drive.tachometer_gain = random.uniform(0.9, 1.1);
    drive.tachometer_zero = random.uniform(-0.3, 0.3);
    drive.tachometer_delay = random.uniform(0.0, 0.1);
    drive.encoder_noise = random.log_uniform(1e-6, 1e-5);
    const auto rows = Records(drive, 2, 50000 + static_cast<std::uint64_t>(trial)).check();
    count(covered.gain, row_of(rows, "tach", Quantity::gain), drive.tachometer_gain);
    count(covered.zero, row_of(rows, "tach", Quantity::zero), drive.tachometer_zero);
    count(covered.delay, row_of(rows, "tach", Quantity::delay), drive.tachometer_delay);
  }
  expect_95(covered.gain, "gain");
  expect_95(covered.zero, "zero");
  expect_95(covered.delay, "delay");
}

TEST(ChannelConsistency, IntervalsHoldAPressuresTruthInNineteenOfTwenty) {
  reference::RandomNumbers random(12);
  Coverage covered, torque;
  for (int trial = 0; trial < trials; ++trial) {
    Drive drive;
    drive.inlet[1] = {random.uniform(0.8, 1.2), random.uniform(-3e5, 3e5)};
    drive.line_loss = random.uniform(0.0, 2e4);
    drive.pressure_noise = random.log_uniform(2e3, 3e4);
    drive.has_encoder = false;
    const auto rows = Records(drive, 2, 90000 + static_cast<std::uint64_t>(trial)).check();
    count(covered.gain, row_of(rows, "p2_in", Quantity::gain), drive.inlet[1].gain);
    count(covered.zero, row_of(rows, "p2_in", Quantity::zero), drive.inlet[1].zero);
    count(torque.gain, row_of(rows, "p4_in - p4_out", Quantity::gain), 1.0);
  }
  expect_95(covered.gain, "gain");
  expect_95(covered.zero, "zero");
  expect_95(torque.gain, "torque");
}

TEST(ChannelConsistency, NamesTheTachometerAndNotThePressures) {
  Drive drive;
  drive.tachometer_gain = 1.05;
  const auto rows = Records(drive, 3, 1).check();
  EXPECT_THAT(suspects(rows), ElementsAre("tach"));
  const ChannelCheck* gain = row_of(rows, "tach", Quantity::gain);
  EXPECT_NEAR(gain->likely->factor, 1.05, 1e-3);
  EXPECT_EQ(likely(gain), "");
}

TEST(ChannelConsistency, NamesTheUsualFactors) {
  const std::vector<std::pair<double, std::string>> factors{{10.0, "10"},
                                                            {0.1, "0.1"},
                                                            {0.9, "0.9"},
                                                            {1.0 / 0.9, "1/0.9"},
                                                            {6.894757, "kPa read as psi"},
                                                            {1.0 / 6.894757, "psi read as kPa"},
                                                            {14.503774, "psi read as bar"},
                                                            {1.0 / 14.503774, "bar read as psi"}};
  for (const auto& [factor, name] : factors) {
    Drive drive;
    drive.inlet[2].gain = factor;
    const auto rows = Records(drive, 3, 2).check();
    EXPECT_THAT(suspects(rows), ElementsAre("p3_in")) << name;
    EXPECT_EQ(likely(row_of(rows, "p3_in", Quantity::gain)), name);
  }
}

TEST(ChannelConsistency, NamesAReversedSignAndExchangedPorts) {
  Drive drive;
  drive.inlet[2].gain = -1.0;
  EXPECT_EQ(likely(row_of(Records(drive, 3, 3).check(), "p3_in", Quantity::sign)), "reversed sign");
  Records records(Drive{}, 3, 3);
  for (std::size_t i = 0; i < 3; ++i) {
    std::swap(records.raw(i).inlet[0].values, records.raw(i).outlet[0].values);
  }
  const auto rows = records.check();
  EXPECT_THAT(suspects(rows), ElementsAre("p1_in", "p1_out"));
  EXPECT_EQ(likely(row_of(rows, "p1_in", Quantity::sign)), "exchanged ports");
}

TEST(ChannelConsistency, NamesAShiftedZeroAndNotTheGain) {
  Drive drive;
  drive.outlet[0].zero = 1e6;
  const auto rows = Records(drive, 3, 4).check();
  EXPECT_THAT(suspects(rows), ElementsAre("p1_out"));
  EXPECT_EQ(row_of(rows, "p1_out", Quantity::gain)->verdict, Verdict::right);
  EXPECT_NEAR(row_of(rows, "p1_out", Quantity::zero)->interval->value, 1e6, 3e4);
}

TEST(ChannelConsistency, NamesTheTorqueOfAMotorWhosePortsAreBothOff) {
  Drive drive;
  drive.inlet[3].gain = drive.outlet[3].gain = 0.9;
  const auto rows = Records(drive, 3, 5).check();
  EXPECT_THAT(suspects(rows), ElementsAre("p4_in", "p4_out"));
  EXPECT_EQ(likely(row_of(rows, "p4_in - p4_out", Quantity::gain)), "0.9");
}

TEST(ChannelConsistency, GivesNoFactorOfATorqueWithOneWrongPort) {
  Drive drive;
  drive.inlet[0].gain = 10.0;
  for (const ChannelCheck& one : Records(drive, 3, 5).check()) {
    if (one.channel != ChannelCheck::Channel::torque) continue;
    EXPECT_FALSE(one.likely) << one.name;
  }
}

TEST(ChannelConsistency, NamesOneOfThreeAndBothOfTwoMotors) {
  Drive drive;
  drive.inlet[1].gain = 0.9;
  drive.motors = 3;
  EXPECT_THAT(suspects(Records(drive, 3, 6).check()), ElementsAre("p2_in"));
  drive.motors = 2;
  EXPECT_THAT(suspects(Records(drive, 3, 6).check()), ElementsAre("p1_in", "p2_in"));
}

TEST(ChannelConsistency, NamesTheOneRecordThatIsUnlikeTheOthers) {
  Records records(Drive{}, 4, 7);
  records.raw(2).inlet[1].values *= 0.9;
  records.clean(1).record->motor_rate.values *= 1.05;
  const auto rows = records.check();
  EXPECT_EQ(row_of(rows, "p2_in", Quantity::gain)->verdict, Verdict::right);
  EXPECT_EQ(likely(row_of(rows, "p2_in", Quantity::gain, "record 3")), "0.9");
  EXPECT_EQ(row_of(rows, "tach", Quantity::gain)->verdict, Verdict::right);
  EXPECT_EQ(row_of(rows, "tach", Quantity::gain, "record 2")->verdict, Verdict::suspect);
}

TEST(ChannelConsistency, NamesTheTachometerOfOneShortRecord) {
  Records records(Drive{}, 4, 7);
  DriveRecord& record = *records.clean(1).record;
  const auto samples = static_cast<Eigen::Index>(std::lround(20.0 / record.sample_time));
  const auto shorten = [samples](Signal& signal) {
    signal.values = signal.values.head(samples).eval();
    if (!signal.valid.empty()) signal.valid.resize(static_cast<std::size_t>(samples));
  };
  for (auto* side : {&record.inlet_pressure, &record.outlet_pressure}) {
    for (Signal& pressure : *side) shorten(pressure);
  }
  shorten(record.motor_rate);
  shorten(*record.encoder);
  record.motor_rate.values *= 1.05;
  const auto rows = records.check();
  EXPECT_EQ(row_of(rows, "tach", Quantity::gain)->verdict, Verdict::right);
  const ChannelCheck* alone = row_of(rows, "tach", Quantity::gain, "record 2");
  ASSERT_NE(alone, nullptr);
  EXPECT_EQ(alone->verdict, Verdict::suspect);
  EXPECT_NEAR(alone->interval->value, 1.05, 0.01);
}

TEST(ChannelConsistency, SaysWhereRecordsCannotTell) {
  Drive drive;
  drive.motors = 1;
  drive.has_encoder = false;
  EXPECT_THAT(Records(drive, 3, 8).check(), IsEmpty());
  // At rest the gain cannot be told.
  Records records(Drive{}, 1, 9);
  for (auto* side : {&records.raw(0).inlet, &records.raw(0).outlet}) {
    for (RawChannel& one : *side) one.values.array() = 9e6 + 1e-3 * (one.values.array() - 9e6);
  }
  for (const ChannelCheck& one : records.check()) {
    if (one.channel == ChannelCheck::Channel::inlet && one.quantity == Quantity::gain) {
      EXPECT_NE(one.verdict, Verdict::suspect);
    }
  }
}

TEST(ChannelConsistency, WorksOnMissingSamplesAndSpikes) {
  Drive drive;
  drive.inlet[0].gain = 0.9;
  Records records(drive, 3, 10);
  reference::RandomNumbers random(3);
  for (std::size_t i = 0; i < 3; ++i) {
    for (RawChannel& one : records.raw(i).inlet) {
      for (double& value : one.values) {
        if (random.uniform(0.0, 1.0) < 0.05) value = std::nan("");
        if (random.uniform(0.0, 1.0) < 0.002) value = 2e7;
      }
    }
  }
  const auto rows = records.check();
  EXPECT_THAT(suspects(rows), ElementsAre("p1_in"));
  EXPECT_EQ(likely(row_of(rows, "p1_in", Quantity::gain)), "0.9");
}

}  // namespace
}  // namespace boresight::identification
