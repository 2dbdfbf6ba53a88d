#include <algorithm>
#include <cctype>
#include <exception>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <boresight/app/commands/command_line.hpp>
#include <boresight/app/commands/program.hpp>
#include <boresight/io/files/input_files.hpp>
#include <boresight/numerics/error.hpp>

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
  const Program program = make_program();
  try {
    program.options->parse(argc, argv);
  } catch (const CLI::Success& asked) {
    return program.options->exit(asked);
  } catch (const CLI::ParseError&) {
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    fmt::print(stderr, "boresight: {}\nRun with --help for more information.\n",
               parse_refusal(arguments));
    return bad_input;
  }
  try {
    for (const auto& command : program.commands) {
      if (!command.options->parsed()) continue;
      if (command.outputs != nullptr) command.outputs->command_line = command_line_text(argc, argv);
      const int code = command.run();
      for (const auto& warning : io::warnings_noted())
        fmt::print(stderr, "boresight: {}\n", warning);
      return code;
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
