#pragma once

#include <pybind11/pybind11.h>

/// The Python module `boresight`, piece by piece. Values are SI, arrays are numpy's; what computes
/// for long releases the interpreter's lock and ends at Ctrl-C (interruptible.hpp).
namespace boresight::python {

namespace py = pybind11;

// Each adds its classes and functions to the module. In this order: a signature names classes that
// are known already.
void add_errors(py::module_& module);
void add_state_space(py::module_& module);
void add_reports(py::module_& module);
void add_case(py::module_& module);
void add_identification(py::module_& module);
void add_plant(py::module_& module);
void add_controller(py::module_& module);
void add_tuning(py::module_& module);
void add_matching(py::module_& module);
void add_evaluation(py::module_& module);
void add_simulation(py::module_& module);
void add_commissioning(py::module_& module);
/// Last: names of version 0.1, which warn.
void add_renamed_names(py::module_& module);

}  // namespace boresight::python
