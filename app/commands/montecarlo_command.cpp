#include <exception>
#include <memory>

#include <CLI/CLI.hpp>

#include <boresight/app/commands/controller_option.hpp>
#include <boresight/app/commands/montecarlo_command.hpp>
#include <boresight/app/montecarlo/montecarlo_study.hpp>
#include <boresight/app/page/report_page.hpp>
#include <boresight/app/report/json_report.hpp>
#include <boresight/io/files/write_atomically.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::app {
namespace {

int run(MonteCarloArguments arguments) {
  Ranks ranks;
  arguments.threads = all_or(arguments.threads);
  watch_for_interrupt();
  if (!ranks.first()) {
    // Rank 0 has the same error, and says so.
    try {
      run_montecarlo(arguments, ranks, interrupt_requested);
    } catch (const std::exception&) {
      return done;
    }
    return done;
  }
  const MonteCarloOutcome outcome = run_montecarlo(arguments, ranks, interrupt_requested);
  if (!arguments.csv_path.empty()) io::write_atomically(arguments.csv_path, to_csv(outcome));
  arguments.outputs.deliver({.document = [&] { return document_of(outcome.section); },
                             .json = [&] { return to_json(outcome.section); },
                             .page = [&] { return page_of(outcome.section); }});
  return outcome.section.interrupted ? interrupted : done;
}

}  // namespace

Subcommand add_montecarlo(CLI::App& program) {
  const auto arguments = std::make_shared<MonteCarloArguments>();
  CLI::App* sub = program.add_subcommand(
      "montecarlo", "evaluate one controller with fixed gains on thousands of sampled plants");
  add_case(*sub, arguments->case_path);
  sub->add_option("--plants", arguments->plants, "number of sampled plants")
      ->check(CLI::Range(1.0, 1e8))
      ->capture_default_str();
  add_controller(*sub, "the controller", arguments->controller);
  sub->add_flag("--retune", arguments->retune,
                "also tune plant-specific gains, for the cost of fixed gains");
  sub->add_option("--csv", arguments->csv_path, "write every plant to this file");
  sub->add_option("--checkpoint", arguments->checkpoint_path,
                  "resume from this file if it exists, and save to it every few seconds");
  add_outputs(*sub, arguments->outputs);
  add_seed(*sub, arguments->seed);
  add_threads(*sub, arguments->threads);
  return {sub, [arguments] { return run(*arguments); }, &arguments->outputs};
}

}  // namespace boresight::app
