#include <cmath>
#include <functional>
#include <optional>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <boresight/app/commands/subcommand.hpp>
#include <boresight/app/match/match_conclusions.hpp>
#include <boresight/app/redesign/assumed_inputs.hpp>
#include <boresight/app/tune/structure_option.hpp>
#include <boresight/io/campaign/designed_antenna.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/python/bindings.hpp>
#include <boresight/python/interruptible.hpp>
#include <boresight/python/results.hpp>

namespace boresight::python {
namespace {

using design::MatchPoint;
using design::MatchSeries;
using design::MatchValue;

struct Matching : Found {
  const app::MatchSection& section() const {
    if (!report.matched) throw std::logic_error("match: nothing was found");
    return *report.matched;
  }
};

design::MatchTimeRuns time_runs_of(const std::string& name) {
  if (name == "none") return design::MatchTimeRuns::none;
  if (name == "few") return design::MatchTimeRuns::few;
  if (name == "all") return design::MatchTimeRuns::all;
  throw InvalidInput(
      fmt::format("match: expected time_domain 'none', 'few' or 'all', found '{}'", name));
}

Matching match(io::Case antenna, const std::vector<std::string>& structures, int points,
               double max_disks, int starts, bool robust, bool variants,
               const std::string& time_domain, std::uint64_t seed, unsigned threads) {
  design::MatchOptions options;
  options.points = points;
  options.max_disks = max_disks;
  options.starts = starts;
  options.time_runs = time_runs_of(time_domain);
  options.robust = robust;
  options.variants = variants;
  options.seed = seed;
  options.threads = app::all_or(threads);
  Matching result{{report_of(antenna, "match", seed)}};
  result.report.matched = interruptible([&](const StopRequest& stop) {
    // The ensemble's samples do not depend on the seed of the searches.
    auto designed = io::designed_antenna(antenna, 1, options.threads, stop);
    result.report.superseded = std::move(designed.superseded);
    antenna = std::move(designed.antenna);
    options.interrupted = stop;
    options.structures = app::structure_option(antenna, structures);
    return app::section_of(antenna, study_matching(designed.mission, designed.ensemble, options));
  });
  result.report.assumed =
      app::assumed_inputs(antenna, {.time_runs = options.time_runs != design::MatchTimeRuns::none});
  result.report.conclusions = app::conclude(*result.report.matched);
  return result;
}

// One number of each point or value.
template <typename Item, typename Number>
Eigen::VectorXd column(const std::vector<Item>& items, const Number& number) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(items.size()));
  for (std::size_t i = 0; i < items.size(); ++i) {
    values(static_cast<Eigen::Index>(i)) = std::invoke(number, items[i]);
  }
  return values;
}

template <typename Number>
auto of_points(const Number& number) {
  return [number](const Matching& matching) { return column(matching.section().points, number); };
}

// NaN where no controller holds its goals.
template <typename Number>
auto of_values(const Number& number) {
  return [number](const MatchSeries& series) {
    return column(series.values, [number](const MatchValue& value) {
      return value.found ? std::invoke(number, value) : std::nan("");
    });
  };
}

auto peak_at(std::size_t loop_break) {
  return of_values([loop_break](const MatchValue& value) {
    return value.margins.at(loop_break).sensitivity.magnitude;
  });
}

void add_series(py::module_& module) {
  py::class_<MatchSeries>(
      module, "MatchSeries",
      "One loop structure over all points: arrays with NaN where no controller holds its "
      "goals. Angles rad at the sky.")
      .def_readonly("name", &MatchSeries::name)
      .def_property_readonly("boresight_rms", of_values(&MatchValue::boresight_rms), "rad")
      .def_property_readonly("wind_rms", of_values(&MatchValue::wind_rms), "rad")
      .def_property_readonly("noise_rms", of_values(&MatchValue::noise_rms), "rad")
      .def_property_readonly("control_effort", of_values(&MatchValue::control_effort),
                             "rad/s, by noise")
      .def_property_readonly("bandwidth", of_values(&MatchValue::bandwidth),
                             "Hz, of the position loop")
      .def_property_readonly("peak_rate_loop", peak_at(0), "Largest |S| of the rate loop alone")
      .def_property_readonly("peak_valve_command", peak_at(1), "Largest |S| at the valve command")
      .def_property_readonly("peak_position_loop", peak_at(2), "Largest |S| of the position loop")
      .def_property_readonly(
          "controllers",
          [](const MatchSeries& series) {
            std::vector<std::optional<control::Controller>> controllers;
            for (std::size_t i = 0; i < series.values.size(); ++i) {
              controllers.emplace_back();
              if (series.values[i].found)
                controllers.back() = series.curve.controllers[i].controller;
            }
            return controllers;
          },
          "Controller of each point, or None")
      .def_readonly("best", &MatchSeries::best,
                    "Index of the point of least boresight rms, or None")
      .def_property_readonly(
          "within_5_percent",
          [](const MatchSeries& series) {
            return std::pair(series.within_5_percent.lowest, series.within_5_percent.highest);
          },
          "(fewest, most) disks between which the rms is within 5 % of the least")
      .def("__repr__", [](const MatchSeries& series) {
        return fmt::format("<boresight.MatchSeries {}, {} points>", series.name,
                           series.values.size());
      });
}

}  // namespace

void add_matching(py::module_& module) {
  add_series(module);
  py::class_<Matching, Found>(module, "Matching",
                              "What match() found: arrays over the points, by rising disks.")
      .def_property_readonly("disks", of_points(&MatchPoint::disks), "Flywheel disks on each motor")
      .def_property_readonly("motor_inertia", of_points(&MatchPoint::motor_inertia),
                             "kg m2, of all motors")
      .def_property_readonly("motor_to_load_ratio", of_points(&MatchPoint::motor_to_load_ratio))
      .def_property_readonly("reflected_inertia", of_points(&MatchPoint::reflected_inertia),
                             "kg m2, of all")
      .def_property_readonly(
          "hydraulic_frequency",
          of_points([](const MatchPoint& point) { return point.hydraulic.frequency; }), "Hz")
      .def_property_readonly("hydraulic_damping", of_points([](const MatchPoint& point) {
                               return point.hydraulic.damping_ratio;
                             }))
      .def_property_readonly("acceleration", of_points(&MatchPoint::acceleration),
                             "rad/s2 at the sky, at the slew rate")
      .def_property_readonly("slew_time", of_points(&MatchPoint::slew_time), "s")
      .def_property_readonly(
          "series", [](const Matching& matching) { return matching.section().series; },
          "A MatchSeries for each loop structure");
  module.def(
      "match", &match, py::arg("case"), py::arg("structures") = std::vector<std::string>{},
      py::kw_only(), py::arg("points") = 25, py::arg("most_disks") = 0.0, py::arg("starts") = 4,
      py::arg("robust") = true, py::arg("variants") = false, py::arg("time_domain") = "none",
      py::arg("seed") = 1, py::arg("threads") = 0,
      "Tunes every loop structure at every number of flywheel disks, evenly spaced from 0 to "
      "most_disks (0: as the case has it), beside ratio 1 and as built. robust: over all "
      "ensemble members, else on the case's alone. variants: also what moves the optimum. "
      "time_domain: where controllers run on the nonlinear antenna, 'none', 'few' or 'all'. The "
      "result "
      "depends on the seed, not on the threads. Ctrl-C stops it.");
}

}  // namespace boresight::python
