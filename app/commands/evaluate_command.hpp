#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <boresight/app/commands/subcommand.hpp>
#include <boresight/app/report/report.hpp>

namespace boresight::app {

struct EvaluateArguments {
  std::string case_path;
  std::vector<std::string> proposals;  // files
  Outputs outputs;
  std::vector<std::string> structures;  // empty: PI
  std::vector<std::string> goals;       // changes of [goals], KEY=VALUE
  std::size_t random_samples = 2000;
  int starts = 0;           // 0: as the case has it
  bool time_domain = true;  // run controllers on the nonlinear antenna
  std::uint64_t seed = 1;
  unsigned threads = 0;  // 0: all
};

/// Tunes the present antenna and each proposal, and compares them. With records, the antenna is the
/// identified one, and the uncertainty is what the records leave.
/// @throws InvalidInput for invalid arguments, cases or proposals, before any tuning.
Report evaluate_case(const EvaluateArguments& arguments, const std::function<bool()>& interrupted);

Subcommand add_evaluate(CLI::App& program);

}  // namespace boresight::app
