#include <filesystem>
#include <memory>
#include <system_error>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <boresight/app/commands/new_command.hpp>
#include <boresight/app/new_case/case_form.hpp>
#include <boresight/io/files/write_atomically.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::app {

std::string write_case_form(const std::string& folder) {
  namespace fs = std::filesystem;
  const fs::path path = fs::path(folder) / "case.toml";
  std::error_code failure;
  if (fs::exists(path, failure)) {
    throw InvalidInput(
        fmt::format("{}: expected no file, found one: it is left as it is", path.string()));
  }
  // "sites/25-m/" and "." end in no name: that of the folder itself is meant.
  fs::path whole = fs::absolute(folder).lexically_normal();
  if (!whole.has_filename()) whole = whole.parent_path();
  const std::string title = whole.filename().string();
  fs::create_directories(folder, failure);
  if (failure) {
    throw InvalidInput(fmt::format("{}: expected a place for a folder, found none ({})", folder,
                                   failure.message()));
  }
  const CaseForm form = case_form(title);
  io::write_atomically(path.string(), form.text);
  return fmt::format(
      "Wrote {0}: {1} blanks (\"?\") to fill in, the first in line {2}.\nThen: boresight audit {3} "
      "    check it for inconsistencies\n      boresight redesign {3}  the whole report\n",
      path.string(), form.blanks, form.first_blank,
      path.string().find(' ') == std::string::npos ? path.string() : '"' + path.string() + '"');
}

Subcommand add_new(CLI::App& program) {
  const auto folder = std::make_shared<std::string>();
  CLI::App* sub =
      program.add_subcommand("new", "write a commented case file to fill in for your antenna");
  sub->add_option("ANTENNA", *folder, "the antenna's name: the folder to create case.toml in")
      ->required();
  return {sub, [folder] {
            const std::string next = write_case_form(*folder);
            if (!quiet()) fmt::print("{}", next);
            return done;
          }};
}

}  // namespace boresight::app
