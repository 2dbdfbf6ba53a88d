#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include <boresight/io/case/case_file.hpp>

namespace boresight::app {

/// A test of the drive as it is run on the antenna: a command at the recorder's samples.
struct AntennaTest {
  std::string name;  // of its file
  std::string description;
  double sample_time = 0.0;       // s
  bool rate_loop_closed = false;  // the command is the rate loop's; else the valve's
  bool held = false;              // keeps each value until the next sample; else straight between
  Eigen::VectorXd command;        // rad/s of motor
};

/// What `boresight simulate` knows: the tests of the paper (slosh, fast-ramp, slow-ramp,
/// constant-speed), valve-steps and valve-chirp, tracking and slew.
const std::vector<std::string>& simulated_test_names();

/// The drive tests of that name: one a file. Amplitudes follow from the case: tachometer limit,
/// valve stroke, slew rate. Nothing for tracking and slew, which are runs of the position loop.
/// @throws InvalidInput for an unknown name, or a case without recorder, tachometer or oil line.
std::vector<AntennaTest> drive_tests(const io::Case& antenna, const std::string& name);

}  // namespace boresight::app
