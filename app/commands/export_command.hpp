#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <boresight/app/commands/subcommand.hpp>
#include <boresight/app/export/export_report.hpp>
#include <boresight/app/tune/chosen_controller.hpp>

namespace boresight::app {

struct ExportArguments {
  std::string case_path;
  std::vector<std::string> languages;  // as io::to_string(CodeLanguage); empty: all
  std::string folder = "servo-controller";
  std::string precision = "double";  // or "single"
  std::string prefix = "servo";      // io::ExportOptions
  ControllerOptions controller;
  std::uint64_t seed = 1;
  unsigned threads = 1;
  std::string json_path;  // "-": to standard output instead of the text; empty: nowhere
  bool details = false;
};

/// Writes the controller for the antenna's computer into the folder, which is created if missing.
/// With records, the antenna is the identified one.
/// @throws InvalidInput as named_controller, computer_signals and exported_controller, and for a
/// folder that cannot be written to; as recommended_controller.
ExportReport export_case(const ExportArguments& arguments,
                         const std::function<bool()>& interrupted);

Subcommand add_export(CLI::App& program);

}  // namespace boresight::app
