#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <boresight/app/commands/subcommand.hpp>
#include <boresight/app/commission/commission_study.hpp>
#include <boresight/app/tune/chosen_controller.hpp>
#include <boresight/control/controllers/controller.hpp>
#include <boresight/design/studies/export_study.hpp>
#include <boresight/io/campaign/designed_antenna.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/tested_drive_of.hpp>
#include <boresight/io/code/exported_files.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/python/bindings.hpp>
#include <boresight/python/interruptible.hpp>

namespace boresight::python {
namespace {

using app::CommissionReport;
using app::StageCheck;
using app::StageSheet;

// A record of a stage, and the verdict on it.
struct StageRecordResult {
  std::size_t stage = 0;
  std::string file, verdict;
};

CommissionReport commission(const io::Case& antenna, std::optional<control::Controller> controller,
                            const std::string& structure, double largest_step, std::size_t plants,
                            const std::vector<std::pair<std::size_t, std::string>>& records,
                            int starts, std::uint64_t seed, unsigned threads) {
  app::CommissionOptions options;
  options.structure = structure;
  options.controller = std::move(controller);
  options.largest_step = largest_step;
  options.plants = plants;
  options.records = records;
  options.starts = starts;
  options.seed = seed;
  options.threads = app::all_or(threads);
  return interruptible([&](const StopRequest& stop) {
    options.interrupted = stop;
    return plan_commission(io::designed_antenna(antenna, seed, options.threads, stop), options);
  });
}

std::vector<StageRecordResult> records_of(const CommissionReport& report) {
  std::vector<StageRecordResult> records;
  for (const auto& one : report.records) {
    records.push_back({one.stage + 1, one.file,
                       one.evaluated.empty()
                           ? std::string("not evaluated")
                           : std::string(to_string(worst_verdict(one.evaluated)))});
  }
  return records;
}

struct Exported {
  design::ExportedController exported;
  std::map<std::string, std::string> files;
  std::string json;
};

std::vector<io::CodeLanguage> languages_named(const std::vector<std::string>& names) {
  std::vector<io::CodeLanguage> languages;
  for (const std::string& name : names) {
    const auto& known = io::code_languages();
    const auto found = std::ranges::find_if(
        known, [&](io::CodeLanguage language) { return to_string(language) == name; });
    if (found == known.end()) {
      throw InvalidInput(
          fmt::format("export: expected languages c, st, simulink or json, found '{}'", name));
    }
    languages.push_back(*found);
  }
  return languages;
}

control::program::Precision precision_named(const std::string& name) {
  if (name == "double") return control::program::Precision::double_precision;
  if (name == "single") return control::program::Precision::single_precision;
  throw InvalidInput(
      fmt::format("export: expected the precision 'double' or 'single', found '{}'", name));
}

Exported export_code(const io::Case& antenna, std::optional<control::Controller> controller,
                     const std::vector<std::string>& languages, const std::string& precision,
                     const std::string& prefix, const std::string& structure, std::uint64_t seed,
                     unsigned threads) {
  io::ExportOptions options;
  if (!languages.empty()) options.languages = languages_named(languages);
  options.precision = precision_named(precision);
  options.prefix = prefix;
  options.structure = structure;
  options.antenna = fmt::format("Antenna: {}; case {}; by Boresight {}", antenna.title,
                                antenna.path, BORESIGHT_VERSION);
  io::require_simulation(antenna);
  if (controller && structure.empty() && controller->structure.state_space() == nullptr) {
    throw InvalidInput(
        "export: expected the name of the controller's structure, as controller() has it");
  }
  return interruptible([&](const StopRequest& stop) {
    const unsigned all = app::all_or(threads);
    const auto designed = io::designed_antenna(antenna, seed, all, stop);
    options.source = "given";
    if (!controller) {
      design::TuneOptions tuning;
      tuning.seed = seed;
      tuning.threads = all;
      tuning.interrupted = stop;
      app::ChosenController chosen = app::recommended_controller(designed, structure, tuning);
      controller = std::move(chosen.controller);
      options.structure = chosen.structure;
      options.source = chosen.source;
    }
    const auto signals = io::computer_signals(designed.antenna, designed.mission,
                                              controller->structure.feeds_torque_back());
    Exported result{
        design::exported_controller(designed.mission, *controller, signals.signals), {}, {}};
    for (auto& file : io::exported_files(result.exported, signals, options)) {
      result.files.emplace(std::move(file.name), std::move(file.content));
    }
    result.json = io::exported_json(result.exported, signals, options).content;
    return result;
  });
}

py::object loaded(const std::string& json) {
  return py::module_::import("json").attr("loads")(json);
}

void add_stages(py::module_& module) {
  py::class_<StageCheck>(module, "StageCheck",
                         "A line of a stage's sheet, in the units of the antenna's computer.")
      .def_property_readonly(
          "quantity",
          [](const StageCheck& check) { return std::string(to_string(check.quantity)); })
      .def_readonly("unit", &StageCheck::unit)
      .def_readonly("expected", &StageCheck::expected, "On the nominal antenna")
      .def_readonly("lower", &StageCheck::lower, "The stage passes from here")
      .def_readonly("upper", &StageCheck::upper, "to here")
      .def_readonly("abort_above", &StageCheck::abort_above, "None: no limit of its own");
  py::class_<StageSheet>(module, "CommissioningStage", "One stage on the way to a controller.")
      .def_property_readonly(
          "kind", [](const StageSheet& sheet) { return std::string(to_string(sheet.stage.kind)); },
          "The loop that it changes")
      .def_property_readonly(
          "position_open",
          [](const StageSheet& sheet) { return sheet.stage.controller.position_open; },
          "The position loop is open")
      .def_property_readonly(
          "controller", [](const StageSheet& sheet) { return sheet.stage.controller.controller; },
          "Controller")
      .def_readonly("step", &StageSheet::step,
                    "Step of the rate (rad/s) or position command (rad) at the sky")
      .def_readonly("checks", &StageSheet::checks, "Every StageCheck");
  py::class_<StageRecordResult>(module, "StageRecord", "The record of a stage that is done.")
      .def_readonly("stage", &StageRecordResult::stage, "Its number, from 1")
      .def_readonly("file", &StageRecordResult::file)
      .def_readonly("verdict", &StageRecordResult::verdict,
                    "'passes', 'outside', 'abort' or 'not evaluated'");
}

}  // namespace

void add_commissioning(py::module_& module) {
  add_stages(module);
  py::class_<CommissionReport>(module, "Commissioning", "What commission() planned.")
      .def_readonly("structure", &CommissionReport::structure)
      .def_readonly("stages", &CommissionReport::sheets, "Every CommissioningStage, in order")
      .def_property_readonly(
          "faults",
          [](const CommissionReport& report) {
            std::map<std::string, std::optional<std::size_t>> faults;
            for (const auto& one : report.faults) {
              faults[one.fault] = one.detected ? std::optional(*one.detected + 1) : std::nullopt;
            }
            return faults;
          },
          "By name, the number of the first stage that detects it; None: none does")
      .def_property_readonly("records", &records_of, "Every StageRecord, as given")
      .def_readonly("conclusions", &CommissionReport::conclusions)
      .def(
          "to_json", [](const CommissionReport& report) { return app::to_json(report); },
          "As the program's --json has it (docs/commission.schema.json)")
      .def(
          "to_dict", [](const CommissionReport& report) { return loaded(app::to_json(report)); },
          "The same as a dictionary")
      .def(
          "to_text", [](const CommissionReport& report) { return app::to_text(report); },
          "As the program prints it");
  module.def("commission", &commission, py::arg("case"), py::arg("controller") = py::none(),
             py::kw_only(), py::arg("structure") = "", py::arg("largest_step") = 2.0,
             py::arg("plants") = 0,
             py::arg("records") = std::vector<std::pair<std::size_t, std::string>>{},
             py::arg("starts") = 0, py::arg("seed") = 1, py::arg("threads") = 0,
             "Plans the stages from the case's [gains] to a controller (None: the recommended one, "
             "of `structure` alone if named), with what to measure in each and its limits. "
             "`plants`: fresh plants on which to try them. `records`: (stage from 1, path) of "
             "stages that are done. Raises InfeasibleRequirement if there is no way.");
  py::class_<Exported>(module, "Exported", "What export() wrote.")
      .def_readonly("files", &Exported::files, "Text by name, relative to a folder")
      .def_property_readonly(
          "sample_time", [](const Exported& exported) { return exported.exported.sample_time; },
          "s, of the program")
      .def_property_readonly(
          "gains",
          [](const Exported& exported) {
            std::map<std::string, double> gains;
            for (const auto& row : io::gain_rows(exported.exported.controller)) {
              gains[row.symbol] = row.value;
            }
            return gains;
          },
          "By symbol, SI, integrals in corner form and in Ki form; empty of a state space")
      .def(
          "to_json", [](const Exported& exported) { return exported.json; },
          "All parameters, as the program's --json has them")
      .def(
          "to_dict", [](const Exported& exported) { return loaded(exported.json); },
          "The same as a dictionary");
  module.def(
      "export", &export_code, py::arg("case"), py::arg("controller") = py::none(), py::kw_only(),
      py::arg("languages") = std::vector<std::string>{}, py::arg("precision") = "double",
      py::arg("prefix") = "servo", py::arg("structure") = "", py::arg("seed") = 1,
      py::arg("threads") = 0,
      "A controller (None: the recommended one) as code for the antenna's computer, in "
      "languages of 'c', 'st', 'simulink', 'json' (none: all), with test vectors. "
      "`structure`: its name, 'PI', of a controller given; else the one to take. A state space "
      "has none.");
}

}  // namespace boresight::python
