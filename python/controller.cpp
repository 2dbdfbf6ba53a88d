#include <fmt/format.h>
#include <pybind11/stl.h>

#include <boresight/control/controllers/controller.hpp>
#include <boresight/control/controllers/sampled_controller.hpp>
#include <boresight/control/loops/closed_loop.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/python/bindings.hpp>
#include <boresight/python/results.hpp>

namespace boresight::python {
namespace {

using control::Controller;

Controller make_controller(const std::string& structure, const py::dict& gains) {
  Controller controller{control::LoopStructure::named(structure), {}};
  std::string symbols;
  for (const auto& gain : controller.structure.gains()) {
    symbols += (symbols.empty() ? "" : ", ") + gain.symbol;
    if (gains.contains(gain.symbol)) {
      controller.gains.push_back(gains[gain.symbol.c_str()].cast<double>());
    }
  }
  if (controller.gains.size() != controller.structure.gains().size() ||
      gains.size() != controller.gains.size()) {
    throw InvalidInput(fmt::format("controller: expected the gains {} of {}, found {}", symbols,
                                   structure, py::str(py::list(gains)).cast<std::string>()));
  }
  control::validate(controller);
  return controller;
}

py::dict gains_of(const Controller& controller) {
  py::dict gains;
  const auto& descriptions = controller.structure.gains();
  for (std::size_t i = 0; i < controller.gains.size(); ++i) {
    gains[descriptions[i].symbol.c_str()] = controller.gains[i];
  }
  return gains;
}

}  // namespace

void add_controller(py::module_& module) {
  py::class_<Controller>(module, "Controller", "A loop structure with its gains: see controller.")
      .def_property_readonly(
          "structure", [](const Controller& controller) { return controller.structure.name(); })
      .def_property_readonly("gains", &gains_of, "By symbol, SI")
      .def_property_readonly(
          "units",
          [](const Controller& controller) {
            py::dict units;
            for (const auto& gain : controller.structure.gains())
              units[gain.symbol.c_str()] = gain.unit;
            return units;
          },
          "Of the gains, by symbol")
      .def(
          "state_space",
          [](const Controller& controller) { return control::to_state_space(controller); },
          "StateSpace: inputs tachometer (rad/s), encoder (rad), rate_disturbance (rad/s, added to "
          "the rate command) and, where it is fed back, motor_torque (N m); outputs valve_demand "
          "(rad/s, before the dead time) and rate_command.")
      .def(
          "sampled_controller",
          [](const Controller& controller, double sample_time) {
            return control::sampled_controller(controller, sample_time);
          },
          py::arg("sample_time"),
          "The form that the antenna's computer runs every sample_time (s): Tustin's method, "
          "corners "
          "prewarped. Neither hold nor computing delay are in it.")
      .def("__repr__", [](const Controller& controller) {
        return fmt::format("<boresight.Controller {}: {}>", controller.structure.name(),
                           py::str(gains_of(controller)).cast<std::string>());
      });

  module.def(
      "controller", &make_controller, py::arg("structure"), py::arg("gains"),
      "A controller with gains of your own, by symbol, SI. Structures: 'PI-0' (PI without lag), "
      "'PI' (PI with lag), 'DPF' (PI with lag and pressure feedback), 'LL' (PI with lead and lag) "
      "or 'FULL' (PI with lead, lag and pressure feedback), with +L (position lag instead of "
      "the integrals), +D or +F (dead zone or freeze of the integral), +N (notch) and +C "
      "(compliance compensation) behind it. Raises InvalidInput naming the gains that the "
      "structure has.");
  module.def(
      "closed_loop",
      [](const Plant& plant, const Controller& controller, double delay) {
        return control::closed_loop(plant.section.plant, controller, delay);
      },
      py::arg("plant"), py::arg("controller"), py::arg("delay"),
      "Plant, controller and dead time (s, above 0; as a rational function of order 8) as one "
      "StateSpace: "
      "inputs "
      "wind_torque, encoder_noise, tachometer_noise, rate_disturbance and, where it is fed back, "
      "torque_noise; outputs beam, encoder, tachometer, motor_torque, valve_demand.");
}

}  // namespace boresight::python
