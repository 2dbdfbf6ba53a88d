#include <algorithm>
#include <exception>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <variant>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <boresight/app/commands/controller_option.hpp>
#include <boresight/app/commands/progress_line.hpp>
#include <boresight/app/commands/simulate_command.hpp>
#include <boresight/app/figures/simulation_figures.hpp>
#include <boresight/app/page/report_page.hpp>
#include <boresight/app/redesign/assumed_inputs.hpp>
#include <boresight/app/redesign/sections.hpp>
#include <boresight/app/report/json_report.hpp>
#include <boresight/app/simulate/simulated_tests.hpp>
#include <boresight/app/tune/chosen_controller.hpp>
#include <boresight/design/simulation/drive_tests.hpp>
#include <boresight/design/simulation/test_runs.hpp>
#include <boresight/io/campaign/designed_antenna.hpp>
#include <boresight/io/case/case_drive.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_simulation.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/field.hpp>
#include <boresight/io/case/tested_drive_of.hpp>
#include <boresight/io/files/output_folder.hpp>
#include <boresight/io/files/write_atomically.hpp>
#include <boresight/io/records/record_mat_writer.hpp>
#include <boresight/io/records/simulated_table.hpp>
#include <boresight/io/units/wording.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::app {
namespace {

constexpr std::size_t progress_parts = 100;  // percent

void check_tests(const std::vector<std::string>& tests) {
  const auto& known = design::simulated_test_names();
  for (const auto& test : tests) {
    if (std::ranges::find(known, test) == known.end()) {
      throw InvalidInput(fmt::format("simulate: expected tests out of {}, found {}{}",
                                     fmt::join(known, ", "), io::in_quotes(test),
                                     io::did_you_mean(test, {known.begin(), known.end()})));
    }
    if (std::ranges::count(tests, test) != 1) {
      throw InvalidInput(fmt::format("simulate: expected each test once, found '{}' again", test));
    }
  }
}

// The case as stated is what runs; with records the controller is that of the drive they show.
SimulatedController controller_of(const io::Case& antenna, const SimulateArguments& arguments,
                                  const std::function<bool()>& interrupted) {
  if (auto named = named_controller(antenna, arguments.controller)) {
    return {std::move(named->controller), std::move(named->source)};
  }
  const io::DesignedAntenna designed =
      designed_antenna(antenna, arguments.seed, arguments.threads, interrupted);
  design::TuneOptions options;
  options.seed = arguments.seed;
  options.threads = arguments.threads;
  options.interrupted = interrupted;
  auto recommended = recommended_controller(designed, arguments.controller.structure, options);
  return {std::move(recommended.controller), std::move(recommended.source)};
}

// Has the tests run, several at a time, and keeps what the report says of them in their order.
class Campaign {
 public:
  Campaign(const SimulateArguments& arguments, const std::function<bool()>& interrupted)
      : arguments_(arguments),
        interrupted_(interrupted),
        antenna_(io::read_case(arguments.case_path)),
        line_("simulating, percent") {
    check_tests(arguments.tests);
    arguments.controller.validate();
    if (arguments.sample_rate > 0.0 && antenna_.recorder) {
      antenna_.recorder->sample_rate.value = arguments.sample_rate;
    }
    folder_ = io::output_folder(arguments.folder, "records");
    report_.case_path = arguments.case_path;
    report_.title = antenna_.title;
    report_.axis = io::pointing_axis(antenna_);
    report_.seed = arguments.seed;
    arguments.outputs.require_writable();
    NonlinearInputs inputs{.time_runs = true};
    for (const auto& name : arguments.tests) add_runs(name, inputs);
    for (const auto& name : names_) io::require_writable(path_of(name.file));
    report_.assumed = assumed_inputs(antenna_, inputs);
  }

  SimulateOutcome run() {
    if (under_position_loop_) {
      try {
        controller_ = controller_of(antenna_, arguments_, interrupted_);
      } catch (const Interrupted&) {
        report_.not_run = arguments_.tests;
        report_.interrupted = true;
        return {std::move(report_), nullptr};
      }
    }
    const auto outcome =
        design::run_tests(runs_, arguments_.threads,
                          {interrupted_, [this](double fraction) { show(fraction); },
                           [this](std::size_t run, design::TestRecord record) {
                             std::visit([&](auto& made) { keep(run, made); }, record);
                           }});
    std::set<std::string> begun;
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      if (outcome.begun[i] && i <= outcome.kept) begun.insert(names_[i].asked);
    }
    for (const auto& name : arguments_.tests) {
      if (!begun.contains(name)) report_.not_run.push_back(name);
    }
    report_.interrupted = report_.interrupted || (!outcome.failure && outcome.kept < runs_.size());
    if (outcome.failure) tell_failure(outcome);
    return {std::move(report_), outcome.failure};
  }

 private:
  // Of a test that may have several records.
  struct RecordName {
    std::string asked;  // as the command line names the test
    std::string file;
  };

  // The runs of a test, and which assumed inputs they rest on.
  void add_runs(const std::string& test, NonlinearInputs& inputs) {
    const auto seed = arguments_.seed;
    const auto kind = design::drive_test_kind(test);
    if (!kind) {
      under_position_loop_ = true;
      names_.push_back({test, test});
      runs_.emplace_back([this, test, seed](const design::RunProgress& progress) {
        return run_position_test(antenna_, test, controller_.controller, seed, progress);
      });
      return;
    }
    if (!drive_) drive_ = io::tested_drive_of(antenna_);
    for (const auto& one : design::drive_tests(*drive_, *kind)) {
      // What follows the loop of the antenna's computer is written without a recorder's errors.
      inputs.recorder = true;
      inputs.rate_loop = inputs.rate_loop || one.rate_loop_closed;
      names_.push_back({test, one.name});
      runs_.emplace_back([this, one, seed](const design::RunProgress& progress) {
        return design::run_drive_test(*drive_, one, seed, progress);
      });
    }
  }

  std::string path_of(const std::string& file) const {
    return (folder_ / fmt::format("{}.{}", file, arguments_.format)).string();
  }

  // One line for all runs on a terminal.
  void show(double fraction) {
    const auto part = static_cast<std::size_t>(fraction * static_cast<double>(progress_parts));
    if (part > 0) line_.show(part, progress_parts);
  }

  void tell_failure(const design::TestRunsOutcome& outcome) {
    report_.failed_test = names_[outcome.kept].file;
    try {
      std::rethrow_exception(outcome.failure);
    } catch (const std::exception& error) {
      report_.failure = error.what();
    }
  }

  void keep(std::size_t run, design::DriveTestRecord& record) {
    auto section = section_of(std::move(record));
    report_.figures.push_back(drive_test_figure(
        section, io::supply_torque(antenna_) / antenna_.drive->supply_pressure.value));
    write(run, section);
    report_.drive.push_back(std::move(section));
  }

  void keep(std::size_t run, design::PositionTestRecord& record) {
    auto section = section_of(std::move(record), antenna_, controller_.source);
    report_.figures.push_back(position_test_figure(section));
    write(run, section);
    report_.position.push_back(std::move(section));
  }

  // The channels go to their file and are not kept.
  void write(std::size_t run, design::SimulatedRecord& record) {
    const auto path = path_of(names_[run].file);
    const auto table = io::table_of(record);
    io::write_atomically(path, arguments_.format == "mat" ? to_mat(table) : to_csv(table));
    record.channels.clear();
    report_.written.push_back(path);
    report_.interrupted = report_.interrupted || !record.complete;
  }

  const SimulateArguments& arguments_;
  const std::function<bool()>& interrupted_;
  io::Case antenna_;
  std::filesystem::path folder_;
  std::optional<design::TestedDrive> drive_;  // of tests of the drive
  bool under_position_loop_ = false;          // any of the runs
  SimulatedController controller_;            // theirs
  std::vector<RecordName> names_;             // one a run
  std::vector<design::TestRun> runs_;
  SimulationReport report_;
  ProgressLine line_;
};

}  // namespace

SimulateOutcome simulate_tests(const SimulateArguments& arguments,
                               const std::function<bool()>& interrupted) {
  return Campaign(arguments, interrupted).run();
}

namespace {

int run(SimulateArguments arguments) {
  arguments.threads = all_or(arguments.threads);
  watch_for_interrupt();
  const SimulateOutcome outcome = simulate_tests(arguments, interrupt_requested);
  arguments.outputs.deliver({.document = [&] { return document_of(outcome.report); },
                             .json = [&] { return to_json(outcome.report); },
                             .page = [&] { return page_of(outcome.report); }});
  if (outcome.failure) std::rethrow_exception(outcome.failure);
  return outcome.report.interrupted ? interrupted : done;
}

}  // namespace

Subcommand add_simulate(CLI::App& program) {
  const auto arguments = std::make_shared<SimulateArguments>();
  CLI::App* sub = program.add_subcommand(
      "simulate", "simulate tests on the nonlinear antenna and write the records of its recorder");
  add_case(*sub, arguments->case_path);
  sub->add_option("TEST", arguments->tests,
                  fmt::format("tests to run: {}", fmt::join(design::simulated_test_names(), ", ")))
      ->required();
  add_outputs(*sub, arguments->outputs);
  sub->add_option("--folder", arguments->folder, "folder for the records TEST.csv or TEST.mat")
      ->capture_default_str();
  sub->add_option(
         "--format", arguments->format,
         "record format: csv, rounded to the recorder's resolution; mat, version 5, full precision")
      ->check(CLI::IsMember({"csv", "mat"}))
      ->capture_default_str();
  add_controller(*sub, "the controller of tracking and slew", arguments->controller);
  sub->add_option(
         "--sample-rate", arguments->sample_rate,
         "sample rate of the records in Hz (default: that of the case); slosh at least 1000")
      ->check(CLI::Range(1.0, 1e5));
  add_seed(*sub, arguments->seed);
  add_threads(*sub, arguments->threads);
  return {sub, [arguments] { return run(*arguments); }, &arguments->outputs};
}

}  // namespace boresight::app
