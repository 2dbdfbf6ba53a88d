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

using app::TunedLaw;
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

std::map<std::string, Margins> margins_of(const TunedLaw& law) {
  std::map<std::string, Margins> margins;
  if (!law.stable()) return margins;
  for (std::size_t i = 0; i < control::loop_breaks.size(); ++i) {
    margins.emplace(control::to_string(control::loop_breaks.at(i)), law.design.margins.at(i));
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
        return fmt::format("<boresight.Margins peak of S {:.4g}, gain x {:.4g}, phase {:.4g} deg>",
                           margins.sensitivity.magnitude, margins.increasing_gain_margin,
                           margins.phase_margin_deg);
      });
}

void add_tuned_law(py::module_& module) {
  py::class_<TunedLaw>(module, "TunedLaw",
                       "One tuned law, judged. Angles rad at the sky, one axis.")
      .def_readonly("structure", &TunedLaw::structure)
      .def_property_readonly(
          "tuned_for", [](const TunedLaw& law) { return std::string(to_string(law.tuned_for)); },
          "'nominal': the case's plant; 'robust': every plant that may be the true one; 'present': "
          "not tuned, the gains that the antenna runs on")
      .def_readonly("wind_speed", &TunedLaw::wind_speed, "m/s, that it is tuned for")
      .def_property_readonly(
          "law", [](const TunedLaw& law) { return law.design.tuning.law; }, "ControlLaw")
      .def_property_readonly(
          "gains",
          [](const TunedLaw& law) -> py::object {
            return py::cast(law.design.tuning.law).attr("gains");
          },
          "By symbol, SI")
      .def_readonly("beam_rms", &TunedLaw::beam_rms, "rad; NaN without a stable law")
      .def_property_readonly(
          "wind_rms", [](const TunedLaw& law) { return law.design.wind_rms; },
          "rad, the part by wind")
      .def_property_readonly(
          "noise_rms", [](const TunedLaw& law) { return law.design.noise_rms; },
          "rad, the part by the sensors' noise")
      .def_property_readonly(
          "valve_effort", [](const TunedLaw& law) { return law.design.valve_effort; },
          "rad/s rms of valve command by noise")
      .def_property_readonly("margins", &margins_of,
                             "Margins by loop break: 'rate loop alone', 'valve command', 'position "
                             "loop'; empty without a stable law")
      .def_property_readonly(
          "worst_beam_rms",
          [](const TunedLaw& law) -> std::optional<double> {
            if (!law.ensemble) return std::nullopt;
            return law.ensemble->largest_rms;
          },
          "rad, the largest over the plants that may be the true one")
      .def_property_readonly("stable", &TunedLaw::stable)
      .def_readonly("goals_met", &TunedLaw::goals_met)
      .def_property_readonly(
          "verified", [](const TunedLaw& law) { return law.design.verification.passed; },
          "Independent code agrees: eigenvalues, bracketed peaks, Lyapunov rms")
      .def("__repr__", [](const TunedLaw& law) {
        return fmt::format("<boresight.TunedLaw {}, {}, {} m/s: {:.4f} mdeg rms>", law.structure,
                           to_string(law.tuned_for), law.wind_speed,
                           law.beam_rms * 180e3 / std::numbers::pi);
      });
}

}  // namespace

void add_tuning(py::module_& module) {
  add_margins(module);
  add_tuned_law(module);
  py::class_<Tuning, Found>(module, "Tuning", "What tune() found.")
      .def_property_readonly(
          "laws", [](const Tuning& tuning) { return tuning.section().laws; }, "Every TunedLaw")
      .def_property_readonly(
          "best",
          [](const Tuning& tuning) -> std::optional<TunedLaw> {
            const TunedLaw* best = recommended_law(tuning.section());
            if (best == nullptr) return std::nullopt;
            return *best;
          },
          "The TunedLaw that every command of the program recommends, by its runs on the nonlinear "
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
          "(what cannot be reached, what comes closest); empty if every wind speed has a law that "
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
             "law meets are a result (shortfalls), not an error. Ctrl-C stops it.");
}

}  // namespace boresight::python
