#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <boresight/app/simulate/antenna_tests.hpp>
#include <boresight/app/simulate/run_events.hpp>
#include <boresight/io/records/csv_table.hpp>

namespace boresight::app {

/// Asked with the part of a run that is done (0..1); false ends it.
using RunProgress = std::function<bool(double done)>;

/// A channel whose samples left the recorder's range and were written as its end.
struct ClippedChannel {
  std::string name;
  long long samples = 0;
  double first = 0.0;  // s
};

/// What the recorder wrote in a test, and what happened.
struct DriveRecord {
  std::string test;
  std::string description;
  io::CsvTable record;
  bool complete = true;
  double duration = 0.0;  // s simulated
  double sample_time = 0.0;
  double largest_rate = 0.0;    // rad/s of motor, true
  double largest_torque = 0.0;  // N m, true
  double at_limit = 0.0;        // share of tachometer samples at the recorder's limit
  /// N m: largest friction, without gravity's offset, below 0.02 rad/s of motor, true.
  double static_friction = 0.0;
  double curve_breakaway = 0.0;  // N m, of the case's friction curve: beside that of the events
  RunEvents events;
  std::vector<ClippedChannel> clipped;
};

/// Runs a drive test on the nonlinear antenna of the case, from rest, and writes what its recorder
/// would: through its low-pass if it has one, time, pressures at the inlet and outlet port of each
/// motor (MPa), tachometer, rate and valve commands (V; 10 V are the slew rate and the full
/// stroke). A run that is ended gives the samples up to there, with a comment that says so.
/// @throws InvalidInput as drive_tests; NumericalFailure as plant::simulate.
DriveRecord run_drive_test(const io::Case& antenna, const AntennaTest& test, std::uint64_t seed,
                           const RunProgress& progress);

}  // namespace boresight::app
