#include <utility>

#include <boresight/numerics/error.hpp>
#include <boresight/python/bindings.hpp>

namespace boresight::python {

void add_errors(py::module_& module) {
  const auto& error = py::register_exception<Error>(module, "Error");
  error.attr("__doc__") = "Base of every error that this module raises on purpose.";
  const auto& invalid = py::register_exception<InvalidInput>(
      module, "InvalidInput", py::make_tuple(error, py::handle(PyExc_ValueError)));
  invalid.attr("__doc__") =
      "An argument or a file is not what is asked for. The message says where, what was expected "
      "and "
      "what was found. Also a ValueError.";
  const auto& infeasible =
      py::register_exception<InfeasibleRequirement>(module, "InfeasibleRequirement", error);
  infeasible.attr("__doc__") = "A requirement cannot be met; the message says what comes closest.";
  const auto& numerical = py::register_exception<NumericalFailure>(
      module, "NumericalFailure", py::make_tuple(error, py::handle(PyExc_ArithmeticError)));
  numerical.attr("__doc__") =
      "A computation has no trustworthy result: an unstable loop, a singular matrix, no "
      "convergence. "
      "Also an ArithmeticError.";
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(std::move(thrown));
    } catch (const Interrupted& interrupted) {
      PyErr_SetString(PyExc_KeyboardInterrupt, interrupted.what());
    }
  });
}

}  // namespace boresight::python
