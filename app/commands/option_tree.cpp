#include <algorithm>

#include <CLI/CLI.hpp>

#include <boresight/app/commands/manual_commands.hpp>
#include <boresight/app/commands/option_tree.hpp>
#include <boresight/app/report/report_schemas.hpp>
#include <boresight/control/controllers/usual_structures.hpp>
#include <boresight/design/problem/mission.hpp>
#include <boresight/design/simulation/drive_tests.hpp>

namespace boresight::app {
namespace {

// What the program knows of an option's values without a case.
std::vector<std::string> known_words(const std::string& command, const std::string& option) {
  if (option == "--structure") {
    std::vector<std::string> names = control::usual_structures();
    names.emplace_back(design::state_space_name);
    return names;
  }
  if (option == "TEST") return design::simulated_test_names();
  if (option == "SHELL") return completion_shells();
  if (option == "REPORT") return {described_reports().begin(), described_reports().end()};
  if (option == "--time-domain") return {"none", "few", "all"};
  if (command == "montecarlo" && option == "--gains") return {"tuned", "case"};
  return {};
}

// Of the parser's "UINT:INT in [1 - 100]" only the range is for people.
void name_value(const std::string& type, OptionText& text) {
  text.value = type;
  const auto colon = type.find(':');
  const auto open = type.find('[', colon);
  const auto between = type.find(" - ", open);
  if (colon != std::string::npos && between != std::string::npos) {
    text.range = type.substr(open + 1, between - open - 1) + " to " +
                 type.substr(between + 3, type.find(']', between) - between - 3);
    text.value = type.substr(0, colon);
  } else if (colon != std::string::npos) {
    text.range = type.substr(colon + 1);
    text.value = "NAME";
  }
  for (const auto* number : {"UINT", "INT", "FLOAT"}) {
    if (text.value == number) text.value = "NUMBER";
  }
}

OptionText text_of(const CLI::Option& option, const std::string& command) {
  OptionText text;
  text.argument = option.get_positional();
  if (text.argument) {
    text.names.push_back(option.get_name(true));
  } else {
    for (const auto& name : option.get_snames()) text.names.push_back("-" + name);
    for (const auto& name : option.get_lnames()) text.names.push_back("--" + name);
  }
  text.required = option.get_required();
  text.several = option.get_items_expected_max() > 1;
  if (option.get_items_expected_max() > 0) {
    name_value(option.get_type_name(), text);
    text.default_value = option.get_default_str();
    text.files = text.value == "FILE"     ? ValueFiles::files
                 : text.value == "FOLDER" ? ValueFiles::folders
                                          : ValueFiles::none;
    text.words = known_words(command, text.names.back());
  }
  text.description = option.get_description();
  return text;
}

std::vector<OptionText> options_of(const CLI::App& command) {
  std::vector<OptionText> texts;
  for (const CLI::Option* option : command.get_options()) {
    texts.push_back(text_of(*option, command.get_name()));
  }
  // Arguments first, in their order.
  std::ranges::stable_partition(texts, [](const OptionText& text) { return text.argument; });
  return texts;
}

}  // namespace

CommandText describe_command(const CLI::App& command) {
  return {command.get_name(), command.get_description(), options_of(command)};
}

ProgramText describe_program(const CLI::App& program) {
  ProgramText text;
  text.description = program.get_description();
  text.options = options_of(program);
  for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; })) {
    text.commands.push_back(describe_command(*command));
  }
  return text;
}

}  // namespace boresight::app
