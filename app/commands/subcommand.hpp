#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace CLI {
class App;
}

namespace boresight::app {

enum ExitCode {
  done = 0,
  internal_error = 1,
  bad_input = 2,
  infeasible = 3,
  numerical = 4,
  interrupted = 130
};

/// A command of the program: its options, and what it does once they are parsed. `run` returns an
/// exit code and throws InvalidInput (2), NumericalFailure (4) and anything else (1).
struct Subcommand {
  CLI::App* options = nullptr;
  std::function<int()> run;
};

// Options that commands share.
void add_case(CLI::App& command, std::string& path);
void add_json(CLI::App& command, std::string& path);
void add_seed(CLI::App& command, std::uint64_t& seed);
/// Sets the number to 0, the default: all; see all_or.
void add_threads(CLI::App& command, unsigned& threads);
/// The number of threads asked for, of the machine's for 0.
unsigned all_or(unsigned threads);

/// From here on Ctrl-C no longer ends the program but is seen by interrupt_requested().
void watch_for_interrupt();
bool interrupt_requested();

/// Whether a report's JSON goes to a file; @throws InvalidInput if it cannot be written to. To be
/// asked before the work, not after it.
void require_json_path(const std::string& path);
/// The text to standard output, the JSON also to a file; or, for the path "-", the JSON alone to
/// standard output. Each is made only if it is written. @throws InvalidInput if one cannot be
/// written.
void deliver(const std::string& json_path, const std::function<std::string()>& text,
             const std::function<std::string()>& json);

}  // namespace boresight::app
