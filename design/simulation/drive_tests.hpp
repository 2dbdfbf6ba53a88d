#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include <boresight/plant/nonlinear/nonlinear_antenna.hpp>
#include <boresight/plant/nonlinear/recorder.hpp>

namespace boresight::design {

/// The analog loop that some tests close around the drive, u = gain (1 + w/s) (command -
/// tachometer), where w is the corner in rad/s. u and the rates in rad/s of motor.
struct RateLoop {
  double gain = 0.0;
  double corner = 0.0;  // Hz
};

/// A drive and its test equipment. SI, at the motor shaft.
struct TestedDrive {
  plant::NonlinearAntenna antenna;
  double slew_rate = 0.0;  // rad/s of motor
  RateLoop rate_loop;
  plant::Recorder recorder;
};

/// The tests of Sommerville's paper, and small valve steps and a valve sine about a constant speed.
enum class DriveTestKind {
  slosh,           // the valve opens and closes suddenly
  fast_ramp,       // a triangle to the valve that leaves the recorder's range
  slow_ramp,       // a triangle into the rate loop, through breakaway
  constant_speed,  // a square wave into the rate loop
  valve_steps,
  valve_chirp  // 0.1 to 8 Hz
};
std::string_view to_string(DriveTestKind kind);

/// The kind with that name (to_string); none for any other name.
std::optional<DriveTestKind> drive_test_kind(std::string_view name);

/// Names of all tests that can be simulated: those of the drive, "tracking" (run_tracking), "slew"
/// (run_slew).
const std::vector<std::string>& simulated_test_names();

/// A test of the drive: a command at the recorder's samples.
struct DriveTest {
  DriveTestKind kind = DriveTestKind::slosh;
  std::string name;               // that of the kind; for a constant speed with its volts
  double tachometer_volts = 0.0;  // of a constant speed
  double sample_time = 0.0;       // s
  bool rate_loop_closed = false;  // true: rate loop command; false: valve command
  bool held = false;              // hold until the next sample; else interpolate linearly
  Eigen::VectorXd command;        // rad/s of motor
};

/// The tests of one kind, one per record: six of constant speeds, a factor of two apart, one of any
/// other kind. Amplitudes follow from the tachometer's limit and the valve's stroke. Sampled at the
/// recorder's rate, slosh at 1000 Hz at least.
/// @throws InvalidInput for a recorder whose sample rate, or whose tachometer's scale or limit, is
/// not above 0.
std::vector<DriveTest> drive_tests(const TestedDrive& drive, DriveTestKind kind);

}  // namespace boresight::design
