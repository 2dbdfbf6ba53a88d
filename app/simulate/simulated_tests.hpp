#pragma once

#include <cstdint>
#include <string>

#include <boresight/design/simulation/test_runs.hpp>
#include <boresight/io/case/case_declaration.hpp>

namespace boresight::app {

/// The controller that a simulated position loop runs on.
struct SimulatedController {
  control::Controller controller;
  std::string source;  // of its gains, in words
};

/// A simulated test of the drive and what was done, in words.
struct DriveTestSection : design::DriveTestRecord {
  std::string description;
};

/// A simulated run of the position loop and what was done, in words.
struct PositionTestSection : design::PositionTestRecord {
  std::string description;
};

DriveTestSection section_of(design::DriveTestRecord record);

/// `antenna`: the case that ran; `source`: of the controller's gains.
PositionTestSection section_of(design::PositionTestRecord record, const io::Case& antenna,
                               const std::string& source);

/// Runs "slew", else tracking, on the antenna of a case. @throws InvalidInput as
/// io::make_nonlinear_antenna and io::mission_of; as design::run_tracking and run_slew, what is out
/// of reach with the path of the case.
design::PositionTestRecord run_position_test(const io::Case& antenna, const std::string& test,
                                             const control::Controller& controller,
                                             std::uint64_t seed,
                                             const design::RunProgress& progress);

}  // namespace boresight::app
