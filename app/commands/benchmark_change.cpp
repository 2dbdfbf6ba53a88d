#include <algorithm>

#include <fmt/format.h>

#include <boresight/app/commands/benchmark_change.hpp>
#include <boresight/app/page/report_page.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/present_gains.hpp>
#include <boresight/io/exchange/gains_by_key.hpp>
#include <boresight/io/files/write_atomically.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::app {
namespace {

void validate(const BenchmarkArguments& arguments) {
  const ChangeArguments& change = arguments.change;
  if (change.before.empty() || change.after.empty()) {
    throw InvalidInput(
        fmt::format("benchmark: expected files for both --before and --after, found none for --{}",
                    change.before.empty() ? "before" : "after"));
  }
  if (!change.old_gains.empty() && !change.old_controller.empty()) {
    throw InvalidInput("expected either --old-gains or --old-controller, found both");
  }
  if (!change.old_structure.empty() && change.old_gains.empty()) {
    throw InvalidInput("--old-structure: expected --old-gains as well, found none");
  }
  const auto refuse = [](bool given, const char* option) {
    if (!given) return;
    throw InvalidInput(
        fmt::format("{}: expected without --before and --after, found with them", option));
  };
  refuse(arguments.sampled, "--sampled");
  refuse(!arguments.compare_path.empty(), "--compare");
  refuse(!arguments.export_path.empty(), "--export-controller");
}

std::vector<ReadServoRecord> read_all(const io::Case& antenna,
                                      const std::vector<std::string>& paths) {
  std::vector<ReadServoRecord> result;
  for (const auto& path : paths) {
    ReadServoRecord one;
    one.record = io::read_servo_record(antenna, path, one.notes);
    result.push_back(std::move(one));
  }
  return result;
}

std::optional<ChosenController> old_controller(const ChangeArguments& change,
                                               const io::Case& antenna) {
  if (!change.old_controller.empty()) {
    return named_controller(
        antenna,
        {.gains = "tuned", .structure = {}, .controller_path = change.old_controller, .names = {}});
  }
  const auto present = io::present_controllers(antenna);
  if (!change.old_gains.empty()) {
    std::string structure = change.old_structure;
    if (structure.empty()) structure = present.empty() ? "DPF" : present.front().name;
    return ChosenController{io::controller_by_key(antenna, structure, change.old_gains), structure,
                            "of --old-gains"};
  }
  if (present.empty()) return std::nullopt;
  return ChosenController{present.front().controller, present.front().name,
                          "the antenna's present gains, from the case"};
}

}  // namespace

ChangeReport change_of_case(const BenchmarkArguments& arguments,
                            const std::function<bool()>& interrupted) {
  validate(arguments);
  const ChangeArguments& change = arguments.change;
  const io::Case antenna = io::read_case(arguments.case_path);
  arguments.outputs.require_writable();
  if (!change.record_path.empty()) io::require_writable(change.record_path);
  const auto before = read_all(antenna, change.before);
  const auto after = read_all(antenna, change.after);
  const auto old = old_controller(change, antenna);
  const auto named = named_controller(antenna, arguments.controller);
  const io::DesignedAntenna designed =
      designed_antenna(antenna, arguments.seed, arguments.threads, interrupted);
  const ChosenController chosen = named ? *named : recommended_of(arguments, designed, interrupted);
  return report_change(designed, before, after, old, chosen, arguments.seed,
                       {.reference_speed = {}, .threads = arguments.threads});
}

int compare_change(const BenchmarkArguments& arguments) {
  const ChangeReport report = change_of_case(arguments, interrupt_requested);
  arguments.outputs.deliver({.document = [&] { return document_of(report); },
                             .json = [&] { return to_json(report); },
                             .page = [&] { return page_of(report); }});
  if (!arguments.change.record_path.empty()) {
    io::write_atomically(arguments.change.record_path, change_record(report));
  }
  const bool failed = std::ranges::any_of(
      report.checks, [](const design::ChangeCheck& check) { return check.passed == false; });
  return failed ? infeasible : done;
}

}  // namespace boresight::app
