#include <exception>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <boresight/app/commands/commission_command.hpp>
#include <boresight/app/commands/progress_line.hpp>
#include <boresight/app/commission/commission_sheets.hpp>
#include <boresight/app/figures/figure_csv.hpp>
#include <boresight/app/page/report_page.hpp>
#include <boresight/io/campaign/designed_antenna.hpp>
#include <boresight/io/files/input_files.hpp>
#include <boresight/io/files/output_folder.hpp>
#include <boresight/io/files/write_atomically.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::app {
namespace {

// Of an earlier plan, which may have had more stages: a controller of it must not be loaded.
void remove_earlier(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> earlier;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    const bool controller = name.starts_with("stage_") &&
                            (name.ends_with("_gains.toml") || name.ends_with("_state_space.json"));
    const bool bode = name.starts_with("commission-bode-") && name.ends_with(".csv");
    if (controller || bode) earlier.push_back(entry.path());
  }
  for (const auto& path : earlier) std::filesystem::remove(path);
}

void write_sheets(const CommissionReport& report, const CommissionArguments& arguments) {
  const std::filesystem::path folder = arguments.folder;
  remove_earlier(folder);
  for (const auto& file : commission_files(report)) {
    io::write_atomically((folder / file.name).string(), file.content);
  }
  const Page page = commission_sheets(report);
  write_curves(page.figures, arguments.folder);
  io::write_atomically((folder / "sheets.html").string(),
                       to_html(page, {arguments.outputs.command_line, io::inputs_read()}));
}

int run(CommissionArguments arguments) {
  arguments.options.threads = all_or(arguments.options.threads);
  arguments.outputs.require_writable();
  if (!arguments.folder.empty()) {
    io::require_writable((io::output_folder(arguments.folder, "sheets") / "sheets.html").string());
  }
  watch_for_interrupt();
  try {
    const CommissionReport report = commission_case(arguments, interrupt_requested);
    arguments.outputs.deliver({.document = [&] { return document_of(report); },
                               .json = [&] { return to_json(report); },
                               .page = [&] { return page_of(report); }});
    if (report.failure) std::rethrow_exception(report.failure);
    if (!arguments.folder.empty()) write_sheets(report, arguments);
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
                  "its gains instead of tuned ones, KEY=VALUE each, all of them; or a file with "
                  "them: [gains] in TOML, or a report in JSON")
      ->expected(1, 100);
  sub->add_option("--controller", options.controller_path,
                  "a state space to commission, from a MAT or JSON file")
      ->excludes("--gains")
      ->excludes("--structure");
  sub->add_option("--largest-step", options.largest_step,
                  "largest factor on a gain from one stage to the next")
      ->check(CLI::Range(1.01, 10.0))
      ->capture_default_str();
  sub->add_option("--folder", arguments->folder,
                  "folder for sheets to fill in and sign (sheets.html, sheets.csv), the expected "
                  "Bode plots and the controller of every stage");
  sub->add_option("--plants", options.plants,
                  "also try every stage on this many fresh plants of the uncertainty set")
      ->check(CLI::Range(1, 1000000));
  sub->add_option(
         "--record", options.records,
         "STAGE FILE: evaluate a record of a stage that is done, and update the uncertainty "
         "set by it; may be repeated")
      ->type_name("STAGE FILE");
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
