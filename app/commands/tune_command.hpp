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
  /// Omits the lower bound of any linear controller, and with it the state-space controller.
  bool no_limit = false;
};

/// Tunes and evaluates controllers. With records, the plant is the identified one and the ensemble
/// is sampled from the uncertainty that the records leave. Without records, it is sampled from the
/// case's ranges. After `interrupted` returned true, the report holds the best controllers found so
/// far.
/// @throws InvalidInput for invalid arguments or cases, before any tuning.
Report tune_case(const TuneArguments& arguments, const std::function<bool()>& interrupted);

Subcommand add_tune(CLI::App& program);

}  // namespace boresight::app
