#pragma once

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <boresight/identification/records/record_defects.hpp>

/// A record as a recorder writes it, with nothing wrong: for tests to spoil.
namespace boresight::identification::swinging {

using Index = Eigen::Index;

inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();
inline constexpr double step = 0.005;
inline constexpr Index length = 4000;

inline double noise(Index i, int channel) {
  const double phase = 12.9898 * static_cast<double>(i + 1) + 78.233 * channel;
  const double value = std::sin(phase) * 43758.5453;
  return value - std::floor(value) - 0.5;
}

inline double rate_at(double t) {
  return 8.0 * std::sin(2.0 * std::numbers::pi * 0.3 * t);
}

// Four motors swinging against friction, transducers with noise.
inline RawRecord healthy() {
  RawRecord raw;
  raw.name = "swing";
  raw.test = TestKind::other;
  raw.time.resize(length);
  raw.inlet.resize(4);
  raw.outlet.resize(4);
  raw.tachometer.values.resize(length);
  raw.rate_command.emplace();
  raw.rate_command->name = "command";
  raw.rate_command->values.resize(length);
  raw.tachometer.name = "tach";
  for (int motor = 0; motor < 4; ++motor) {
    const auto at = static_cast<std::size_t>(motor);
    raw.inlet[at].name = "p" + std::to_string(motor + 1) + "_in";
    raw.outlet[at].name = "p" + std::to_string(motor + 1) + "_out";
    raw.inlet[at].values.resize(length);
    raw.outlet[at].values.resize(length);
  }
  for (Index i = 0; i < length; ++i) {
    const double t = step * static_cast<double>(i);
    raw.time[i] = std::round(t * 1000.0) / 1000.0;
    const double rate = rate_at(t);
    raw.tachometer.values[i] = rate + 0.02 * noise(i, 0);
    raw.rate_command->values[i] = rate;
    for (int motor = 0; motor < 4; ++motor) {
      const auto at = static_cast<std::size_t>(motor);
      const double half = 0.5e6 * std::tanh(rate);
      raw.inlet[at].values[i] = 7e6 + half + 1e4 * motor + 5e3 * noise(i, 1 + motor);
      raw.outlet[at].values[i] = 7e6 - half - 1e4 * motor + 5e3 * noise(i, 5 + motor);
    }
  }
  return raw;
}

inline std::vector<RecordDefect> of(const CleanRecord& clean, DefectKind kind) {
  std::vector<RecordDefect> found;
  for (const auto& defect : clean.defects) {
    if (defect.kind == kind) found.push_back(defect);
  }
  return found;
}

// The one defect of a record that has no other.
inline RecordDefect only(const CleanRecord& clean, DefectKind kind) {
  EXPECT_EQ(clean.defects.size(), 1U);
  for (const auto& defect : clean.defects) {
    EXPECT_EQ(to_string(defect.kind), to_string(kind)) << defect.channel << defect.explanation;
  }
  const auto found = of(clean, kind);
  return found.empty() ? RecordDefect{} : found.front();
}

inline Index invalid_count(const Signal& signal) {
  Index count = 0;
  for (Index i = 0; i < signal.values.size(); ++i) count += signal.is_valid(i) ? 0 : 1;
  return count;
}

}  // namespace boresight::identification::swinging
