#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace boresight::app {

struct SimulateArguments {
  std::string case_path;
  std::vector<std::string> tests;  // as simulated_test_names()
  std::string folder = ".";        // where records go
  std::uint64_t seed = 1;
};

/// Runs the tests on the nonlinear antenna of the case, writes a record TEST.csv of each into the
/// folder (made if it is not there) and returns the report. `interrupted` is asked now and then;
/// after it said yes the record under way is written up to there, marked as incomplete, and the
/// rest is left out.
struct SimulateOutcome {
  std::string report;
  bool complete = true;
};
/// @throws InvalidInput for an unknown test or one given twice, a folder that cannot be written to,
/// and a case without what simulations need; as run_drive_test and run_tracking.
SimulateOutcome simulate_tests(const SimulateArguments& arguments,
                               const std::function<bool()>& interrupted);

}  // namespace boresight::app
