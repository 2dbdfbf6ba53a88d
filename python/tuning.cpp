#include <map>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <boresight/app/commands/subcommand.hpp>
#include <boresight/app/redesign/assumed_inputs.hpp>
#include <boresight/app/tune/structure_option.hpp>
#include <boresight/app/tune/tune_study.hpp>
#include <boresight/app/tune/tune_verdict.hpp>
#include <boresight/design/studies/controller_study.hpp>
#include <boresight/io/campaign/designed_antenna.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_goals.hpp>
#include <boresight/io/case/case_tuning.hpp>
#include <boresight/io/description/loop_results.hpp>
#include <boresight/python/bindings.hpp>
#include <boresight/python/described_class.hpp>
#include <boresight/python/interruptible.hpp>
#include <boresight/python/results.hpp>

namespace boresight::python {
namespace {

using app::TunedController;
using control::Margins;

struct Tuning : Found {
  const app::TuneSection& section() const {
    if (!report.tuned) throw std::logic_error("tune: nothing was found");
    return *report.tuned;
  }
};

Tuning tune(io::Case antenna, const std::vector<std::string>& structures,
            std::vector<double> wind_speeds, const std::map<std::string, std::string>& goals,
            int starts, std::uint64_t seed, unsigned threads) {
  std::vector<std::string> changes;
  for (const auto& [key, value] : goals) changes.push_back(fmt::format("{}={}", key, value));
  io::change_goals(*antenna.goals, changes);
  app::structure_option(antenna, structures);
  Tuning result{{report_of(antenna, "tune", seed)}};
  auto study = interruptible([&](const StopRequest& stop) {
    auto designed = io::designed_antenna(antenna, seed, app::all_or(threads), stop);
    result.report.superseded = std::move(designed.superseded);
    antenna = std::move(designed.antenna);
    design::TuneOptions options;
    options.structures = app::structure_option(antenna, structures);
    options.wind_speeds = std::move(wind_speeds);
    options.starts = starts;
    options.seed = seed;
    options.threads = app::all_or(threads);
    options.interrupted = stop;
    return study_controllers(designed.mission, designed.ensemble, options,
                             design::ChoiceDetail::verified);
  });
  result.report.tuned = app::section_of(antenna, std::move(study.tuned));
  result.report.time_domain = app::section_of(antenna, std::move(study.time_domain));
  result.report.assumed =
      app::assumed_inputs(antenna, {.time_runs = result.report.time_domain.has_value()});
  result.report.conclusions = app::conclude(*result.report.tuned);
  if (result.report.time_domain) {
    result.report.conclusions.push_back(app::conclude(*result.report.time_domain));
  }
  return result;
}

std::map<std::string, Margins> margins_of(const TunedController& controller) {
  std::map<std::string, Margins> margins;
  if (!controller.stable()) return margins;
  for (std::size_t i = 0; i < control::loop_breaks.size(); ++i) {
    margins.emplace(control::to_string(control::loop_breaks.at(i)),
                    controller.design.margins.at(i));
  }
  return margins;
}

void add_margins(py::module_& module) {
  py::class_<Margins> type(module, "Margins",
                           "Of one loop, cut at one place. SI; gains as factors, phase in degrees; "
                           "infinite or 0 where no change makes the loop unstable.");
  add_described_numbers(type, {{"increasing_gain_margin", "increasing_gain"},
                               {"decreasing_gain_margin", "decreasing_gain"},
                               {"phase_margin", "phase_deg"},
                               {"delay_margin", "delay"}});
  type.def_property_readonly(
          "sensitivity_peak", [](const Margins& margins) { return margins.sensitivity.magnitude; },
          "Largest |S|, S = 1/(1 + L)")
      .def_property_readonly(
          "sensitivity_frequency",
          [](const Margins& margins) { return margins.sensitivity.frequency; }, "Where, rad/s")
      .def_property_readonly(
          "disk", [](const Margins& margins) { return margins.disk.alpha; },
          "Disk margin alpha (skew 0)")
      .def("__repr__", [](const Margins& margins) {
        return fmt::format("<boresight.Margins Ms {:.4g}, gain x {:.4g}, phase {:.4g} deg>",
                           margins.sensitivity.magnitude, margins.increasing_gain_margin,
                           margins.phase_margin_deg);
      });
}

void add_tuned_controller(py::module_& module) {
  py::class_<TunedController>(module, "TunedController",
                              "One tuned controller, evaluated. Angles rad at the sky, one axis.")
      .def_readonly("structure", &TunedController::structure)
      .def_property_readonly(
          "tuned_for",
          [](const TunedController& controller) {
            return std::string(to_string(controller.tuned_for));
          },
          "'nominal': the case's plant; 'robust': every ensemble member; 'present': "
          "not tuned, the gains that the antenna runs on")
      .def_readonly("wind_speed", &TunedController::wind_speed, "m/s, that it is tuned for")
      .def_property_readonly(
          "controller",
          [](const TunedController& controller) { return controller.design.tuning.controller; },
          "Controller")
      .def_property_readonly(
          "gains",
          [](const TunedController& controller) -> py::object {
            return py::cast(controller.design.tuning.controller).attr("gains");
          },
          "By symbol, SI")
      .def_readonly("boresight_rms", &TunedController::boresight_rms,
                    "rad; NaN without a stable controller")
      .def_property_readonly(
          "wind_rms", [](const TunedController& controller) { return controller.design.wind_rms; },
          "rad, the part by wind")
      .def_property_readonly(
          "noise_rms",
          [](const TunedController& controller) { return controller.design.noise_rms; },
          "rad, the part by the sensors' noise")
      .def_property_readonly(
          "control_effort",
          [](const TunedController& controller) { return controller.design.control_effort; },
          "rad/s rms of valve command by noise")
      .def_property_readonly("margins", &margins_of,
                             "Margins by loop break: 'rate loop alone', 'valve command', 'position "
                             "loop'; empty without a stable controller")
      .def_property_readonly(
          "worst_boresight_rms",
          [](const TunedController& controller) -> std::optional<double> {
            if (!controller.ensemble) return std::nullopt;
            return controller.ensemble->largest_rms;
          },
          "rad, the largest over the ensemble members")
      .def_property_readonly("stable", &TunedController::stable)
      .def_readonly("constraints_met", &TunedController::constraints_met)
      .def_property_readonly(
          "verified",
          [](const TunedController& controller) { return controller.design.verification.passed; },
          "Independent code agrees: eigenvalues, bracketed peaks, Lyapunov rms")
      .def("__repr__", [](const TunedController& controller) {
        return fmt::format("<boresight.TunedController {}, {}, {} m/s: {:.4f} mdeg rms>",
                           controller.structure, to_string(controller.tuned_for),
                           controller.wind_speed,
                           controller.boresight_rms * 180e3 / std::numbers::pi);
      });
}

}  // namespace

void add_tuning(py::module_& module) {
  add_margins(module);
  add_tuned_controller(module);
  py::class_<Tuning, Found>(module, "Tuning", "What tune() found.")
      .def_property_readonly(
          "controllers", [](const Tuning& tuning) { return tuning.section().controllers; },
          "Every TunedController")
      .def_property_readonly(
          "best",
          [](const Tuning& tuning) -> std::optional<TunedController> {
            const TunedController* best = recommended_tuned_controller(tuning.section());
            if (best == nullptr) return std::nullopt;
            return *best;
          },
          "The TunedController that every command of the program recommends, by its runs on the "
          "nonlinear "
          "antenna where the case has a [simulation]; None if none is fit")
      .def_property_readonly(
          "shortfalls",
          [](const Tuning& tuning) {
            std::vector<std::pair<std::string, std::string>> shortfalls;
            for (const auto& one : tuning.section().shortfalls) {
              shortfalls.emplace_back(one.infeasible, one.closest);
            }
            return shortfalls;
          },
          "(what cannot be reached, what comes closest); empty if every wind speed has a "
          "controller that "
          "meets all");
  module.def("tune", &tune, py::arg("case"), py::arg("structures") = std::vector<std::string>{},
             py::arg("wind_speeds") = std::vector<double>{}, py::kw_only(),
             py::arg("goals") = std::map<std::string, std::string>{}, py::arg("starts") = 0,
             py::arg("seed") = 1, py::arg("threads") = 0,
             "Tunes loop structures ('PI', 'DPF+C', ...; none: as the case has it) for mean wind "
             "speeds (m/s; "
             "none: the design speed), each for the case's plant and robustly over the ensemble. "
             "goals: changes of the case's [goals], {'valve_effort': '0.4 rad/s'}. "
             "starts, threads "
             "= 0: as the case has it, all; the result depends on the seed, not on the threads. "
             "The program "
             "does the same and then adds the least that any controller could do. Goals that no "
             "controller meets are a result (shortfalls), not an error. Ctrl-C stops it.");
}

}  // namespace boresight::python
