#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <boresight/app/commands/subcommand.hpp>
#include <boresight/app/simulate/simulated_tests.hpp>
#include <boresight/app/tune/chosen_controller.hpp>
#include <boresight/design/simulation/drive_run.hpp>
#include <boresight/io/campaign/designed_antenna.hpp>
#include <boresight/io/case/tested_drive_of.hpp>
#include <boresight/io/records/simulated_table.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/python/bindings.hpp>
#include <boresight/python/interruptible.hpp>
#include <boresight/python/results.hpp>

namespace boresight::python {
namespace {

struct Record {
  std::string test;
  std::string description;
  double sample_time = 0.0;
  io::CsvTable table;
};

template <typename Section>
Record record_of(Section section) {
  return {section.test, std::move(section.description), section.sample_time, io::table_of(section)};
}

std::vector<Record> simulate(const io::Case& antenna, const std::string& test, std::uint64_t seed) {
  const auto& known = design::simulated_test_names();
  if (std::ranges::find(known, test) == known.end()) {
    throw InvalidInput(
        fmt::format("simulate: expected one of {}, found '{}'", fmt::join(known, ", "), test));
  }
  return interruptible([&](const StopRequest& stop) {
    const auto progress = [&stop](double) { return !stop(); };
    std::vector<Record> records;
    if (const auto kind = design::drive_test_kind(test)) {
      const auto drive = io::tested_drive_of(antenna);
      for (const auto& one : design::drive_tests(drive, *kind)) {
        records.push_back(
            record_of(app::section_of(design::run_drive_test(drive, one, seed, progress))));
      }
      return records;
    }
    const auto designed = io::designed_antenna(antenna, seed, app::all_or(0), stop);
    design::TuneOptions options;
    options.seed = seed;
    options.threads = app::all_or(0);
    options.interrupted = stop;
    const auto chosen = app::recommended_controller(designed, "", options);
    auto run = app::run_position_test(antenna, test, chosen.controller, seed, progress);
    records.push_back(record_of(app::section_of(std::move(run), antenna, chosen.source)));
    return records;
  });
}

}  // namespace

void add_simulation(py::module_& module) {
  py::class_<Record>(module, "Record", "What the recorder of a simulated test wrote.")
      .def_readonly("test", &Record::test)
      .def_readonly("description", &Record::description)
      .def_readonly("sample_time", &Record::sample_time, "s")
      .def_property_readonly(
          "columns",
          [](const Record& record) {
            py::dict columns;
            for (const auto& column : record.table.columns) {
              columns[column.name.c_str()] = column.values;
            }
            return columns;
          },
          "Arrays by name, in the recorder's own units")
      .def_property_readonly(
          "units",
          [](const Record& record) {
            py::dict units;
            for (const auto& column : record.table.columns) {
              units[column.name.c_str()] = column.unit;
            }
            return units;
          },
          "Of the columns, by name")
      .def(
          "to_csv", [](const Record& record) { return io::to_csv(record.table); },
          "The text that `boresight simulate` writes to the record's file.");
  module.def(
      "simulate", &simulate, py::arg("case"), py::arg("test"), py::arg("seed") = 1,
      "Runs a test on the nonlinear antenna of the case ('slosh', 'fast-ramp', 'slow-ramp', "
      "'constant-speed', 'valve-steps', 'valve-chirp', 'tracking', 'slew') and returns a Record "
      "for each file that the recorder would write. Ctrl-C stops it.");
}

}  // namespace boresight::python
