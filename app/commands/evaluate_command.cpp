#include <algorithm>
#include <map>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <boresight/app/commands/evaluate_command.hpp>
#include <boresight/app/commands/progress_line.hpp>
#include <boresight/app/evaluate/evaluate_study.hpp>
#include <boresight/app/evaluate/unfit_candidates.hpp>
#include <boresight/app/figures/report_figures.hpp>
#include <boresight/app/page/report_page.hpp>
#include <boresight/app/redesign/assumed_fractions_fixed.hpp>
#include <boresight/app/redesign/assumed_inputs.hpp>
#include <boresight/app/redesign/sections.hpp>
#include <boresight/app/report/json_report.hpp>
#include <boresight/app/report/text_report.hpp>
#include <boresight/app/tune/structure_option.hpp>
#include <boresight/io/campaign/designed_antenna.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_goals.hpp>
#include <boresight/io/case/friction_leeway.hpp>
#include <boresight/io/files/write_atomically.hpp>
#include <boresight/io/proposals/compared_antennas.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::app {
namespace {

int run(EvaluateArguments arguments) {
  arguments.threads = all_or(arguments.threads);
  watch_for_interrupt();
  Report report = evaluate_case(arguments, interrupt_requested);
  report.figures = report_figures(report);
  arguments.outputs.deliver({.document = [&] { return document_of(report); },
                             .json = [&] { return to_json(report); },
                             .page = [&] { return page_of(report); }});
  if (report.interrupted) return interrupted;
  if (!report.evaluated) return internal_error;
  int code = done;
  for (const auto& candidate : report.evaluated->candidates) {
    const CandidateController* controller = candidate.chosen_controller();
    const bool met = controller != nullptr && controller->constraints_met;
    // A limit cycle breaks no constraint; the report states it and does not choose such a
    // controller.
    if (met && controller->design.verification.passed) continue;
    fmt::print(stderr, "boresight: {}: {}\n", candidate.name,
               controller == nullptr ? "no structure has a stable controller"
               : met ? "no controller that meets its constraints passes its verification"
                     : "no controller meets the constraints on every plant");
    if (code != infeasible) code = met ? numerical : infeasible;
  }
  for (const auto& sentence : unmet_needs(*report.evaluated)) {
    fmt::print(stderr, "boresight: {}: {}\n", arguments.case_path, sentence);
    code = infeasible;
  }
  return code;
}

}  // namespace

Report evaluate_case(const EvaluateArguments& arguments, const std::function<bool()>& interrupted) {
  io::Case antenna = io::read_case(arguments.case_path);
  io::change_goals(*antenna.goals, arguments.goals);
  std::vector<io::Proposal> proposals;
  for (const auto& path : arguments.proposals) proposals.push_back(io::read_proposal(path));
  io::check_proposals(antenna, proposals);
  EvaluateOptions options;
  options.structures = arguments.structures;
  options.random_samples = arguments.random_samples;
  options.starts = arguments.starts;
  options.time_domain = arguments.time_domain;
  options.seed = arguments.seed;
  options.threads = arguments.threads;
  options.interrupted = interrupted;
  if (!options.structures.empty()) structure_option(antenna, options.structures);
  arguments.outputs.require_writable();

  Report report = begin_report("evaluate", antenna, arguments.case_path, arguments.seed);
  ProgressLine progress("tuning and comparing proposals");
  std::optional<design::PlantUncertainty> uncertainty;
  try {
    io::DesignedAntenna designed =
        designed_antenna(antenna, arguments.seed, arguments.threads, interrupted);
    report.resonance = resonance_verdict(designed);
    report.superseded = std::move(designed.superseded);
    antenna = std::move(designed.antenna);
    uncertainty = design::PlantUncertainty{std::move(designed.distribution), designed.from_records};
  } catch (const Interrupted&) {
    report.interrupted = true;
    report.assumed = assumed_inputs(antenna);
    return report;
  }
  report.assumed =
      assumed_inputs(antenna, {.steady_motion = true, .time_runs = options.time_domain});
  add_assumed(proposals, report.assumed);
  options.progress = [&](std::size_t done, std::size_t all) { progress.show(done, all); };
  report.evaluated = evaluate_proposals(antenna, proposals, *uncertainty, options);
  report.interrupted = interrupted && interrupted();
  report.conclusions = conclude(*report.evaluated);
  const auto& candidates = report.evaluated->candidates;
  // An interrupted study may not have got to the antenna as it is.
  if (!candidates.empty() && candidates.front().path.empty()) {
    if (const CandidateController* controller = candidates.front().chosen_controller()) {
      conclude_guessed_fractions(antenna, controller->design.tuning.controller,
                                 report.evaluated->wind_speed, report.conclusions);
    }
  }
  io::conclude_friction_doubt(antenna, report.conclusions);
  lead_with_resonance(report);
  return report;
}

Subcommand add_evaluate(CLI::App& program) {
  const auto arguments = std::make_shared<EvaluateArguments>();
  CLI::App* sub = program.add_subcommand(
      "evaluate", "compare proposals of hardware and software, each re-tuned, with probabilities");
  add_case(*sub, arguments->case_path);
  sub->add_option("PROPOSAL", arguments->proposals,
                  "proposal files (TOML), see docs/proposals.md; none: only the antenna as it is")
      ->expected(0, 1000);
  sub->add_option("--structure", arguments->structures,
                  "loop structures of the antenna as it is and of proposals that name none, one or "
                  "several, as for `tune` (default: those of [tuning])")
      ->expected(1, 100);
  sub->add_option("--goal", arguments->goals,
                  "KEY=VALUE of [goals] instead of the case's, one or several")
      ->expected(1, 100);
  sub->add_option("--draws", arguments->random_samples, "sampled plants for the probabilities")
      ->check(CLI::Range(100, 1000000))
      ->capture_default_str();
  sub->add_option("--starts", arguments->starts, "random starts of each search")
      ->check(CLI::Range(1, 100000));
  const std::map<std::string, bool> runs{{"none", false}, {"all", true}};
  sub->add_option(
         "--time-domain", arguments->time_domain,
         "controllers simulated and compared on the nonlinear antenna: none; all, the default")
      ->transform(CLI::CheckedTransformer(runs, CLI::ignore_case).description("none, all"))
      ->default_str("all");
  add_outputs(*sub, arguments->outputs);
  add_seed(*sub, arguments->seed);
  add_threads(*sub, arguments->threads);
  return {sub, [arguments] { return run(*arguments); }, &arguments->outputs};
}

}  // namespace boresight::app
