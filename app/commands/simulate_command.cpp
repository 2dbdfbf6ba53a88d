#include <algorithm>
#include <exception>
#include <filesystem>
#include <memory>
#include <system_error>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <boresight/app/commands/progress_line.hpp>
#include <boresight/app/commands/simulate_command.hpp>
#include <boresight/app/figures/simulation_figures.hpp>
#include <boresight/app/io/record_mat_writer.hpp>
#include <boresight/app/page/report_page.hpp>
#include <boresight/app/redesign/antenna_model.hpp>
#include <boresight/app/redesign/assumed_inputs.hpp>
#include <boresight/app/redesign/sections.hpp>
#include <boresight/app/report/json_report.hpp>
#include <boresight/app/simulate/antenna_tests.hpp>
#include <boresight/plant/error.hpp>

namespace boresight::app {
namespace {

constexpr std::size_t progress_parts = 100;  // percent

std::filesystem::path make_folder(const std::string& folder) {
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (!std::filesystem::is_directory(folder)) {
    throw InvalidInput(fmt::format("{}: expected a folder to write records to, found none{}",
                                   folder, failure ? " (" + failure.message() + ")" : ""));
  }
  return folder;
}

void check_tests(const std::vector<std::string>& tests) {
  const auto& known = simulated_test_names();
  for (const auto& test : tests) {
    if (std::ranges::find(known, test) == known.end()) {
      throw InvalidInput(fmt::format("simulate: expected tests out of {}, found '{}'",
                                     fmt::join(known, ", "), test));
    }
    if (std::ranges::count(tests, test) != 1) {
      throw InvalidInput(fmt::format("simulate: expected each test once, found '{}' again", test));
    }
  }
}

// Runs the tests one by one and keeps what the report says of them.
class Campaign {
 public:
  Campaign(const SimulateArguments& arguments, const std::function<bool()>& interrupted)
      : arguments_(arguments), interrupted_(interrupted), antenna_(read_case(arguments.case_path)) {
    check_tests(arguments.tests);
    if (arguments.sample_rate > 0.0 && antenna_.recorder) {
      antenna_.recorder->sample_rate.value = arguments.sample_rate;
    }
    folder_ = make_folder(arguments.folder);
    report_.case_path = arguments.case_path;
    report_.title = antenna_.title;
    report_.axis = antenna_.axis;
    report_.seed = arguments.seed;
    arguments.outputs.require_writable();
    NonlinearInputs inputs{.time_runs = true};
    for (const auto& name : arguments.tests) {
      const auto tests = drive_tests(antenna_, name);
      // What follows the loop of the antenna's computer is written without a recorder's errors.
      inputs.recorder = inputs.recorder || !tests.empty();
      inputs.rate_loop =
          inputs.rate_loop || std::ranges::any_of(tests, &AntennaTest::rate_loop_closed);
      if (tests.empty()) require_writable(path_of(name));
      for (const auto& test : tests) require_writable(path_of(test.name));
    }
    report_.assumed = assumed_inputs(antenna_, inputs);
  }

  SimulateOutcome run() {
    SimulateOutcome outcome;
    std::size_t next = 0;
    try {
      while (next < arguments_.tests.size() && !report_.interrupted) {
        const auto& name = arguments_.tests[next++];
        report_.failed_test = name;
        if (name == "tracking" || name == "slew") {
          run_position(name);
        } else {
          run_drive(name);
        }
      }
      report_.failed_test.clear();
    } catch (const std::exception& error) {
      // What was done before is the user's all the same.
      report_.failure = error.what();
      outcome.failure = std::current_exception();
    }
    for (; next < arguments_.tests.size(); ++next) {
      report_.not_run.push_back(arguments_.tests[next]);
    }
    outcome.report = std::move(report_);
    return outcome;
  }

 private:
  std::string path_of(const std::string& test) const {
    return (folder_ / fmt::format("{}.{}", test, arguments_.format)).string();
  }

  // One line a test on a terminal.
  RunProgress progress_of(ProgressLine& line) const {
    return [this, &line](double done) {
      const auto part = static_cast<std::size_t>(done * static_cast<double>(progress_parts));
      if (part > 0) line.show(part, progress_parts);
      return !interrupted_();
    };
  }

  // The record goes to its file, the rest into the report.
  void keep(const std::string& name, CsvTable& record, bool complete) {
    const auto path = path_of(name);
    write_atomically(path, arguments_.format == "mat" ? to_mat(record) : to_csv(record));
    record = {};
    report_.written.push_back(path);
    report_.interrupted = !complete;
  }

  void run_drive(const std::string& name) {
    for (const auto& test : drive_tests(antenna_, name)) {
      if (report_.interrupted) return;
      report_.failed_test = test.name;
      ProgressLine line(test.name + ", percent");
      auto record = run_drive_test(antenna_, test, arguments_.seed, progress_of(line));
      report_.figures.push_back(drive_test_figure(
          record, supply_torque(antenna_) / antenna_.drive.supply_pressure.value));
      keep(test.name, record.record, record.complete);
      report_.drive.push_back(std::move(record));
    }
  }

  void run_position(const std::string& name) {
    ProgressLine line(name + ", percent");
    auto record = name == "slew" ? run_slew(antenna_, arguments_.seed, progress_of(line))
                                 : run_tracking(antenna_, arguments_.seed, progress_of(line));
    report_.figures.push_back(position_test_figure(record));
    keep(name, record.record, record.complete);
    report_.position.push_back(std::move(record));
  }

  const SimulateArguments& arguments_;
  const std::function<bool()>& interrupted_;
  Case antenna_;
  std::filesystem::path folder_;
  SimulationReport report_;
};

}  // namespace

SimulateOutcome simulate_tests(const SimulateArguments& arguments,
                               const std::function<bool()>& interrupted) {
  return Campaign(arguments, interrupted).run();
}

namespace {

int run(const SimulateArguments& arguments) {
  watch_for_interrupt();
  const auto outcome = simulate_tests(arguments, interrupt_requested);
  arguments.outputs.deliver({.text = [&] { return to_text(outcome.report); },
                             .json = [&] { return to_json(outcome.report); },
                             .page = [&] { return page_of(outcome.report); }});
  if (outcome.failure) std::rethrow_exception(outcome.failure);
  return outcome.report.interrupted ? interrupted : done;
}

}  // namespace

Subcommand add_simulate(CLI::App& program) {
  const auto arguments = std::make_shared<SimulateArguments>();
  CLI::App* sub = program.add_subcommand(
      "simulate", "run tests on the nonlinear antenna and write what its recorder would");
  add_case(*sub, arguments->case_path);
  sub->add_option("TEST", arguments->tests,
                  fmt::format("what to run: {}", fmt::join(simulated_test_names(), ", ")))
      ->required();
  add_outputs(*sub, arguments->outputs);
  sub->add_option("--folder", arguments->folder, "where records TEST.csv or TEST.mat are written")
      ->capture_default_str();
  sub->add_option("--format", arguments->format,
                  "of the records: csv, rounded as a recorder's digits; mat, version 5, every bit")
      ->check(CLI::IsMember({"csv", "mat"}))
      ->capture_default_str();
  sub->add_option("--sample-rate", arguments->sample_rate,
                  "samples a second of the records (default: as the case has it); slosh is sampled "
                  "at 1000 or more")
      ->check(CLI::Range(1.0, 1e5));
  add_seed(*sub, arguments->seed);
  return {sub, [arguments] { return run(*arguments); }, &arguments->outputs};
}

}  // namespace boresight::app
