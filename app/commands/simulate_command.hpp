#pragma once

#include <cstdint>
#include <exception>
#include <functional>
#include <string>
#include <vector>

#include <boresight/app/commands/subcommand.hpp>
#include <boresight/app/simulate/simulation_report.hpp>
#include <boresight/app/tune/chosen_controller.hpp>

namespace boresight::app {

struct SimulateArguments {
  std::string case_path;
  std::vector<std::string> tests;  // as design::simulated_test_names()
  std::string folder = ".";        // where records go
  std::string format = "csv";      // of the records: "csv" or "mat"
  Outputs outputs;
  std::uint64_t seed = 1;
  double sample_rate = 0.0;      // Hz, of the records; 0: as the case has it
  ControllerOptions controller;  // of tracking and slew
  unsigned threads = 1;          // so many records at a time; they do not depend on it
};

/// Runs the tests on the nonlinear antenna of the case. Writes a record of each, TEST.csv or
/// TEST.mat, into the folder, which is created if missing. `interrupted` is called from time to
/// time, by one thread at a time. After it returned true, records in progress are written up to
/// that time, marked as incomplete, and the rest is left out. A failed test also ends the work: the
/// report covers the tests before it, `failure` holds the error.
struct SimulateOutcome {
  SimulationReport report;
  std::exception_ptr failure;
};
/// @throws InvalidInput for an unknown test or one given twice, a folder or JSON file that cannot
/// be written to, and a case without what simulations need: before anything is run; as
/// recommended_controller, whose interrupt leaves a report of no test.
SimulateOutcome simulate_tests(const SimulateArguments& arguments,
                               const std::function<bool()>& interrupted);

Subcommand add_simulate(CLI::App& program);

}  // namespace boresight::app
