#include <algorithm>

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <boresight/app/audit/audit_report.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_motor.hpp>
#include <boresight/io/case/case_sensors.hpp>
#include <boresight/io/case/case_wind.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/plant_numbers.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/python/bindings.hpp>
#include <boresight/python/results.hpp>

namespace boresight::python {
namespace {

using io::Case;
using io::Quantity;

const Quantity& quantity(const Case& antenna, const std::string& key) {
  const auto found = std::ranges::find(antenna.quantities, key, &Quantity::key);
  if (found == antenna.quantities.end()) {
    throw py::key_error(fmt::format("{}: the case has no quantity '{}'", antenna.path, key));
  }
  return *found;
}

Found audit(const Case& antenna) {
  Found found{report_of(antenna, "audit", 1)};
  found.report.audit = app::audit_report(antenna);
  return found;
}

}  // namespace

void add_case(py::module_& module) {
  py::class_<Quantity>(module, "Quantity", "One number of a case file. float() is the value.")
      .def_readonly("key", &Quantity::key, "Path of keys, 'oil.bulk_modulus'")
      .def_readonly("value", &Quantity::value, "SI; frequencies in Hz")
      .def_readonly("standard_uncertainty", &Quantity::standard_uncertainty,
                    "1 sigma; as given, or else that of the printed digits")
      .def_readonly("text", &Quantity::text, "As written, with its unit")
      .def_readonly("source", &Quantity::source)
      .def_property_readonly(
          "basis", [](const Quantity& one) { return std::string(io::to_string(one.basis)); },
          "'measured', 'published', 'inferred', 'assumed' or 'unstated'")
      .def("__float__", [](const Quantity& one) { return one.value; })
      .def("__repr__", [](const Quantity& one) {
        return fmt::format("<boresight.Quantity {} = {}, {}>", one.key, one.text,
                           io::to_string(one.basis));
      });

  py::class_<Case>(
      module, "Case",
      "One axis of an antenna as a case file describes it: see read_case. case['KEY'] is "
      "a Quantity by its path of keys.")
      .def_readonly("path", &Case::path)
      .def_readonly("title", &Case::title)
      .def_readonly("axis", &Case::axis)
      .def_readonly("quantities", &Case::quantities, "Every Quantity, in the file's order")
      .def("__getitem__", &quantity, py::arg("key"), py::return_value_policy::reference_internal)
      .def_property_readonly(
          "gear_ratio", [](const Case& antenna) { return io::gear_ratio(antenna); },
          "Motor turns per antenna turn")
      .def_property_readonly(
          "motor_inertia",
          [](const Case& antenna) {
            return io::motor_inertia(antenna, antenna.motor->flywheel_disks);
          },
          "All motors with their flywheels, kg m2")
      .def_property_readonly(
          "flywheel_disks", [](const Case& antenna) { return antenna.motor->flywheel_disks; },
          "On each motor")
      .def_property_readonly(
          "controller_delay", [](const Case& antenna) { return antenna.controller->delay.value; },
          "Dead time on the valve command, s")
      .def_property_readonly(
          "wind_speed", [](const Case& antenna) { return antenna.wind->design_speed.value; },
          "Mean speed of the design wind, m/s")
      .def("__repr__", [](const Case& antenna) {
        return fmt::format("<boresight.Case {}: {}>", antenna.path, antenna.title);
      });

  module.def(
      "read_case", &io::read_case, py::arg("path"),
      "Reads and checks a case file (docs/case-file.md). Raises InvalidInput with file, line, "
      "column, key, what was expected and what was found.");
  module.def(
      "audit", &audit, py::arg("case"),
      "Recomputes every derived number that the case states: a Report whose to_dict()['audit'] "
      "lists those that do not follow.");
}

}  // namespace boresight::python
