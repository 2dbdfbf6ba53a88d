#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <boresight/design/simulation/drive_tests.hpp>
#include <boresight/design/simulation/simulated_record.hpp>

namespace boresight::design {

/// A channel with samples beyond the recorder's range, which were recorded at the end of the range.
struct ClippedChannel {
  std::string name;
  long long samples = 0;
  double first = 0.0;  // s
};

/// The recorded channels of a test of the drive, and the true values, at the motor shaft.
struct DriveTestRecord : SimulatedRecord {
  DriveTestKind kind = DriveTestKind::slosh;
  double tachometer_volts = 0.0;  // of a constant speed
  double largest_rate = 0.0;      // rad/s
  double largest_torque = 0.0;    // N m
  double at_limit = 0.0;          // fraction of tachometer samples at the recorder's limit
  /// N m: largest friction, without gravity's offset, below 0.02 rad/s.
  double static_friction = 0.0;
  double curve_breakaway = 0.0;  // N m, of the friction curve; events have their own breakaway
  std::vector<ClippedChannel> clipped;
};

/// Runs a test on the nonlinear antenna, from rest, and returns what its recorder would record,
/// low-pass filtered if it has a filter. Channels: time, pressures at the inlet and outlet port of
/// each motor (p1_in, p1_out, ..., MPa), tachometer (tach, V), rate_command and valve_command (V;
/// 10 V are the slew rate and the full stroke). Gains and zeros of the sensors depend on the seed
/// and are the same in every test; the noise depends on seed and test. An interrupted run returns
/// the samples up to that time.
/// @throws InvalidInput for an antenna without oil lines, at whose ends the pressures are measured,
/// and as plant::steps_per_sample and plant::readings; NumericalFailure as plant::simulate.
DriveTestRecord run_drive_test(const TestedDrive& drive, const DriveTest& test, std::uint64_t seed,
                               const RunProgress& progress);

}  // namespace boresight::design
