#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/commands/command_examples.hpp>
#include <boresight/app/commands/man_page.hpp>
#include <boresight/app/commands/subcommand.hpp>

namespace boresight::app {
namespace {

// Text of a line: a minus is no hyphen, and a line's first point or quote is no request.
std::string troff(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '\\') {
      result += "\\e";
    } else if (c == '-') {
      result += "\\-";
    } else if (c == '\'') {
      result += "\\(aq";
    } else {
      result += c;
    }
  }
  return result.starts_with('.') ? "\\&" + result : result;
}

// A macro's argument in double quotes.
std::string argument(std::string_view text) {
  std::string result;
  for (const char c : troff(text)) result += c == '"' ? std::string("\\(dq") : std::string(1, c);
  return "\"" + result + "\"";
}

std::string bold(std::string_view text) {
  return "\\fB" + troff(text) + "\\fR";
}

std::string italic(std::string_view text) {
  return "\\fI" + troff(text) + "\\fR";
}

std::string sentence(std::string_view text) {
  std::string result(text);
  if (!result.empty() && result.front() >= 'a' && result.front() <= 'z') {
    result.front() = static_cast<char>(result.front() - 'a' + 'A');
  }
  return troff(result) + (result.ends_with('.') || result.ends_with(')') ? "" : ".");
}

std::string synopsis(const CommandText& command) {
  std::string line = bold("boresight " + command.name);
  for (const auto& option : command.options) {
    if (option.argument) {
      line += " " + italic(option.names.back()) + (option.several ? " ..." : "");
    }
  }
  return line + " [" + italic("options") + "]";
}

void add_option_text(std::string& page, const OptionText& option) {
  std::vector<std::string> names;
  for (const auto& name : option.names) {
    names.push_back(option.argument ? italic(name) : bold(name));
  }
  page += fmt::format(".TP\n{}", fmt::join(names, ", "));
  if (!option.argument && !option.value.empty()) {
    page += " " + italic(option.value) + (option.several ? " ..." : "");
  }
  page += "\n" + sentence(option.description) + "\n";
  if (!option.words.empty()) {
    page += fmt::format("Known: {}.\n", troff(fmt::format("{}", fmt::join(option.words, ", "))));
  }
  if (!option.range.empty()) page += sentence(option.range) + "\n";
  if (!option.default_value.empty()) {
    page += fmt::format("Default: {}.\n", troff(option.default_value));
  }
}

void add_examples_text(std::string& page, std::string_view command) {
  for (const auto& [call, purpose] : command_examples(command)) {
    page += fmt::format(".TP\n{}\n{}\n", bold(call), sentence(purpose));
  }
}

}  // namespace

std::string man_page(const ProgramText& program) {
  std::string page = fmt::format(
      ".TH BORESIGHT 1 \"\" {} \"User Commands\"\n"
      ".SH NAME\nboresight \\- redesigns the servo of a large antenna from measured data\n"
      ".SH SYNOPSIS\n",
      argument("boresight " BORESIGHT_VERSION));
  for (const auto& command : program.commands) {
    page +=
        (command.name == program.commands.front().name ? "" : ".br\n") + synopsis(command) + "\n";
  }
  page +=
      ".SH DESCRIPTION\nBoresight reads a case file, which describes one axis of one antenna, and "
      "reports\nthe identified inertia, tuned loops, the pointing error in wind, and the effect "
      "of\nother hardware.\nThe same input and seed give the same bytes for any number of "
      "threads.\n.SH OPTIONS\n";
  for (const auto& option : program.options) add_option_text(page, option);
  page += ".SH COMMANDS\n";
  for (const auto& command : program.commands) {
    page += fmt::format(".SS {}\n{}\n", argument(command.name), sentence(command.description));
    for (const auto& option : command.options) {
      if (option.names.back() != "--help") add_option_text(page, option);
    }
    page += ".PP\nExamples:\n";
    add_examples_text(page, command.name);
  }
  page += ".SH EXIT STATUS\n";
  for (const auto& [code, meaning] : exit_code_meanings()) {
    page += fmt::format(".TP\n{}\n{}\n", bold(std::to_string(static_cast<int>(code))),
                        sentence(meaning));
  }
  page += ".SH EXAMPLES\n";
  add_examples_text(page, "");
  return page;
}

}  // namespace boresight::app
