#include <algorithm>
#include <filesystem>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <boresight/app/commands/controller_option.hpp>
#include <boresight/app/commands/export_command.hpp>
#include <boresight/app/document/document_text.hpp>
#include <boresight/app/redesign/assumed_inputs.hpp>
#include <boresight/app/report/axis_wording.hpp>
#include <boresight/io/campaign/designed_antenna.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/pointing_axis.hpp>
#include <boresight/io/case/tested_drive_of.hpp>
#include <boresight/io/files/output_folder.hpp>
#include <boresight/io/files/write_atomically.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::app {
namespace {

namespace fs = std::filesystem;

std::vector<io::CodeLanguage> languages_of(const std::vector<std::string>& names) {
  if (names.empty()) return io::code_languages();
  std::vector<io::CodeLanguage> languages;
  for (const io::CodeLanguage language : io::code_languages()) {
    if (std::ranges::find(names, to_string(language)) != names.end()) languages.push_back(language);
  }
  return languages;
}

ChosenController controller_of(const io::DesignedAntenna& designed, const io::Case& stated,
                               const ExportArguments& arguments,
                               const std::function<bool()>& interrupted) {
  if (auto named = named_controller(stated, arguments.controller)) return *std::move(named);
  design::TuneOptions options;
  options.seed = arguments.seed;
  options.threads = arguments.threads;
  options.interrupted = interrupted;
  return recommended_controller(designed, arguments.controller.structure, options);
}

void make_folders(const fs::path& folder, const std::vector<io::CodeFile>& files) {
  for (const auto& file : files) {
    const fs::path path = folder / file.name;
    io::output_folder(path.parent_path(), "code");
    io::require_writable(path.string());
  }
}

}  // namespace

ExportReport export_case(const ExportArguments& arguments,
                         const std::function<bool()>& interrupted) {
  arguments.controller.validate();
  const io::Case stated = io::read_case(arguments.case_path);
  io::require_simulation(stated);
  make_folders(arguments.folder, {{"servo_controller.json", ""}});
  const io::DesignedAntenna designed =
      designed_antenna(stated, arguments.seed, arguments.threads, interrupted);
  const ChosenController chosen = controller_of(designed, stated, arguments, interrupted);
  const io::CaseSignals signals = io::computer_signals(
      designed.antenna, designed.mission, chosen.controller.structure.feeds_torque_back());
  ExportReport report;
  report.exported =
      design::exported_controller(designed.mission, chosen.controller, signals.signals);
  report.case_path = arguments.case_path;
  report.title = stated.title;
  report.axis = io::pointing_axis(stated);
  report.structure = chosen.structure;
  report.source = chosen.source;
  report.folder = arguments.folder;
  report.prefix = arguments.prefix;
  report.signals = signals.descriptions;
  io::ExportOptions options;
  options.languages = languages_of(arguments.languages);
  options.precision = arguments.precision == "single"
                          ? control::program::Precision::single_precision
                          : control::program::Precision::double_precision;
  options.prefix = arguments.prefix;
  options.structure = chosen.structure;
  options.source = chosen.source;
  const std::string axis = words_beside(stated.title, report.axis);
  options.antenna =
      fmt::format("Antenna: {}{}{}; case {}; by Boresight {}", stated.title,
                  axis.empty() ? "" : ", ", axis, arguments.case_path, BORESIGHT_VERSION);
  const auto files = io::exported_files(report.exported, signals, options);
  report.json = io::exported_json(report.exported, signals, options).content;
  const fs::path folder = arguments.folder;
  make_folders(folder, files);
  for (const auto& file : files) {
    io::write_atomically((folder / file.name).string(), file.content);
    report.files.push_back(file.name);
  }
  const auto has = [&](io::CodeLanguage language) {
    return std::ranges::find(options.languages, language) != options.languages.end();
  };
  report.with_c = has(io::CodeLanguage::c);
  report.with_vectors =
      report.with_c || has(io::CodeLanguage::structured_text) || has(io::CodeLanguage::simulink);
  report.assumed = assumed_inputs(designed.antenna, {.time_runs = true, .computer = true});
  return report;
}

namespace {

int run(ExportArguments arguments) {
  arguments.threads = all_or(arguments.threads);
  watch_for_interrupt();
  try {
    const std::string& json = arguments.json_path;
    if (!json.empty() && json != "-") io::require_writable(json);
    const ExportReport report = export_case(arguments, interrupt_requested);
    if (json == "-") {
      fmt::print("{}", report.json);
    } else if (!json.empty()) {
      io::write_atomically(json, report.json);
    }
    const Document document = document_of(report);
    if (!quiet() && json != "-") {
      fmt::print("{}", arguments.details
                           ? to_text(document)
                           : to_text(short_form(document)) + "\nAll sections: --details\n");
    }
  } catch (const Interrupted&) {
    fmt::print(stderr, "boresight: interrupted; nothing is exported\n");
    return interrupted;
  }
  return done;
}

}  // namespace

Subcommand add_export(CLI::App& program) {
  const auto arguments = std::make_shared<ExportArguments>();
  CLI::App* sub = program.add_subcommand(
      "export", "write a controller as code for the antenna's computer, with test vectors");
  add_case(*sub, arguments->case_path);
  sub->add_option(
         "--language", arguments->languages,
         "one or several of c (C99), st (IEC 61131-3 Structured Text), simulink (functions "
         "for MATLAB, Octave and Simulink), json (parameters) (default: all)")
      ->check(CLI::IsMember({"c", "st", "simulink", "json"}))
      ->expected(1, 4);
  sub->add_option("--folder", arguments->folder, "folder for the files")->capture_default_str();
  sub->add_option("--precision", arguments->precision,
                  "of C and Structured Text: double or single; angles are always double")
      ->check(CLI::IsMember({"double", "single"}))
      ->capture_default_str();
  sub->add_option("--prefix", arguments->prefix,
                  "begins the names of files, types and functions: one per axis of a computer")
      ->capture_default_str();
  add_controller(*sub, "the controller", arguments->controller);
  sub->add_option("--json", arguments->json_path,
                  "also write all parameters as JSON to this file, as --language json does; '-' "
                  "writes JSON only, to standard output");
  sub->add_flag("--details", arguments->details,
                "print every section of the report, not only the result");
  add_seed(*sub, arguments->seed);
  add_threads(*sub, arguments->threads);
  return {sub, [arguments] { return run(*arguments); }};
}

}  // namespace boresight::app
