#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <boresight/app/benchmark/benchmark_report.hpp>
#include <boresight/app/commands/subcommand.hpp>
#include <boresight/app/tune/chosen_controller.hpp>

namespace boresight::app {

/// Records before and after a change of the controller, and the controller before.
struct ChangeArguments {
  std::vector<std::string> before, after;  // files
  std::vector<std::string> old_gains;      // KEY=VALUE; empty: of old_controller or the case
  std::string old_structure;   // of old_gains; empty: the present one of the case, or DPF
  std::string old_controller;  // file of a state space; empty: none
  std::string record_path;     // of the change record; empty: none

  bool asked() const {
    return !before.empty() || !after.empty() || !old_gains.empty() || !old_structure.empty() ||
           !old_controller.empty() || !record_path.empty();
  }
};

struct BenchmarkArguments {
  std::string case_path;
  Outputs outputs;
  ControllerOptions controller;
  std::string export_path;   // where the controller in use is written; empty: nowhere
  std::string compare_path;  // another score sheet; empty: none
  bool sampled = false;      // the controller in its sampled form
  ChangeArguments change;    // asked(): compare records instead of scoring
  std::uint64_t seed = 1;
  unsigned threads = 0;  // 0: all
};

/// recommended_controller with progress, for the arguments' seed, threads and structure.
ChosenController recommended_of(const BenchmarkArguments& arguments,
                                const io::DesignedAntenna& designed,
                                const std::function<bool()>& interrupted);

/// Scores the requested controller on the antenna of the case or, for a case with records, on the
/// identified one. After `interrupted` returned true, the report holds the completed parts.
/// @throws InvalidInput for invalid arguments, cases or files; Interrupted before the controller is
/// known; InfeasibleRequirement as recommended_controller.
BenchmarkReport benchmark_case(const BenchmarkArguments& arguments,
                               const std::function<bool()>& interrupted);

Subcommand add_benchmark(CLI::App& program);

}  // namespace boresight::app
