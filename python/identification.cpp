#include <map>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <boresight/app/commands/subcommand.hpp>
#include <boresight/app/redesign/assumed_inputs.hpp>
#include <boresight/app/redesign/sections.hpp>
#include <boresight/io/campaign/campaign_identification.hpp>
#include <boresight/io/campaign/recommended_values.hpp>
#include <boresight/io/case/case_campaign.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/python/bindings.hpp>
#include <boresight/python/interruptible.hpp>
#include <boresight/python/results.hpp>

namespace boresight::python {
namespace {

using numerics::Interval;
using python::interval_of;

// One method's answer, whether from the case's numbers or from its records.
struct Method {
  std::string name;
  std::string assumes;
  Interval reflected_inertia;
  Interval motor_to_load_ratio;
};

Interval interval_of(const identification::CombinedInertia& one) {
  return {one.value, one.standard_uncertainty, one.lower, one.upper};
}

struct Identification : Found {
  std::vector<Method> methods;
  std::optional<Interval> reflected_inertia;
  Interval bulk_modulus, oil_stiffness;
  std::map<std::string, Interval> drive;
};

Identification identify(const io::Case& antenna, std::uint64_t seed, unsigned threads) {
  Identification result{{report_of(antenna, "identify", seed)}, {}, {}, {}, {}, {}};
  interruptible([&](const StopRequest& stop) {
    app::StudyOptions options;
    options.seed = seed;
    options.threads = app::all_or(threads);
    options.progress = [&stop](std::size_t, std::size_t) {
      if (stop()) throw Interrupted("interrupted");
    };
    result.report.identification = app::identify(antenna, options);
    result.report.assumed = app::identification_inputs(antenna);
    if (!antenna.campaign->records.empty()) {
      result.report.campaign = io::identify_campaign(antenna, options);
      result.report.superseded = io::superseded_inputs(antenna, *result.report.campaign);
    }
    return true;
  });

  if (!result.report.identification) throw std::logic_error("identify: nothing was found");
  const auto& section = *result.report.identification;
  for (const auto& method : section.inertia.methods) {
    result.methods.push_back({method.name, method.assumes, interval_of(method.reflected_inertia),
                              interval_of(method.motor_to_load_ratio)});
  }
  if (section.combined) result.reflected_inertia = interval_of(*section.combined);
  result.bulk_modulus = interval_of(section.inertia.bulk_modulus);
  result.oil_stiffness = interval_of(section.inertia.oil_stiffness);
  if (!result.report.campaign) return result;

  const auto& campaign = *result.report.campaign;
  for (const auto& row : campaign.inertia) {
    result.methods.push_back({row.name, row.assumes, row.inertia, row.motor_to_load_ratio});
  }
  result.reflected_inertia.reset();
  const auto values = io::recommended(campaign);
  if (!values) return result;
  result.reflected_inertia = values->inertia;
  for (const auto& quantity : campaign.grey_box->quantities) {
    result.drive.emplace(quantity.name, quantity.posterior);
  }
  return result;
}

}  // namespace

void add_identification(py::module_& module) {
  py::class_<Method>(module, "Method", "One method's answer for the reflected inertia.")
      .def_readonly("name", &Method::name)
      .def_readonly("assumes", &Method::assumes)
      .def_readonly("reflected_inertia", &Method::reflected_inertia,
                    "Interval, kg m2 at the motor shaft, of all motors and what they drive")
      .def_readonly("motor_to_load_ratio", &Method::motor_to_load_ratio,
                    "Interval: all motors over everything else")
      .def("__repr__", [](const Method& method) {
        return fmt::format("<boresight.Method {}: {:.4g} kg m2>", method.name,
                           method.reflected_inertia.value);
      });

  py::class_<Identification, Found>(module, "Identification", "What identify() found.")
      .def_readonly("methods", &Identification::methods,
                    "Every Method: those of the case's numbers, then those of its records")
      .def_readonly("reflected_inertia", &Identification::reflected_inertia,
                    "Interval, kg m2: one estimate of all methods, by the model that explains all "
                    "records at once where there are any; None where there are too few methods")
      .def_readonly("bulk_modulus", &Identification::bulk_modulus,
                    "Interval, Pa, of the case's numbers")
      .def_readonly("oil_stiffness", &Identification::oil_stiffness,
                    "Interval, N m/rad, of the case's numbers")
      .def_readonly(
          "drive", &Identification::drive,
          "Interval by name, SI: what the records say of the drive; empty without records");

  module.def(
      "identify", &identify, py::arg("case"), py::arg("seed") = 1, py::arg("threads") = 0,
      "Reflected inertia and motor-to-load ratio by every method that the case has the numbers "
      "for, and all that its records say of the drive. threads = 0: all; the result does not "
      "depend on it.");
}

}  // namespace boresight::python
