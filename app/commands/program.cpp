#include <algorithm>
#include <map>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <boresight/app/commands/benchmark_command.hpp>
#include <boresight/app/commands/command_examples.hpp>
#include <boresight/app/commands/commission_command.hpp>
#include <boresight/app/commands/evaluate_command.hpp>
#include <boresight/app/commands/export_command.hpp>
#include <boresight/app/commands/help_text.hpp>
#include <boresight/app/commands/manual_commands.hpp>
#include <boresight/app/commands/match_command.hpp>
#include <boresight/app/commands/montecarlo_command.hpp>
#include <boresight/app/commands/new_command.hpp>
#include <boresight/app/commands/program.hpp>
#include <boresight/app/commands/report_commands.hpp>
#include <boresight/app/commands/simulate_command.hpp>
#include <boresight/app/commands/tune_command.hpp>
#include <boresight/io/case/field.hpp>
#include <boresight/io/units/wording.hpp>

namespace boresight::app {
namespace {

// What help, manual and completion call a value, where that is more than "TEXT".
void name_values(CLI::App& command) {
  static const std::map<std::string, const char*> values{{"CASE", "FILE"},
                                                         {"PROPOSAL", "FILE"},
                                                         {"--json", "FILE"},
                                                         {"--csv", "FILE"},
                                                         {"--checkpoint", "FILE"},
                                                         {"--controller", "FILE"},
                                                         {"--export-controller", "FILE"},
                                                         {"--compare", "FILE"},
                                                         {"--report", "FILE"},
                                                         {"--mat", "FILE"},
                                                         {"--folder", "FOLDER"},
                                                         {"--curves", "FOLDER"},
                                                         {"--structure", "NAME"},
                                                         {"--measured", "RECORD"},
                                                         {"--before", "RECORD"},
                                                         {"--after", "RECORD"},
                                                         {"--goal", "KEY=VALUE"},
                                                         {"--old-gains", "KEY=VALUE"},
                                                         {"--old-structure", "NAME"},
                                                         {"--speed", "SPEED"},
                                                         {"--inputs", "NAMES"},
                                                         {"--outputs", "NAMES"},
                                                         {"TEST", "NAME"},
                                                         {"ANTENNA", "FOLDER"},
                                                         {"SHELL", "NAME"},
                                                         {"REPORT", "NAME"}};
  for (CLI::Option* option : command.get_options()) {
    const auto named = values.find(option->get_name(option->get_positional()));
    if (named != values.end()) option->type_name(named->second);
  }
  CLI::Option* gains = command.get_option_no_throw("--gains");
  if (gains != nullptr) {
    gains->type_name(command.get_name() == "commission" ? "KEY=VALUE" : "FILE");
  }
  for (const char* records : {"--before", "--after"}) {
    CLI::Option* option = command.get_option_no_throw(records);
    if (option != nullptr && command.get_name() == "benchmark") option->type_name("FILE");
  }
}

std::vector<std::string_view> names_of(const std::vector<std::string>& names) {
  return {names.begin(), names.end()};
}

// The name of an option without what is given to it: "--json" of "--json=report.json".
std::string option_name(const std::string& argument) {
  return argument.substr(0, argument.find('='));
}

// The first option among the arguments that the command does not have.
std::string refused_option(const CLI::App& command, const std::vector<std::string>& arguments) {
  std::vector<std::string> known;
  for (const CLI::Option* option : command.get_options()) {
    for (const auto& name : option->get_lnames()) known.push_back("--" + name);
  }
  for (const auto& argument : arguments) {
    const std::string name = option_name(argument);
    if (!name.starts_with("--") || name == "--" || std::ranges::find(known, name) != known.end()) {
      continue;
    }
    return fmt::format("{}expected one of the options, found {}{}",
                       command.get_parent() == nullptr ? "" : command.get_name() + ": ",
                       io::in_quotes(name), io::did_you_mean(name, names_of(known)));
  }
  return {};
}

// A misspelt command, or a misspelt option of a command; else what the parser says.
std::string explained(const CLI::App& program, const std::vector<std::string>& arguments,
                      const CLI::ParseError& error) {
  std::vector<std::string> commands;
  for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; })) {
    commands.push_back(command->get_name());
  }
  if (arguments.empty()) return "expected a command, found none";
  const std::string& first = arguments.front();
  if (first.starts_with("-")) return refused_option(program, {first});
  if (std::ranges::find(commands, first) == commands.end()) {
    return fmt::format("expected one of the commands {}, found {}{}",
                       io::quoted_list(names_of(commands)), io::in_quotes(first),
                       io::did_you_mean(first, names_of(commands)));
  }
  const std::string option =
      refused_option(*program.get_subcommand(first), {arguments.begin() + 1, arguments.end()});
  return option.empty() ? fmt::format("{}: {}", first, error.what()) : option;
}

}  // namespace

Program make_program() {
  Program program;
  program.options = std::make_shared<CLI::App>(
      "Redesigns the servo of a large antenna from measured data.", "boresight");
  CLI::App& options = *program.options;
  // Commands take it over from here.
  options.formatter(std::make_shared<HelpText>());
  options.set_help_flag("-h,--help", "print this text");
  options.set_version_flag("--version", std::string("boresight ") + BORESIGHT_VERSION,
                           "print the program's version");
  options.require_subcommand(1);
  program.commands.push_back(add_new(options));
  for (auto& command : add_report_commands(options)) program.commands.push_back(command);
  program.commands.push_back(add_simulate(options));
  program.commands.push_back(add_benchmark(options));
  program.commands.push_back(add_tune(options));
  program.commands.push_back(add_match(options));
  program.commands.push_back(add_montecarlo(options));
  program.commands.push_back(add_evaluate(options));
  program.commands.push_back(add_commission(options));
  program.commands.push_back(add_export(options));
  for (const auto& command : program.commands) add_quiet(*command.options);
  program.commands.push_back(add_completion(options));
  program.commands.push_back(add_manual(options));
  program.commands.push_back(add_schema(options));
  std::string codes;
  for (const auto& [code, meaning] : exit_code_meanings()) {
    codes += fmt::format("{}{} {}", codes.empty() ? "" : ", ", static_cast<int>(code), meaning);
  }
  options.footer(fmt::format("{}\nExit codes: {}.\n", examples_text(""), codes));
  for (const auto& command : program.commands) {
    name_values(*command.options);
    command.options->footer(examples_text(command.options->get_name()));
  }
  return program;
}

std::string parse_refusal(const std::vector<std::string>& arguments) {
  const Program program = make_program();
  // The parser takes them from the back.
  std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());
  try {
    program.options->parse(std::move(reversed));
  } catch (const CLI::Success&) {
    return {};
  } catch (const CLI::ParseError& error) {
    const std::string explanation = explained(*program.options, arguments, error);
    return explanation.empty() ? error.what() : explanation;
  }
  return {};
}

}  // namespace boresight::app
