#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "refused_call.hpp"
#include <boresight/identification/lines/slosh.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/normal_numbers.hpp>

namespace boresight::identification {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using testing::HasSubstr;
using testing::ThrowsMessage;

// Lines of given true lengths: both half-wave modes of each after each event, a tenth of the other
// lines' as cross-talk, a slow swing of the drive, noise.
struct Rig {
  std::vector<double> lengths{9.0, 10.0, 11.3};
  double bulk_modulus = 1.3e9;
  double density = 860.0;
  double noise = 4e3;  // Pa
  std::uint64_t seed = 1;
  std::vector<double> events{0.5, 1.7};
  double unit = 1.0;

  DriveRecord record() const {
    DriveRecord result;
    result.name = "rig";
    result.test = TestKind::slosh;
    result.sample_time = 0.001;
    const Index samples = 3500;
    const std::size_t motors = lengths.size();
    const auto line = [&](std::size_t motor, double outlet, double t) {
      double sum = 0.0;
      for (std::size_t other = 0; other < motors; ++other) {
        const double fraction = other == motor ? 1.0 : 0.1;
        const double f = std::sqrt(bulk_modulus / density) / (2.0 * lengths[other]);
        for (const double begin : events) {
          if (t < begin) continue;
          for (const double order : {1.0, 2.0}) {
            const double w = two_pi * f * order;
            sum += fraction * 1.5e5 / order * outlet * std::exp(-0.006 * w * (t - begin)) *
                   std::sin(w * (t - begin));
          }
        }
      }
      return sum;
    };
    for (std::size_t motor = 0; motor < motors; ++motor) {
      for (const double side : {1.0, -0.8}) {
        const numerics::NormalNumbers numbers(seed, 2 * motor + (side > 0.0 ? 0 : 1));
        Signal signal;
        signal.values = VectorXd::NullaryExpr(samples, [&](Index i) {
          const double t = 0.001 * static_cast<double>(i);
          const double swing = 1e6 * side * std::exp(-1.1 * t) * std::cos(two_pi * 1.2 * t);
          return unit * (9e6 + swing + line(motor, side, t) +
                         noise * numbers.pair(static_cast<std::uint64_t>(i)).real());
        });
        (side > 0.0 ? result.inlet_pressure : result.outlet_pressure).push_back(signal);
      }
    }
    result.motor_rate.values = VectorXd::NullaryExpr(samples, [&](Index i) {
      const double t = 0.001 * static_cast<double>(i);
      return t > 0.5 && t < 1.7 ? 20.0 * (1.0 - std::exp(-8.0 * (t - 0.5)))
             : t >= 1.7         ? 20.0 * std::exp(-8.0 * (t - 1.7))
                                : 0.0;
    });
    return result;
  }

  DriveKnowledge knowledge() const {
    DriveKnowledge result;
    result.oil_density = {860.0, 1.7};
    result.motor_count = static_cast<double>(lengths.size());
    for (const double length : {9.0, 10.0, 11.3}) result.line_lengths.push_back({length, 0.02});
    return result;
  }
};

TEST(IdentifySlosh, GivesTheBulkModulusOfEveryLineAndOfAll) {
  const Rig rig;
  const auto result = identify_slosh(rig.record(), rig.knowledge());
  ASSERT_EQ(result.events.size(), 2U);
  EXPECT_NEAR(result.events[0].time, 0.5, 0.03);
  EXPECT_NEAR(result.events[1].time, 1.7, 0.03);
  EXPECT_FALSE(result.events[0].closing);
  EXPECT_TRUE(result.events[1].closing);
  ASSERT_EQ(result.lines.size(), 6U);
  const double speed = std::sqrt(rig.bulk_modulus / rig.density);
  for (const auto& line : result.lines) {
    const double f = speed / (2.0 * rig.lengths[line.motor]);
    EXPECT_NEAR(line.frequency.value, f, 0.001 * f);
    EXPECT_NEAR(line.damping_ratio.value, 0.006, 0.001);
    EXPECT_EQ(line.events, 2U);
    ASSERT_TRUE(line.bulk_modulus.has_value());
    EXPECT_NEAR(line.wave_speed.value_or(numerics::Interval{}).value, speed, 0.001 * speed);
  }
  ASSERT_TRUE(result.bulk_modulus.has_value());
  const numerics::Interval beta = result.bulk_modulus.value_or(numerics::Interval{});
  EXPECT_NEAR(beta.value, 1.3e9, 0.002 * 1.3e9);
  // Three lengths of 0.2 %, twice each, and the density's 0.2 %.
  EXPECT_NEAR(beta.standard_uncertainty / beta.value, std::hypot(0.0040 / std::sqrt(3.0), 0.002),
              0.0007);
  ASSERT_TRUE(result.extreme_lines.has_value());
  const ExtremeLines extremes = result.extreme_lines.value_or(ExtremeLines{});
  EXPECT_NEAR(extremes.bulk_modulus_shortest.value, 1.3e9, 0.003 * 1.3e9);
  EXPECT_NEAR(extremes.bulk_modulus_longest.value, 1.3e9, 0.003 * 1.3e9);
  EXPECT_EQ(result.plots.size(), 6U);
  const auto& plot = result.plots.front();
  Index top = 0;
  plot.fitted_amplitude.maxCoeff(&top);
  EXPECT_NEAR(plot.frequency(top), speed / 18.0, 0.5);
}

TEST(IdentifySlosh, IntervalsCoverLinesThatAreNotAsDrawn) {
  constexpr int trials = 14;
  int covered = 0;
  for (int trial = 0; trial < trials; ++trial) {
    const numerics::NormalNumbers numbers(99, static_cast<std::uint64_t>(trial));
    Rig rig;
    rig.events = {0.5};
    rig.seed = 200 + static_cast<std::uint64_t>(trial);
    for (std::size_t motor = 0; motor < 3; ++motor) {
      rig.lengths[motor] += 0.02 * numbers.pair(motor).real();
    }
    rig.density *= 1.0 + 0.002 * numbers.pair(3).real();
    const auto beta =
        identify_slosh(rig.record(), rig.knowledge()).bulk_modulus.value_or(numerics::Interval{});
    covered += beta.lower <= rig.bulk_modulus && rig.bulk_modulus <= beta.upper ? 1 : 0;
  }
  EXPECT_GE(covered, 12);
}

TEST(IdentifySlosh, DoesNotDependOnThePressuresUnit) {
  Rig rig;
  const auto pascal = identify_slosh(rig.record(), rig.knowledge());
  rig.unit = 1.0 / 6894.757;
  const auto psi = identify_slosh(rig.record(), rig.knowledge());
  EXPECT_NEAR(psi.bulk_modulus.value_or(numerics::Interval{}).value /
                  pascal.bulk_modulus.value_or(numerics::Interval{}).value,
              1.0, 1e-7);
}

TEST(IdentifySlosh, WithTwoLengthsPairsExtremesAsThePaper) {
  const Rig rig;
  auto knowledge = rig.knowledge();
  knowledge.line_lengths = {{9.0, 0.02}, {11.3, 0.02}};
  const auto result = identify_slosh(rig.record(), knowledge);
  EXPECT_NEAR(result.bulk_modulus.value_or(numerics::Interval{}).value, 1.3e9, 0.003 * 1.3e9);
  for (const auto& line : result.lines) EXPECT_EQ(line.length.has_value(), line.motor != 1);
  EXPECT_THAT(result.notes, testing::Contains(HasSubstr("2 line lengths for 3 motors")));
}

TEST(IdentifySlosh, WithoutLengthsGivesFrequenciesAlone) {
  const Rig rig;
  auto knowledge = rig.knowledge();
  knowledge.line_lengths.clear();
  const auto result = identify_slosh(rig.record(), knowledge);
  EXPECT_EQ(result.lines.size(), 6U);
  EXPECT_FALSE(result.bulk_modulus.has_value());
  EXPECT_THAT(result.notes, testing::Contains(HasSubstr("no line length is given")));
}

TEST(IdentifySlosh, SaysWhenLengthsAndMotorsAreExchangedOrAPortIsSilent) {
  const Rig rig;
  auto knowledge = rig.knowledge();
  std::swap(knowledge.line_lengths[0], knowledge.line_lengths[2]);
  const auto exchanged = identify_slosh(rig.record(), knowledge);
  EXPECT_THAT(exchanged.notes, testing::Contains(HasSubstr("check which length belongs")));
  EXPECT_THAT(exchanged.notes, testing::Contains(HasSubstr("scatter by")));
  auto record = rig.record();
  record.outlet_pressure[1].values.setConstant(9e6);
  const auto silent = identify_slosh(record, rig.knowledge());
  EXPECT_EQ(silent.lines.size(), 5U);
  EXPECT_THAT(silent.notes, testing::Contains(HasSubstr("outlet of motor 2: no ringing")));
  EXPECT_NEAR(silent.bulk_modulus.value_or(numerics::Interval{}).value, 1.3e9, 0.003 * 1.3e9);
}

TEST(IdentifySlosh, OfASlowRecorderLeavesOutWhatItCannotFit) {
  const Rig rig;
  auto record = rig.record();
  // 167 and 143 samples/s: too few for a fit once the ringing's own length is taken.
  for (const Index by : {6, 7}) {
    auto slow = record;
    slow.sample_time = 0.001 * static_cast<double>(by);
    for (auto* side : {&slow.inlet_pressure, &slow.outlet_pressure}) {
      for (auto& signal : *side) {
        const VectorXd all = signal.values;
        signal.values =
            VectorXd::NullaryExpr(all.size() / by, [&](Index i) { return all(i * by); });
      }
    }
    const VectorXd rate = record.motor_rate.values;
    slow.motor_rate.values =
        VectorXd::NullaryExpr(rate.size() / by, [&](Index i) { return rate(i * by); });
    try {
      const auto result = identify_slosh(slow, rig.knowledge());
      EXPECT_NEAR(result.bulk_modulus.value_or(numerics::Interval{}).value, 1.3e9, 0.02 * 1.3e9);
    } catch (const NumericalFailure& failure) {
      EXPECT_THAT(failure.what(), HasSubstr("rings between"));
    }
  }
}

TEST(IdentifySlosh, RefusesRecordsThatShowNoRinging) {
  Rig rig;
  auto record = rig.record();
  for (auto* side : {&record.inlet_pressure, &record.outlet_pressure}) {
    for (auto& signal : *side) {
      for (Index i = 0; i < signal.values.size(); ++i) {
        signal.values(i) = 9e6 + 1e3 * std::sin(static_cast<double>(i * i));
      }
    }
  }
  EXPECT_THAT(reference::Call([&] { identify_slosh(record, rig.knowledge()); }),
              ThrowsMessage<NumericalFailure>(HasSubstr("no line of record 'rig' rings")));
  record = rig.record();
  record.sample_time = 0.02;
  EXPECT_THAT(reference::Call([&] { identify_slosh(record, rig.knowledge()); }),
              ThrowsMessage<InvalidInput>(HasSubstr("has 50 samples/s; lines whose slosh")));
  record.inlet_pressure.clear();
  record.outlet_pressure.clear();
  EXPECT_THAT(reference::Call([&] { identify_slosh(record, rig.knowledge()); }),
              ThrowsMessage<InvalidInput>(HasSubstr("found 0 ports")));
  EXPECT_THAT(reference::Call([&] { slosh_events(rig.record(), 0.0, 10.0); }),
              ThrowsMessage<InvalidInput>(HasSubstr("found 0 .. 10 Hz")));
}

}  // namespace
}  // namespace boresight::identification
