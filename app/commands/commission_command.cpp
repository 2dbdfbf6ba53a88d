#include <exception>
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <boresight/app/commands/commission_command.hpp>
#include <boresight/app/commands/progress_line.hpp>
#include <boresight/app/page/report_page.hpp>
#include <boresight/io/campaign/designed_antenna.hpp>
#include <boresight/io/files/write_atomically.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::app {
namespace {

int run(CommissionArguments arguments) {
  arguments.options.threads = all_or(arguments.options.threads);
  arguments.outputs.require_writable();
  watch_for_interrupt();
  try {
    const CommissionReport report = commission_case(arguments, interrupt_requested);
    arguments.outputs.deliver({.document = [&] { return document_of(report); },
                               .json = [&] { return to_json(report); },
                               .page = [&] { return page_of(report); }});
    if (report.failure) std::rethrow_exception(report.failure);
  } catch (const Interrupted&) {
    // Half a plan is none.
    fmt::print(stderr, "boresight: interrupted before the plan was complete\n");
    return interrupted;
  }
  return done;
}

}  // namespace

CommissionReport commission_case(const CommissionArguments& arguments,
                                 const std::function<bool()>& interrupted) {
  CommissionOptions options = arguments.options;
  options.interrupted = interrupted;
  std::optional<ProgressLine> line;
  std::string_view working;
  options.progress = [&](std::string_view work, std::size_t done, std::size_t all) {
    if (work != working) line.emplace(std::string(work));
    working = work;
    line->show(done, all);
  };
  const io::DesignedAntenna designed = designed_antenna(io::read_case(arguments.case_path),
                                                        options.seed, options.threads, interrupted);
  return plan_commission(designed, options);
}

Subcommand add_commission(CLI::App& program) {
  const auto arguments = std::make_shared<CommissionArguments>();
  CLI::App* sub =
      program.add_subcommand("commission",
                             "plan stages from the present gains to the tuned ones, with checks "
                             "and abort limits; compare records before and after");
  auto& options = arguments->options;
  add_case(*sub, arguments->case_path);
  sub->add_option("--structure", options.structure,
                  "loop structure to commission, as for `boresight tune` (default: that of the "
                  "recommended controller)");
  sub->add_option("--gains", options.gains,
                  "its gains instead of tuned ones, KEY=VALUE each, all of them")
      ->expected(1, 100);
  sub->add_option("--largest-step", options.largest_step,
                  "largest factor on a gain from one stage to the next")
      ->check(CLI::Range(1.01, 10.0))
      ->capture_default_str();
  sub->add_option("--before", options.before, "a record of the case made before the work");
  sub->add_option("--after", options.after, "a record made after it, to compare with --before");
  sub->add_option("--starts", options.starts, "random starts of the tuning")
      ->check(CLI::Range(1, 100000));
  add_outputs(*sub, arguments->outputs);
  add_seed(*sub, options.seed);
  add_threads(*sub, options.threads);
  return {sub, [arguments] { return run(*arguments); }, &arguments->outputs};
}

}  // namespace boresight::app
