#include <algorithm>

#include <fmt/format.h>
#include <pybind11/complex.h>
#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/plant/linear/dense_response.hpp>
#include <boresight/plant/linear/state_space.hpp>
#include <boresight/python/bindings.hpp>

namespace boresight::python {
namespace {

using plant::StateSpace;
using Names = std::vector<std::string>;

StateSpace make_state_space(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b,
                            const Eigen::MatrixXd& c, const Eigen::MatrixXd& d, Names inputs,
                            Names outputs, Names states, double sample_time) {
  if (states.empty()) {
    for (Eigen::Index i = 1; i <= a.rows(); ++i) states.push_back(fmt::format("x{}", i));
  }
  StateSpace system{a,          b, c, d, std::move(inputs), std::move(outputs), std::move(states),
                    sample_time};
  plant::validate(system);
  return system;
}

py::array_t<std::complex<double>> response(const StateSpace& system,
                                           const Eigen::VectorXd& angular_frequency) {
  plant::DenseResponse prepared(system);
  py::array_t<std::complex<double>> values(
      {angular_frequency.size(), prepared.outputs(), prepared.inputs()});
  auto all = values.mutable_unchecked<3>();
  Eigen::ArrayXcd channel(angular_frequency.size());
  for (Eigen::Index output = 0; output < prepared.outputs(); ++output) {
    for (Eigen::Index input = 0; input < prepared.inputs(); ++input) {
      prepared.evaluate(angular_frequency.array(), channel, output, input);
      for (Eigen::Index i = 0; i < channel.size(); ++i) all(i, output, input) = channel(i);
    }
  }
  return values;
}

std::string describe(const StateSpace& system) {
  return fmt::format(
      "<boresight.StateSpace: {} states, inputs {}, outputs {}{}>", system.states.size(),
      fmt::join(system.inputs, " "), fmt::join(system.outputs, " "),
      system.sample_time > 0.0 ? fmt::format(", every {} s", system.sample_time) : std::string());
}

}  // namespace

void add_state_space(py::module_& module) {
  py::class_<StateSpace>(
      module, "StateSpace",
      "dx/dt = A x + B u, y = C x + D u with names; with a sample_time T > 0 (s) the same from "
      "sample "
      "to sample. `control.ss(*system.abcd)` and `scipy.signal.StateSpace(*system.abcd)` take it.")
      .def(py::init(&make_state_space), py::arg("a"), py::arg("b"), py::arg("c"), py::arg("d"),
           py::arg("inputs"), py::arg("outputs"), py::arg("states") = Names{},
           py::arg("sample_time") = 0.0,
           "From matrices (n x n, n x inputs, outputs x n, outputs x inputs) and names; states are "
           "called x1, x2, ... if not named. Raises InvalidInput for shapes and names that do not "
           "fit.")
      .def_readonly("a", &StateSpace::a, "n x n")
      .def_readonly("b", &StateSpace::b, "n x inputs")
      .def_readonly("c", &StateSpace::c, "outputs x n")
      .def_readonly("d", &StateSpace::d, "outputs x inputs")
      .def_property_readonly(
          "abcd",
          [](const StateSpace& system) {
            return py::make_tuple(system.a, system.b, system.c, system.d);
          },
          "(A, B, C, D)")
      .def_readonly("inputs", &StateSpace::inputs, "Names of the inputs")
      .def_readonly("outputs", &StateSpace::outputs, "Names of the outputs")
      .def_readonly("states", &StateSpace::states, "Names of the states")
      .def_readonly("sample_time", &StateSpace::sample_time, "s; 0: continuous")
      .def(
          "poles", [](const StateSpace& system) { return numerics::eigenvalues(system.a); },
          "Eigenvalues of A (rad/s; of a sampled system in the z plane), by magnitude.")
      .def("frequency_response", &response, py::arg("angular_frequency"),
           "C (s I - A)^-1 B + D at s = jw (sampled: z = e^(jwT)) for each w in rad/s: an array of "
           "frequencies x outputs x inputs. Infinite at a pole.")
      .def("__repr__", &describe);

  module.def(
      "connect", &plant::connect, py::arg("systems"), py::arg("inputs"), py::arg("outputs"),
      "Connects systems by name: an input called as an output is fed from it. The result has "
      "exactly the inputs and outputs named. Raises InvalidInput for an input that nothing "
      "feeds and names given twice, NumericalFailure for an algebraic loop without solution.");
}

}  // namespace boresight::python
