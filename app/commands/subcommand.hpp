#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <boresight/app/document/document.hpp>
#include <boresight/app/page/page.hpp>
#include <boresight/io/files/write_atomically.hpp>

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

struct Outputs;

/// Each code with its meaning in a few words, in the order of the codes.
const std::vector<std::pair<ExitCode, std::string>>& exit_code_meanings();

/// A command of the program: its options, and what it does once they are parsed. `run` returns an
/// exit code and throws InvalidInput (2), NumericalFailure (4) and anything else (1).
struct Subcommand {
  CLI::App* options = nullptr;
  std::function<int()> run;
  Outputs* outputs = nullptr;  // of `run`, which keeps them
};

// Options common to several commands.
void add_case(CLI::App& command, std::string& path);
void add_seed(CLI::App& command, std::uint64_t& seed);
/// Sets the number to 0, the default: all; see all_or.
void add_threads(CLI::App& command, unsigned& threads);
/// The requested number of threads; for 0 that of the machine.
unsigned all_or(unsigned threads);

/// The flag --quiet: neither text nor progress; errors are still reported.
void add_quiet(CLI::App& command);
/// Whether it was given.
bool quiet();

/// From here on Ctrl-C no longer ends the program but is seen by interrupt_requested().
void watch_for_interrupt();
bool interrupt_requested();

/// The results of a command in each output form; computed only on request.
struct Findings {
  std::function<Document()> document;
  std::function<std::string()> json;
  std::function<Page()> page;
  /// Linear models as a MAT file; empty where there are none.
  std::function<std::string()> mat = {};
};

/// Destinations of a command's results, in addition to standard output.
struct Outputs {
  std::string json_path;      // "-": to standard output instead of the text; empty: nowhere
  std::string report_path;    // of the page; empty: none
  std::string mat_path;       // of the linear models; empty: none
  std::string curves_folder;  // of the figures' points as CSV; empty: none
  bool details = false;       // the whole text to standard output, not its short form
  std::string command_line;   // as it was given, for the page

  /// Call it before the work starts.
  /// @throws InvalidInput if one of them cannot be written to.
  void require_writable() const;
  /// Writes the text, or its short form, to standard output unless quiet(), or the JSON for the
  /// path "-". Writes the other forms where requested.
  /// @throws InvalidInput if one cannot be written.
  void deliver(const Findings& findings) const;

 private:
  std::string printed(const Document& document) const;
};

/// The options that fill `outputs`: the same of every command.
void add_outputs(CLI::App& command, Outputs& outputs);
/// And that of the commands that have linear models to write.
void add_mat(CLI::App& command, Outputs& outputs);

}  // namespace boresight::app
