#include <algorithm>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/commands/completion_scripts.hpp>
#include <boresight/app/commands/man_page.hpp>
#include <boresight/app/commands/manual_commands.hpp>
#include <boresight/app/report/report_schemas.hpp>
#include <boresight/io/case/field.hpp>
#include <boresight/io/units/wording.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::app {
namespace {

std::string completion_for(const std::string& shell, const ProgramText& program) {
  if (shell == "bash") return bash_completion(program);
  if (shell == "zsh") return zsh_completion(program);
  if (shell == "fish") return fish_completion(program);
  const std::vector<std::string_view> known(completion_shells().begin(), completion_shells().end());
  throw InvalidInput(fmt::format("completion: expected one of {}, found {}{}",
                                 io::quoted_list(known), io::in_quotes(shell),
                                 io::did_you_mean(shell, known)));
}

}  // namespace

const std::vector<std::string>& completion_shells() {
  static const std::vector<std::string> shells{"bash", "zsh", "fish"};
  return shells;
}

Subcommand add_completion(CLI::App& program) {
  const auto shell = std::make_shared<std::string>();
  CLI::App* sub = program.add_subcommand(
      "completion", "write a script that makes a shell complete commands, options and names");
  sub->add_option("SHELL", *shell, fmt::format("{}", fmt::join(completion_shells(), ", ")))
      ->required();
  return {sub, [shell, &program] {
            fmt::print("{}", completion_for(*shell, describe_program(program)));
            return done;
          }};
}

Subcommand add_manual(CLI::App& program) {
  CLI::App* sub =
      program.add_subcommand("man", "write the manual, for man -l or a folder of manuals");
  return {sub, [&program] {
            fmt::print("{}", man_page(describe_program(program)));
            return done;
          }};
}

Subcommand add_schema(CLI::App& program) {
  const auto report = std::make_shared<std::string>();
  CLI::App* sub =
      program.add_subcommand("schema", "write the JSON schema of a report that --json writes");
  sub->add_option("REPORT", *report, fmt::format("{}", fmt::join(described_reports(), ", ")))
      ->required();
  return {sub, [report] {
            fmt::print("{}", report_schema(*report));
            return done;
          }};
}

}  // namespace boresight::app
