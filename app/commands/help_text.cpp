#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/commands/help_text.hpp>
#include <boresight/app/commands/option_tree.hpp>
#include <boresight/app/document/document_text.hpp>

namespace boresight::app {
namespace {

constexpr std::size_t text_column = 26;

// A name and its explanation, in two columns.
std::string entry(const std::string& name, const std::string& explanation) {
  std::string lines = to_text(wrapped(explanation, std::string(text_column, ' ')));
  const std::string left = "  " + name;
  if (left.size() + 2 > text_column) return left + "\n" + lines;
  return lines.replace(0, left.size(), left);
}

std::string explanation(const OptionText& option) {
  std::vector<std::string> remarks;
  if (!option.range.empty()) remarks.push_back(option.range);
  if (!option.default_value.empty()) remarks.push_back("default " + option.default_value);
  if (remarks.empty()) return option.description;
  return fmt::format("{} ({})", option.description, fmt::join(remarks, "; "));
}

std::string options_text(const std::vector<OptionText>& options) {
  std::string arguments, named;
  for (const auto& option : options) {
    const std::string several = option.several ? " ..." : "";
    if (option.argument) {
      arguments += entry(option.names.back() + several, explanation(option));
    } else {
      named += entry(fmt::format("{}{}", fmt::join(option.names, ", "),
                                 option.value.empty() ? "" : " " + option.value + several),
                     explanation(option));
    }
  }
  return (arguments.empty() ? "" : "\nArguments:\n" + arguments) +
         (named.empty() ? "" : "\nOptions:\n" + named);
}

}  // namespace

std::string HelpText::make_help(const CLI::App* command, std::string name,
                                CLI::AppFormatMode /*mode*/) const {
  const CommandText text = describe_command(*command);
  std::string usage = "usage: " + name;
  for (const auto& option : text.options) {
    if (option.argument) usage += " " + option.names.back() + (option.several ? " ..." : "");
  }
  const auto commands = command->get_subcommands([](const CLI::App*) { return true; });
  usage += commands.empty() ? " [OPTIONS]" : " COMMAND [OPTIONS]";
  std::string help = to_text(wrapped(text.description, "")) + "\n" + usage + "\n";
  if (!commands.empty()) help += "\nCommands:\n";
  for (const CLI::App* one : commands) help += entry(one->get_name(), one->get_description());
  help += options_text(text.options);
  return help + "\n" + command->get_footer();
}

}  // namespace boresight::app
