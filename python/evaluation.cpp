#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <boresight/app/commands/subcommand.hpp>
#include <boresight/app/evaluate/evaluate_study.hpp>
#include <boresight/app/redesign/assumed_inputs.hpp>
#include <boresight/app/tune/structure_option.hpp>
#include <boresight/io/campaign/designed_antenna.hpp>
#include <boresight/io/proposals/compared_antennas.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/python/bindings.hpp>
#include <boresight/python/interruptible.hpp>
#include <boresight/python/results.hpp>

namespace boresight::python {
namespace {

using app::Candidate;

struct Evaluation : Found {
  const app::EvaluateSection& section() const {
    if (!report.evaluated) throw std::logic_error("evaluate: nothing was found");
    return *report.evaluated;
  }
};

Evaluation evaluate(io::Case antenna, const std::vector<std::string>& paths,
                    const std::vector<std::string>& structures, std::size_t random_samples,
                    int starts, bool time_domain, std::uint64_t seed, unsigned threads) {
  std::vector<io::Proposal> proposals;
  for (const auto& path : paths) proposals.push_back(io::read_proposal(path));
  io::check_proposals(antenna, proposals);
  app::structure_option(antenna, structures);
  app::EvaluateOptions options;
  options.structures = structures;
  options.random_samples = random_samples;
  options.starts = starts;
  options.time_domain = time_domain;
  options.seed = seed;
  options.threads = app::all_or(threads);
  Evaluation result{{report_of(antenna, "evaluate", seed)}};
  result.report.evaluated = interruptible([&](const StopRequest& stop) {
    auto designed = io::designed_antenna(antenna, seed, options.threads, stop);
    result.report.superseded = std::move(designed.superseded);
    antenna = std::move(designed.antenna);
    options.interrupted = stop;
    return app::evaluate_proposals(
        antenna, proposals, {std::move(designed.distribution), designed.from_records}, options);
  });
  result.report.assumed =
      app::assumed_inputs(antenna, {.steady_motion = true, .time_runs = time_domain});
  app::add_assumed(proposals, result.report.assumed);
  result.report.conclusions = app::conclude(*result.report.evaluated);
  return result;
}

// Of the chosen controller; nothing without one.
template <typename Value>
auto of_controller(Value (*value)(const design::CandidateController&)) {
  return [value](const Candidate& candidate) -> std::optional<Value> {
    const design::CandidateController* controller = candidate.chosen_controller();
    return controller == nullptr ? std::nullopt : std::optional(value(*controller));
  };
}

void add_candidate(py::module_& module) {
  py::class_<Candidate>(module, "Candidate",
                        "The antenna as it is, or as a proposal makes it, with what is recommended "
                        "for it. SI.")
      .def_readonly("name", &Candidate::name)
      .def_readonly("path", &Candidate::path, "Of the proposal; empty for the antenna as it is")
      .def_readonly("cost", &Candidate::cost, "In the proposals' currency, or None")
      .def_readonly("motor_inertia", &Candidate::motor_inertia, "kg m2, all motors")
      .def_readonly("reflected_inertia", &Candidate::reflected_inertia, "kg m2")
      .def_readonly("motor_to_load_ratio", &Candidate::motor_to_load_ratio)
      .def_property_readonly("fit", &Candidate::feasible,
                             "Its controller meets every constraint, passed its verification and "
                             "has no limit cycle beyond the allowed amplitude")
      .def_property_readonly("structure", of_controller<std::string>([](const auto& controller) {
                               return controller.structure;
                             }),
                             "Of the recommended controller; None if no structure is stable")
      .def_property_readonly("controller",
                             of_controller<control::Controller>([](const auto& controller) {
                               return controller.design.tuning.controller;
                             }),
                             "The recommended Controller")
      .def_property_readonly("boresight_rms", of_controller<double>([](const auto& controller) {
                               return controller.compared_rms();
                             }),
                             "rad at the sky, over all ensemble members, as the simulation has it")
      .def_property_readonly(
          "reversal_error", &Candidate::reversal_error,
          "rad at the sky, the largest after a velocity reversal at the tracking rate")
      .def("__repr__", [](const Candidate& candidate) {
        const design::CandidateController* controller = candidate.chosen_controller();
        if (controller == nullptr)
          return fmt::format("<boresight.Candidate {}: unstable>", candidate.name);
        return fmt::format("<boresight.Candidate {}, {}: {:.4f} mdeg rms>", candidate.name,
                           controller->structure, controller->compared_rms() / millidegree);
      });
}

std::optional<Candidate> worth_its_cost(const Evaluation& evaluation) {
  const app::EvaluateSection& section = evaluation.section();
  if (!section.decision) return std::nullopt;
  const auto& decision = *section.decision;
  return section.candidates[decision.candidates[decision.worth].candidate];
}

}  // namespace

void add_evaluation(py::module_& module) {
  add_candidate(module);
  py::class_<Evaluation, Found>(module, "Evaluation", "What evaluate() found.")
      .def_property_readonly(
          "candidates",
          [](const Evaluation& evaluation) { return evaluation.section().candidates; },
          "A Candidate for the antenna as it is, then one for each proposal")
      .def_property_readonly(
          "worth_its_cost", &worth_its_cost,
          "The cheapest of the fit Candidates whose rms over the samples is within "
          "2 % of the least; None without two that can be compared")
      .def_property_readonly(
          "probabilities",
          [](const Evaluation& evaluation) {
            std::vector<std::pair<std::string, double>> probabilities;
            const auto& section = evaluation.section();
            if (!section.decision) return probabilities;
            const auto& decision = *section.decision;
            for (std::size_t i = 0; i < decision.candidates.size(); ++i) {
              probabilities.emplace_back(section.candidates[decision.candidates[i].candidate].name,
                                         decision.statistics.options[i].best.value);
            }
            return probabilities;
          },
          "(name, probability that it has the least rms) of those compared");
  module.def(
      "evaluate", &evaluate, py::arg("case"), py::arg("proposals") = std::vector<std::string>{},
      py::arg("structures") = std::vector<std::string>{}, py::kw_only(), py::arg("draws") = 2000,
      py::arg("starts") = 0, py::arg("time_domain") = true, py::arg("seed") = 1,
      py::arg("threads") = 0,
      "Tunes the antenna as it is and what each proposal (paths of files, docs/proposals.md) makes "
      "of it, and compares them over the same samples of what is uncertain. time_domain: "
      "controllers run on "
      "the nonlinear antenna, if the case describes it. The result depends on the seed, not on the "
      "threads. Ctrl-C stops it.");
}

}  // namespace boresight::python
