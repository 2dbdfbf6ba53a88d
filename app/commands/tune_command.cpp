#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <boresight/app/commands/progress_line.hpp>
#include <boresight/app/commands/tune_command.hpp>
#include <boresight/app/figures/report_figures.hpp>
#include <boresight/app/models/linear_models.hpp>
#include <boresight/app/page/report_page.hpp>
#include <boresight/app/redesign/assumed_fractions_fixed.hpp>
#include <boresight/app/redesign/assumed_inputs.hpp>
#include <boresight/app/redesign/sections.hpp>
#include <boresight/app/report/json_report.hpp>
#include <boresight/app/report/measured_report.hpp>
#include <boresight/app/report/text_report.hpp>
#include <boresight/app/tune/structure_option.hpp>
#include <boresight/app/tune/tune_study.hpp>
#include <boresight/app/tune/tune_verdict.hpp>
#include <boresight/design/studies/controller_study.hpp>
#include <boresight/design/studies/limit_study.hpp>
#include <boresight/io/campaign/designed_antenna.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_goals.hpp>
#include <boresight/io/case/mission_of.hpp>
#include <boresight/io/files/write_atomically.hpp>
#include <boresight/io/units/wording.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::app {
namespace {

std::vector<double> read_speeds(const std::vector<std::string>& texts) {
  std::vector<double> speeds;
  for (const auto& text : texts) {
    try {
      speeds.push_back(io::parse_quantity(text, io::Kind::speed).value);
    } catch (const InvalidInput& error) {
      throw InvalidInput(fmt::format("--speed {}: {}", io::in_quotes(text), error.what()));
    }
  }
  return speeds;
}

}  // namespace

Report tune_case(const TuneArguments& arguments, const std::function<bool()>& interrupted) {
  io::Case antenna = io::read_case(arguments.case_path);
  io::change_goals(*antenna.goals, arguments.goals);
  design::TuneOptions options;
  options.wind_speeds = read_speeds(arguments.speeds);
  options.starts = arguments.starts;
  options.seed = arguments.seed;
  options.threads = arguments.threads;
  options.interrupted = interrupted;
  if (!arguments.structures.empty()) {
    options.structures = structure_option(antenna, arguments.structures);
  }
  if (arguments.no_limit &&
      (options.structures.empty() ? io::asked_structures(antenna) : options.structures)
          .state_space_named) {
    throw InvalidInput(
        "tune: expected either --no-limit or the structure SS, whose design comes from the limit, "
        "found both");
  }
  arguments.outputs.require_writable();

  Report report = begin_report("tune", antenna, arguments.case_path, arguments.seed);
  if (!arguments.measured_record.empty()) {
    if (!arguments.outputs.mat_path.empty()) {
      throw InvalidInput("tune: expected --mat with a model to write, found --measured");
    }
    if (arguments.no_limit) {
      throw InvalidInput("tune: expected --no-limit with a model's limit, found --measured");
    }
    MeasuredTuneOptions study;
    study.record = arguments.measured_record;
    study.structures = arguments.structures;
    study.starts = arguments.starts;
    study.seed = arguments.seed;
    study.interrupted = interrupted;
    report.measured = tune_measured(antenna, study);
    report.conclusions = conclude(*report.measured);
    report.assumed = assumed_inputs(antenna);
    report.interrupted = interrupted && interrupted();
    return report;
  }
  ProgressLine progress("tuning and verifying");
  design::Mission mission;
  design::PlantEnsemble ensemble;
  try {
    io::DesignedAntenna designed =
        designed_antenna(antenna, arguments.seed, arguments.threads, interrupted);
    report.resonance = resonance_verdict(designed);
    report.superseded = std::move(designed.superseded);
    antenna = std::move(designed.antenna);
    mission = std::move(designed.mission);
    ensemble = std::move(designed.ensemble);
  } catch (const Interrupted&) {
    report.interrupted = true;
    report.assumed = assumed_inputs(antenna);
    return report;
  }
  report.assumed = assumed_inputs(antenna);
  if (arguments.no_limit) {
    if (options.structures.empty()) options.structures = mission.structures;
    options.structures.state_space = false;
  }
  options.progress = [&](std::size_t done, std::size_t all) { progress.show(done, all); };
  design::ControllerStudy study =
      study_controllers(mission, ensemble, options, design::ChoiceDetail::verified);
  report.tuned = section_of(antenna, std::move(study.tuned));
  report.time_domain = section_of(antenna, std::move(study.time_domain));
  report.interrupted = interrupted && interrupted();
  const TunedController* shown =
      shown_controller(*report.tuned, report.time_domain ? &*report.time_domain : nullptr);
  if (shown != nullptr && !report.interrupted) {
    report.tuned->curves = curves_of(*report.tuned, *shown, ensemble, arguments.threads);
  }
  if (report.time_domain) report.assumed = assumed_inputs(antenna, {.time_runs = true});
  const TunedController* best = best_controller(*report.tuned);
  report.limit = std::move(study.limit);
  if (best != nullptr && !report.interrupted && !arguments.no_limit && !report.limit) {
    report.limit =
        pointing_limit_of(mission, *report.tuned, ensemble, best->wind_speed, arguments.threads);
    if (report.time_domain && report.time_domain->wind_speed == best->wind_speed) {
      report.state_space = design::study_state_space(mission, report.tuned->problem, *report.limit,
                                                     *report.time_domain, arguments.threads);
    }
  }
  report.conclusions = conclude(*report.tuned);
  if (report.time_domain) report.conclusions.push_back(conclude(*report.time_domain));
  const TunedController* controller =
      best != nullptr ? recommended_tuned_controller(*report.tuned) : nullptr;
  if (controller != nullptr && !report.interrupted) {
    conclude_guessed_fractions(antenna, controller->design.tuning.controller,
                               controller->wind_speed, report.conclusions);
  }
  lead_with_resonance(report);
  return report;
}

namespace {

int run(TuneArguments arguments) {
  arguments.threads = all_or(arguments.threads);
  watch_for_interrupt();
  Report report = tune_case(arguments, interrupt_requested);
  report.figures = report_figures(report);
  arguments.outputs.deliver({.document = [&] { return document_of(report); },
                             .json = [&] { return to_json(report); },
                             .page = [&] { return page_of(report); },
                             .mat = mat_of(report)});
  if (report.interrupted) return interrupted;
  if (report.measured) {
    if (report.measured->any_confident()) return done;
    fmt::print(
        stderr,
        "boresight: no controller meets its constraints within the measurement's confidence\n");
    return infeasible;
  }
  if (!report.tuned) return internal_error;
  for (const auto& shortfall : report.tuned->shortfalls) {
    fmt::print(stderr, "boresight: {}: {} {}\n", arguments.case_path, shortfall.infeasible,
               shortfall.closest);
  }
  if (!report.tuned->shortfalls.empty()) return infeasible;
  if (report.tuned->unverified) {
    fmt::print(stderr,
               "boresight: no controller that meets its constraints passes its verification\n");
    return numerical;
  }
  return done;
}

}  // namespace

Subcommand add_tune(CLI::App& program) {
  const auto arguments = std::make_shared<TuneArguments>();
  CLI::App* sub = program.add_subcommand(
      "tune", "tune loop structures for the least boresight rms in wind, robustly and verified");
  add_case(*sub, arguments->case_path);
  sub->add_option(
         "--structure", arguments->structures,
         "loop structures to tune, one or several: PI-0 (PI without lag), PI (PI with "
         "lag), DPF (PI with lag and pressure feedback), LL (PI with lead and lag), FULL "
         "(PI with lead, lag and pressure feedback), with suffixes +L (position lag instead "
         "of the integrals), +D (dead zone of one integral) or +F (freeze of one integral), "
         "+N (notch) and +C (compliance compensation), or a [[loop]] of the case; also SS "
         "(a state space, designed from the best of the others, alone from the best of the "
         "structures of the case); see docs/control-structures.md")
      ->expected(1, 100);
  sub->add_option("--goal", arguments->goals,
                  "KEY=VALUE of [goals] instead of the case's, one or several")
      ->expected(1, 100);
  sub->add_option("--speed", arguments->speeds,
                  "mean wind speeds to tune for, such as \"10 m/s\" (default: the design speed)")
      ->expected(1, 100);
  sub->add_option("--measured", arguments->measured_record,
                  "tune on the response measured in this record of the case, without a model: see "
                  "docs/measured-tuning.md");
  sub->add_option("--starts", arguments->starts, "random starts of each search")
      ->check(CLI::Range(1, 100000));
  sub->add_flag("--no-limit", arguments->no_limit,
                "omit the lower bound of any linear controller and the state-space controller");
  add_outputs(*sub, arguments->outputs);
  add_mat(*sub, arguments->outputs);
  add_seed(*sub, arguments->seed);
  add_threads(*sub, arguments->threads);
  return {sub, [arguments] { return run(*arguments); }, &arguments->outputs};
}

}  // namespace boresight::app
