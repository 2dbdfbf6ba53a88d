#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include <boresight/app/identify/record_traces.hpp>
#include <boresight/identification/records/record_defects.hpp>

namespace boresight::app {
namespace {

using Signal = RecordTrace::Signal;

// Ten seconds of a sine on a tachometer that shows no more than 0.8, and two pressures.
identification::RawRecord record() {
  constexpr Eigen::Index count = 2000;
  identification::RawRecord raw;
  raw.name = "sine";
  raw.test = identification::TestKind::fast_ramp;
  raw.time = Eigen::VectorXd::LinSpaced(count, 5.0, 5.0 + 0.005 * (count - 1));
  const Eigen::VectorXd wave = (2.0 * (raw.time.array() - 5.0)).sin().matrix();
  raw.tachometer = {"tach", wave.cwiseMin(0.8).cwiseMax(-0.8), 0.8, -0.8};
  raw.inlet = {{"p_in", (5e6 + 1e6 * wave.array()).matrix()}};
  raw.outlet = {{"p_out", (5e6 - 1e6 * wave.array()).matrix()}};
  return raw;
}

const RecordTrace& trace_of(const std::vector<RecordTrace>& traces, Signal signal) {
  for (const auto& trace : traces) {
    if (trace.signal == signal) return trace;
  }
  throw std::runtime_error("no such trace");
}

TEST(RecordTraces, ShowTheRecordAsRecordedAndWhatStandsForMaskedSamples) {
  const auto raw = record();
  const auto clean = identification::clean_record(raw);
  ASSERT_TRUE(clean.record);
  identification::DriveKnowledge knowledge;
  knowledge.motor_count = 1.0;
  knowledge.displacement = {1e-5, 0.0};
  knowledge.torque_efficiency = {0.9, 0.0};
  const auto traces = record_traces(raw, clean, knowledge);
  ASSERT_EQ(traces.size(), 4U);
  const RecordTrace& tachometer = trace_of(traces, Signal::tachometer);
  EXPECT_EQ(tachometer.channel, "tach");
  EXPECT_EQ(tachometer.series.x.front(), 5.0);
  EXPECT_EQ(*std::ranges::max_element(tachometer.series.y), 0.8);
  // Masked where the sine is beyond the limit, and there alone.
  ASSERT_FALSE(tachometer.masked.x.empty());
  int masked = 0;
  for (std::size_t i = 0; i < tachometer.masked.x.size(); ++i) {
    if (std::isnan(tachometer.masked.y[i])) continue;
    ++masked;
    EXPECT_GT(std::abs(std::sin(2.0 * (tachometer.masked.x[i] - 5.0))), 0.75);
  }
  EXPECT_GT(masked, 50);
  EXPECT_TRUE(trace_of(traces, Signal::pressure).masked.x.empty());
  const RecordTrace& torque = trace_of(traces, Signal::torque);
  EXPECT_NEAR(*std::ranges::max_element(torque.series.y), 0.9 * 1e-5 * 2e6, 1e-3);
}

TEST(RecordTraces, ShowARefusedRecordWithoutTorque) {
  auto raw = record();
  raw.time = raw.time.head(50).eval();  // too short for anything
  const auto clean = identification::clean_record(raw);
  EXPECT_FALSE(clean.record);
  const auto traces = record_traces(raw, clean, {});
  EXPECT_EQ(traces.size(), 3U);
  EXPECT_EQ(traces.front().series.x.size(), 50U);
}

}  // namespace
}  // namespace boresight::app
