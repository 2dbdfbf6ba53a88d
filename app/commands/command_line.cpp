#include <algorithm>
#include <cctype>
#include <exception>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <boresight/app/commands/benchmark_command.hpp>
#include <boresight/app/commands/command_line.hpp>
#include <boresight/app/commands/commission_command.hpp>
#include <boresight/app/commands/evaluate_command.hpp>
#include <boresight/app/commands/match_command.hpp>
#include <boresight/app/commands/montecarlo_command.hpp>
#include <boresight/app/commands/report_commands.hpp>
#include <boresight/app/commands/simulate_command.hpp>
#include <boresight/app/commands/tune_command.hpp>
#include <boresight/plant/error.hpp>

namespace boresight::app {

namespace {

// As a shell would take it again; the program by its name alone.
std::string command_line_text(int argc, char** argv) {
  std::string text = "boresight";
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const bool plain = !word.empty() && std::ranges::all_of(word, [](unsigned char c) {
      return std::isalnum(c) != 0 ||
             std::string_view("-_./=+,:@%").find(static_cast<char>(c)) != std::string_view::npos;
    });
    if (plain) {
      text += " " + word;
      continue;
    }
    text += " '";
    for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    text += "'";
  }
  return text;
}

}  // namespace

int run_command_line(int argc, char** argv) {
  CLI::App program{"Redesigns the servo of a large antenna from measured data.", "boresight"};
  program.set_version_flag("--version", std::string("boresight ") + BORESIGHT_VERSION);
  program.require_subcommand(1);
  program.footer(
      "Exit codes: 0 done, 1 internal error, 2 bad input, 3 goals infeasible, 4 numerical failure, "
      "130 interrupted.\n"
      "Example: boresight redesign cases/dss14-70m/case.toml --json report.json");
  std::vector<Subcommand> commands = add_report_commands(program);
  commands.push_back(add_simulate(program));
  commands.push_back(add_benchmark(program));
  commands.push_back(add_tune(program));
  commands.push_back(add_match(program));
  commands.push_back(add_montecarlo(program));
  commands.push_back(add_evaluate(program));
  commands.push_back(add_commission(program));
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? done : bad_input;
  }
  try {
    for (const auto& command : commands) {
      if (!command.options->parsed()) continue;
      command.outputs->command_line = command_line_text(argc, argv);
      return command.run();
    }
  } catch (const InvalidInput& error) {
    fmt::print(stderr, "boresight: {}\n", error.what());
    return bad_input;
  } catch (const InfeasibleRequirement& error) {
    fmt::print(stderr, "boresight: {}\n", error.what());
    return infeasible;
  } catch (const NumericalFailure& error) {
    fmt::print(stderr, "boresight: {}\n", error.what());
    return numerical;
  } catch (const std::system_error&) {
    // The formatting library's word for a full or closed standard output.
    fmt::print(stderr, "boresight: standard output: cannot be written to\n");
    return bad_input;
  } catch (const std::exception& error) {
    fmt::print(stderr, "boresight: internal error: {}\n", error.what());
  }
  return internal_error;
}

}  // namespace boresight::app
