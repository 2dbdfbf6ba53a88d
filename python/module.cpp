#include <numbers>

#include <boresight/python/bindings.hpp>

PYBIND11_MODULE(boresight, module) {
  namespace python = boresight::python;
  module.doc() =
      "Redesigns the servo of a large antenna from measured data.\n\n"
      "All values are SI and at the motor shaft unless a docstring says otherwise: angles in rad, "
      "rates in rad/s, frequencies of responses in rad/s, of modes and oscillations in Hz. Angles "
      "and "
      "boresight rms errors are rad at the sky: divide by `mdeg` for millidegrees. The "
      "dictionaries "
      "of to_dict() are those of the program's --json, with units in their keys.";
  module.attr("__version__") = BORESIGHT_VERSION;
  module.attr("mdeg") = std::numbers::pi / 180e3;
  python::add_errors(module);
  python::add_state_space(module);
  python::add_reports(module);
  python::add_case(module);
  python::add_identification(module);
  python::add_plant(module);
  python::add_controller(module);
  python::add_tuning(module);
  python::add_matching(module);
  python::add_evaluation(module);
  python::add_simulation(module);
  python::add_commissioning(module);
  python::add_renamed_names(module);
}
