#include <fmt/format.h>
#include <pybind11/stl.h>

#include <boresight/control/controllers/control_law.hpp>
#include <boresight/control/controllers/sampled_law.hpp>
#include <boresight/control/loops/closed_loop.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/python/bindings.hpp>
#include <boresight/python/results.hpp>

namespace boresight::python {
namespace {

using control::ControlLaw;

ControlLaw make_law(const std::string& structure, const py::dict& gains) {
  ControlLaw law{control::LoopStructure::named(structure), {}};
  std::string symbols;
  for (const auto& gain : law.structure.gains()) {
    symbols += (symbols.empty() ? "" : ", ") + gain.symbol;
    if (gains.contains(gain.symbol)) {
      law.gains.push_back(gains[gain.symbol.c_str()].cast<double>());
    }
  }
  if (law.gains.size() != law.structure.gains().size() || gains.size() != law.gains.size()) {
    throw InvalidInput(fmt::format("control_law: expected the gains {} of {}, found {}", symbols,
                                   structure, py::str(py::list(gains)).cast<std::string>()));
  }
  control::validate(law);
  return law;
}

py::dict gains_of(const ControlLaw& law) {
  py::dict gains;
  const auto& descriptions = law.structure.gains();
  for (std::size_t i = 0; i < law.gains.size(); ++i) {
    gains[descriptions[i].symbol.c_str()] = law.gains[i];
  }
  return gains;
}

}  // namespace

void add_control_law(py::module_& module) {
  py::class_<ControlLaw>(module, "ControlLaw", "A loop structure with its gains: see control_law.")
      .def_property_readonly("structure",
                             [](const ControlLaw& law) { return law.structure.name(); })
      .def_property_readonly("gains", &gains_of, "By symbol, SI")
      .def_property_readonly(
          "units",
          [](const ControlLaw& law) {
            py::dict units;
            for (const auto& gain : law.structure.gains()) units[gain.symbol.c_str()] = gain.unit;
            return units;
          },
          "Of the gains, by symbol")
      .def(
          "state_space", [](const ControlLaw& law) { return control::to_state_space(law); },
          "StateSpace: inputs tachometer (rad/s), encoder (rad), rate_disturbance (rad/s, added to "
          "the rate command) and, where it is fed back, motor_torque (N m); outputs valve_demand "
          "(rad/s, before the dead time) and rate_command.")
      .def(
          "sampled_controller",
          [](const ControlLaw& law, double sample_time) {
            return control::sampled_law(law, sample_time);
          },
          py::arg("sample_time"),
          "The form that the antenna's computer runs every sample_time (s): Tustin's method, "
          "corners "
          "prewarped. Neither hold nor computing delay are in it.")
      .def("__repr__", [](const ControlLaw& law) {
        return fmt::format("<boresight.ControlLaw {}: {}>", law.structure.name(),
                           py::str(gains_of(law)).cast<std::string>());
      });

  module.def(
      "control_law", &make_law, py::arg("structure"), py::arg("gains"),
      "A controller with gains of your own, by symbol, SI. Structures: 'PI-0' (PI without lag), "
      "'PI' (PI with lag), 'DPF' (PI with lag and pressure feedback), 'LL' (PI with lead and lag) "
      "or 'FULL' (PI with lead, lag and pressure feedback), with +N (notch) and +C (compliance "
      "compensation) behind it. Raises InvalidInput naming the gains that the structure has.");
  module.def(
      "closed_loop",
      [](const Plant& plant, const ControlLaw& law, double delay) {
        return control::closed_loop(plant.section.plant, law, delay);
      },
      py::arg("plant"), py::arg("controller"), py::arg("delay"),
      "Plant, law and dead time (s, above 0; as a rational function of order 8) as one StateSpace: "
      "inputs "
      "wind_torque, encoder_noise, tachometer_noise, rate_disturbance and, where it is fed back, "
      "torque_noise; outputs beam, encoder, tachometer, motor_torque, valve_demand.");
}

}  // namespace boresight::python
