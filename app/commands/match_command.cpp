#include <map>
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <boresight/app/commands/match_command.hpp>
#include <boresight/app/commands/progress_line.hpp>
#include <boresight/app/figures/report_figures.hpp>
#include <boresight/app/match/match_conclusions.hpp>
#include <boresight/app/page/report_page.hpp>
#include <boresight/app/redesign/assumed_inputs.hpp>
#include <boresight/app/redesign/sections.hpp>
#include <boresight/app/report/json_report.hpp>
#include <boresight/app/report/text_report.hpp>
#include <boresight/app/tune/structure_option.hpp>
#include <boresight/design/studies/what_if_study.hpp>
#include <boresight/io/campaign/designed_antenna.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/friction_leeway.hpp>
#include <boresight/io/files/write_atomically.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::app {
namespace {

struct Arguments {
  std::string case_path;
  Outputs outputs;
  std::vector<std::string> structures;
  design::MatchOptions options;
  /// Of the ensemble's samples. The searches have a seed of their own, which should not matter.
  std::uint64_t ensemble_seed = 1;
  bool nominal = false;
  bool no_variants = false;
};

int run(const Arguments& arguments) {
  io::Case antenna = io::read_case(arguments.case_path);
  arguments.outputs.require_writable();
  design::MatchOptions options = arguments.options;
  options.threads = all_or(options.threads);
  options.interrupted = interrupt_requested;
  options.robust = !arguments.nominal;
  options.variants = !arguments.no_variants;
  options.tune_as_built = true;
  Report report = begin_report("match", antenna, arguments.case_path, options.seed);
  watch_for_interrupt();
  design::Mission mission;
  design::PlantEnsemble ensemble;
  try {
    io::DesignedAntenna designed =
        designed_antenna(antenna, arguments.ensemble_seed, options.threads, interrupt_requested);
    report.resonance = resonance_verdict(designed);
    report.superseded = std::move(designed.superseded);
    antenna = std::move(designed.antenna);
    mission = std::move(designed.mission);
    ensemble = std::move(designed.ensemble);
  } catch (const Interrupted&) {
    fmt::print(stderr, "boresight: interrupted before the records were identified\n");
    return interrupted;
  }
  report.assumed = assumed_inputs(antenna, {.time_runs = options.time_runs != MatchTimeRuns::none});
  {
    std::optional<ProgressLine> line;
    std::string_view working;
    options.progress = [&](std::string_view work, std::size_t finished, std::size_t all) {
      if (work != working) line.emplace(std::string(work));
      working = work;
      line->show(finished, all);
    };
    options.structures = structure_option(antenna, arguments.structures);
    report.matched = section_of(antenna, study_matching(mission, ensemble, options));
  }
  report.interrupted = interrupt_requested();
  report.conclusions = conclude(*report.matched);
  io::conclude_friction_doubt(antenna, report.conclusions);
  lead_with_resonance(report);
  // Seconds that only a page's sliders are worth.
  if (!arguments.outputs.report_path.empty() && !report.interrupted) {
    ProgressLine line("what if");
    design::WhatIfOptions table;
    table.threads = options.threads;
    table.interrupted = interrupt_requested;
    table.progress = [&](std::size_t finished, std::size_t all) { line.show(finished, all); };
    report.matched->what_if = design::what_if(mission, *report.matched, table);
  }
  report.figures = report_figures(report);
  arguments.outputs.deliver({.document = [&] { return document_of(report); },
                             .json = [&] { return to_json(report); },
                             .page = [&] { return page_of(report); }});
  if (report.interrupted) return interrupted;
  bool met = false, verified = false;
  for (const auto& series : report.matched->series) {
    for (const auto& value : series.values) {
      met = met || value.found;
      verified = verified || (value.found && value.verification.passed);
    }
  }
  if (!met) {
    fmt::print(stderr, "boresight: {}: no structure meets the constraints at any motor inertia\n",
               arguments.case_path);
    return infeasible;
  }
  if (!verified) {
    fmt::print(stderr,
               "boresight: no controller that meets its constraints passes its verification\n");
    return numerical;
  }
  return done;
}

}  // namespace

Subcommand add_match(CLI::App& program) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* sub = program.add_subcommand("match",
                                         "re-tune every loop structure robustly at every motor "
                                         "inertia, and evaluate the classic rules");
  design::MatchOptions& options = arguments->options;
  add_case(*sub, arguments->case_path);
  sub->add_option("--structure", arguments->structures,
                  "loop structures, one or several, as for `boresight tune`")
      ->expected(1, 100);
  sub->add_option("--points", options.points,
                  "number of disk counts, evenly spaced from 0; ratio 1 and as built are added")
      ->check(CLI::Range(4, 1000))
      ->capture_default_str();
  sub->add_option("--most-disks", options.max_disks,
                  "largest number of disks (default: most_disks of the case)")
      ->check(CLI::Range(0.1, 1e4));
  sub->add_option("--starts", options.starts, "random starts of each search")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  const std::map<std::string, MatchTimeRuns> runs{
      {"none", MatchTimeRuns::none}, {"few", MatchTimeRuns::few}, {"all", MatchTimeRuns::all}};
  sub->add_option("--time-domain", options.time_runs,
                  "controllers simulated on the nonlinear antenna: none; few (0 disks, ratio 1, as "
                  "built), the default; all")
      ->transform(CLI::CheckedTransformer(runs, CLI::ignore_case).description("none, few, all"))
      ->default_str("few");
  sub->add_option(
         "--ensemble-seed", arguments->ensemble_seed,
         "seed of the ensemble's samples (--seed is that of the searches and should not matter)")
      ->check(CLI::Range(0.0, 1e15))
      ->capture_default_str();
  sub->add_flag("--nominal", arguments->nominal,
                "tune for the nominal plant only, not for every ensemble member");
  sub->add_flag(
      "--no-variants", arguments->no_variants,
      "omit the sensitivity of the optimum to leakage, friction, structure, wind, conventions");
  add_outputs(*sub, arguments->outputs);
  add_seed(*sub, options.seed);
  add_threads(*sub, options.threads);
  return {sub, [arguments] { return run(*arguments); }, &arguments->outputs};
}

}  // namespace boresight::app
