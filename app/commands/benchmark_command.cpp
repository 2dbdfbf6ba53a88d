#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <boresight/app/commands/benchmark_change.hpp>
#include <boresight/app/commands/benchmark_command.hpp>
#include <boresight/app/commands/controller_option.hpp>
#include <boresight/app/commands/progress_line.hpp>
#include <boresight/app/figures/benchmark_figures.hpp>
#include <boresight/app/page/report_page.hpp>
#include <boresight/app/report/json_report.hpp>
#include <boresight/app/tune/chosen_controller.hpp>
#include <boresight/control/controllers/sample_time.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_sensors.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/present_gains.hpp>
#include <boresight/io/exchange/controller_file.hpp>
#include <boresight/io/exchange/gains_file.hpp>
#include <boresight/io/files/input_files.hpp>
#include <boresight/io/files/write_atomically.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::app {
namespace {

// A controller, and the remarks of its file.
struct Named {
  design::BenchmarkedController controller;
  std::vector<std::string> remarks = {};
};

// What the command line names; none where the recommended one is wanted.
std::optional<Named> named_one(const BenchmarkArguments& arguments, const io::Case& antenna,
                               double sample_time) {
  arguments.controller.validate();
  if (!arguments.controller.controller_path.empty()) {
    if (arguments.sampled) {
      throw InvalidInput("--sampled: expected gains, found --controller");
    }
    const auto file = io::read_controller(arguments.controller.controller_path,
                                          io::gear_ratio(antenna), arguments.controller.names);
    return Named{
        {file.system, "controller of " + arguments.controller.controller_path, std::nullopt},
        file.remarks};
  }
  if (arguments.controller.recommended()) return std::nullopt;
  if (arguments.controller.gains == "case") {
    const auto present = present_controller(antenna, arguments.controller.structure);
    return Named{design::controller_of(
        present.controller, present.controller.structure.name() + ", present gains", sample_time)};
  }
  const auto file =
      io::read_gains_file(arguments.controller.gains, antenna, arguments.controller.structure,
                          design::Fitness::misses_member);
  const bool state_space = file.controller.structure.state_space() != nullptr;
  const std::string origin = !file.tuned_for.empty() ? file.tuned_for + ","
                             : state_space           ? "matrices"
                                                     : "gains";
  return Named{design::controller_of(
      file.controller,
      fmt::format("{}, {} of {}", file.structure, origin, arguments.controller.gains),
      sample_time)};
}

Named recommended_one(const BenchmarkArguments& arguments, const io::DesignedAntenna& designed,
                      double sample_time, const std::function<bool()>& interrupted) {
  const ChosenController chosen = recommended_of(arguments, designed, interrupted);
  return {design::controller_of(
      chosen.controller, fmt::format("{}, {}", chosen.structure, chosen.source), sample_time)};
}

}  // namespace

ChosenController recommended_of(const BenchmarkArguments& arguments,
                                const io::DesignedAntenna& designed,
                                const std::function<bool()>& interrupted) {
  ProgressLine progress("tuning and verifying");
  design::TuneOptions options;
  options.seed = arguments.seed;
  options.threads = arguments.threads;
  options.progress = [&](std::size_t done, std::size_t all) { progress.show(done, all); };
  options.interrupted = interrupted;
  return recommended_controller(designed, arguments.controller.structure, options);
}

BenchmarkReport benchmark_case(const BenchmarkArguments& arguments,
                               const std::function<bool()>& interrupted) {
  const io::Case antenna = io::read_case(arguments.case_path);
  arguments.outputs.require_writable();
  if (!arguments.export_path.empty()) io::require_writable(arguments.export_path);
  const double sample_time =
      arguments.sampled ? control::sample_time_of(antenna.controller->delay.value) : 0.0;
  const auto named = named_one(arguments, antenna, sample_time);
  const std::string other =
      arguments.compare_path.empty() ? std::string() : io::read_input(arguments.compare_path);
  const io::DesignedAntenna designed =
      designed_antenna(antenna, arguments.seed, arguments.threads, interrupted);
  const Named scored =
      named ? *named : recommended_one(arguments, designed, sample_time, interrupted);
  if (!arguments.export_path.empty())
    io::write_controller(arguments.export_path, scored.controller.system);
  ProgressLine progress("scoring");
  design::BenchmarkOptions options;
  options.seed = arguments.seed;
  options.threads = arguments.threads;
  options.interrupted = interrupted;
  options.progress = [&](std::size_t done, std::size_t all) { progress.show(done, all); };
  BenchmarkReport report = benchmark(designed, scored.controller, scored.remarks, options);
  if (!arguments.compare_path.empty()) compare_with(report, other, arguments.compare_path);
  report.figures = benchmark_figures(report);
  return report;
}

namespace {

int score(const BenchmarkArguments& arguments) {
  const BenchmarkReport report = benchmark_case(arguments, interrupt_requested);
  arguments.outputs.deliver({.document = [&] { return document_of(report); },
                             .json = [&] { return to_json(report); },
                             .page = [&] { return page_of(report); }});
  if (report.interrupted) return interrupted;
  if (!report.score.stable) {
    // What is sure is no failure of the numbers: a goal, stability, that this controller misses.
    fmt::print(stderr, "boresight: {}: the closed loop is unstable, slowest pole at {:+.4g} 1/s\n",
               report.controller.description, report.score.abscissa);
    return infeasible;
  }
  return done;
}

int run(BenchmarkArguments arguments) {
  arguments.threads = all_or(arguments.threads);
  watch_for_interrupt();
  try {
    return arguments.change.asked() ? compare_change(arguments) : score(arguments);
  } catch (const Interrupted&) {
    fmt::print(stderr, "boresight: interrupted before a controller was available\n");
    return interrupted;
  }
}

}  // namespace

Subcommand add_benchmark(CLI::App& program) {
  const auto arguments = std::make_shared<BenchmarkArguments>();
  CLI::App* sub = program.add_subcommand("benchmark",
                                         "score the closed loop's disturbance rejection by a fixed "
                                         "protocol; or compare records before "
                                         "and after a change of the controller");
  add_case(*sub, arguments->case_path);
  add_controller(*sub, "controller to score", arguments->controller);
  sub->add_flag("--sampled", arguments->sampled,
                "score the gains in the sampled form that the antenna's computer runs");
  sub->add_option("--export-controller", arguments->export_path,
                  "write the controller in use as state space to FILE.mat or FILE.json");
  sub->add_option("--compare", arguments->compare_path,
                  "compare with another score sheet (--json of this command)");
  auto& change = arguments->change;
  sub->add_option("--before", change.before,
                  "records of the servo before the change, with error and wind speed: compare them "
                  "at equal wind with those of --after, instead of scoring")
      ->expected(1, 1000);
  sub->add_option("--after", change.after, "records after the change to the controller in question")
      ->expected(1, 1000);
  sub->add_option("--old-gains", change.old_gains,
                  "gains before the change, KEY=VALUE each, all of them (default: [gains])")
      ->expected(1, 100);
  sub->add_option("--old-structure", change.old_structure,
                  "structure of --old-gains (default: that of [gains], or DPF)");
  sub->add_option("--old-controller", change.old_controller,
                  "the controller before the change as state space, as --controller");
  sub->add_option("--change-record", change.record_path,
                  "write a change record of one page, to print and sign, to FILE.html");
  add_outputs(*sub, arguments->outputs);
  add_seed(*sub, arguments->seed);
  add_threads(*sub, arguments->threads);
  return {sub, [arguments] { return run(*arguments); }, &arguments->outputs};
}

}  // namespace boresight::app
