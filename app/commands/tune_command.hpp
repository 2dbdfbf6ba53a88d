#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <boresight/app/commands/subcommand.hpp>
#include <boresight/app/report/report.hpp>

namespace boresight::app {

struct TuneArguments {
  std::string case_path;
  Outputs outputs;
  std::vector<std::string> structures;  // empty: as the case has it
  std::vector<std::string> goals;       // changes of [goals], KEY=VALUE
  std::vector<std::string> speeds;      // of the wind, with unit; empty: the case's design speed
  int starts = 0;                       // 0: as the case has it
  std::uint64_t seed = 1;
  unsigned threads = 0;  // 0: all
  /// A record of the case whose response takes the model's place; empty: none.
  std::string measured_record;
};

/// Tunes and judges. With records the plant is the one they show and the ensemble is drawn from
/// what they leave open; else it is drawn from the case's ranges. After `interrupted` said yes the
/// report holds the best laws found so far.
/// @throws InvalidInput for arguments and cases that cannot be worked on: before anything is tuned.
Report tune_case(const TuneArguments& arguments, const std::function<bool()>& interrupted);

Subcommand add_tune(CLI::App& program);

}  // namespace boresight::app
