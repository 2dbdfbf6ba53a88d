#include <fmt/format.h>
#include <pybind11/stl.h>

#include <boresight/app/redesign/assumed_inputs.hpp>
#include <boresight/app/report/json_report.hpp>
#include <boresight/app/report/text_report.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/python/bindings.hpp>
#include <boresight/python/results.hpp>

namespace boresight::python {

app::Report report_of(const io::Case& antenna, const std::string& command, std::uint64_t seed) {
  app::Report report;
  report.command = command;
  report.title = antenna.title;
  report.axis = io::pointing_axis(antenna);
  report.case_path = antenna.path;
  report.seed = seed;
  report.assumed = app::assumed_inputs(antenna);
  return report;
}

numerics::Interval interval_of(const numerics::PropagatedResult& result) {
  return {result.value, result.standard_uncertainty, result.lower, result.upper};
}

void add_reports(py::module_& module) {
  using numerics::Interval;
  py::class_<Interval>(module, "Interval",
                       "A result with its 95 % interval, SI. float() is the value.")
      .def_readonly("value", &Interval::value)
      .def_readonly("standard_uncertainty", &Interval::standard_uncertainty, "1 sigma")
      .def_readonly("lower", &Interval::lower, "2.5 %")
      .def_readonly("upper", &Interval::upper, "97.5 %; may be infinite")
      .def("__float__", [](const Interval& interval) { return interval.value; })
      .def("__repr__", [](const Interval& interval) {
        return fmt::format("{:.6g} ({:.6g} .. {:.6g})", interval.value, interval.lower,
                           interval.upper);
      });

  py::class_<Found>(module, "Report", "What was found; base of all results.")
      .def(
          "to_json", [](const Found& found) { return app::to_json(found.report); },
          "The report as JSON text, as the program's --json has it (docs/report.schema.json).")
      .def(
          "to_dict",
          [](const Found& found) {
            return py::module_::import("json").attr("loads")(app::to_json(found.report));
          },
          "The same as a dictionary. Keys end in their unit: 'boresight_rms_mdeg'.")
      .def(
          "to_text", [](const Found& found) { return app::to_text(found.report); },
          "The report as the program prints it.")
      .def_property_readonly(
          "conclusions", [](const Found& found) { return found.report.conclusions; },
          "A few sentences that say what the numbers mean; may be empty.");
}

}  // namespace boresight::python
