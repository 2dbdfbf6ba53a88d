#include <array>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include <boresight/python/bindings.hpp>

namespace boresight::python {
namespace {

// A name of version 0.1, of the module or of a class, and the present one.
struct RenamedName {
  const char* of;  // class; empty: the module
  const char* before;
  const char* now;
};

constexpr auto renamed_names = std::to_array<RenamedName>({
    {"", "ControlLaw", "Controller"},
    {"", "TunedLaw", "TunedController"},
    {"", "control_law", "controller"},
    {"Controller", "controller", "state_space"},
    {"TunedController", "law", "controller"},
    {"TunedController", "beam_rms", "boresight_rms"},
    {"TunedController", "worst_beam_rms", "worst_boresight_rms"},
    {"TunedController", "valve_effort", "control_effort"},
    {"TunedController", "goals_met", "constraints_met"},
    {"Tuning", "laws", "controllers"},
    {"Candidate", "law", "controller"},
    {"Candidate", "beam_rms", "boresight_rms"},
    {"Evaluation", "chances", "probabilities"},
    {"MatchSeries", "beam_rms", "boresight_rms"},
    {"MatchSeries", "valve_effort", "control_effort"},
    {"MatchSeries", "laws", "controllers"},
    {"Mode", "oil_share", "oil_fraction"},
    {"Mode", "gear_share", "gear_fraction"},
});

void warn(std::string_view before, std::string_view now) {
  const std::string text =
      fmt::format("boresight: {} is now {}; the next version has the new name only", before, now);
  if (PyErr_WarnEx(PyExc_DeprecationWarning, text.c_str(), 1) != 0) throw py::error_already_set();
}

void add_to_class(const py::module_& module, const RenamedName& name) {
  const py::object type = module.attr(name.of);
  const py::cpp_function present(
      [name](const py::object& self) -> py::object {
        warn(fmt::format("{}.{}", name.of, name.before), name.now);
        return self.attr(name.now);
      },
      py::is_method(type));
  type.attr(name.before) = py::module_::import("builtins")
                               .attr("property")(present, py::none(), py::none(),
                                                 fmt::format("Deprecated: {}", name.now));
}

}  // namespace

void add_renamed_names(py::module_& module) {
  for (const auto& name : renamed_names) {
    if (*name.of != '\0') add_to_class(module, name);
  }
  // PEP 562: what the module has not.
  module.attr("__getattr__") = py::cpp_function([](const std::string& asked) -> py::object {
    for (const auto& name : renamed_names) {
      if (*name.of != '\0' || asked != name.before) continue;
      warn(name.before, name.now);
      return py::module_::import("boresight").attr(name.now);
    }
    throw py::attribute_error(fmt::format("module 'boresight' has no attribute '{}'", asked));
  });
  module.def(
      "closed_loop",
      [](const py::object& plant, const py::object& controller, double delay) -> py::object {
        warn("closed_loop's argument law", "controller");
        return py::module_::import("boresight").attr("closed_loop")(plant, controller, delay);
      },
      py::arg("plant"), py::kw_only(), py::arg("law"), py::arg("delay"),
      "Deprecated: the argument law is now controller.");
}

}  // namespace boresight::python
