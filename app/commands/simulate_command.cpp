#include <algorithm>
#include <exception>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <system_error>
#include <type_traits>
#include <variant>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <boresight/app/commands/progress_line.hpp>
#include <boresight/app/commands/simulate_command.hpp>
#include <boresight/app/figures/simulation_figures.hpp>
#include <boresight/app/page/report_page.hpp>
#include <boresight/app/redesign/assumed_inputs.hpp>
#include <boresight/app/redesign/sections.hpp>
#include <boresight/app/report/json_report.hpp>
#include <boresight/app/simulate/antenna_tests.hpp>
#include <boresight/app/tune/chosen_controller.hpp>
#include <boresight/app/tune/structure_option.hpp>
#include <boresight/io/campaign/designed_antenna.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/field.hpp>
#include <boresight/io/files/write_atomically.hpp>
#include <boresight/io/records/record_mat_writer.hpp>
#include <boresight/io/units/wording.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/parallel_loop.hpp>

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
  if (auto named = named_controller(antenna, arguments.gains, arguments.structure)) {
    return {std::move(named->law), std::move(named->source)};
  }
  const io::DesignedAntenna designed =
      designed_antenna(antenna, arguments.seed, arguments.threads, interrupted);
  design::TuneOptions options;
  if (!arguments.structure.empty()) {
    options.structures = structure_option(designed.antenna, {arguments.structure});
  }
  options.seed = arguments.seed;
  options.threads = arguments.threads;
  options.interrupted = interrupted;
  auto recommended = recommended_controller(designed, options);
  return {std::move(recommended.law), std::move(recommended.source)};
}

using Record = std::variant<DriveRecord, PositionRecord>;

// One record to make: of a test that may have several.
struct Run {
  std::string asked;  // as the command line names it
  std::string name;   // of the file
  std::function<Record(const RunProgress&)> make;
};

// What became of it.
struct RunState {
  std::optional<Record> record;
  std::exception_ptr failure;
  double done = 0.0;  // share
  bool begun = false;
  bool over = false;
};

// Runs the tests, several at a time, and keeps what the report says of them in their order.
class Campaign {
 public:
  Campaign(const SimulateArguments& arguments, const std::function<bool()>& interrupted)
      : arguments_(arguments),
        interrupted_(interrupted),
        antenna_(io::read_case(arguments.case_path)),
        line_("simulating, percent") {
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
    for (const auto& name : arguments.tests) add_runs(name, inputs);
    for (const auto& run : runs_) io::require_writable(path_of(run));
    states_.resize(runs_.size());
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
    // An error of the loop itself, such as of a full disk, is the failure of nobody's test.
    numerics::for_each_index(runs_.size(), arguments_.threads,
                             [this](std::size_t i) { run_one(i); });
    std::set<std::string> begun;
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      if (states_[i].begun && i <= kept_) begun.insert(runs_[i].asked);
    }
    for (const auto& name : arguments_.tests) {
      if (!begun.contains(name)) report_.not_run.push_back(name);
    }
    report_.interrupted = report_.interrupted || (!failure_ && kept_ < runs_.size());
    return {std::move(report_), failure_};
  }

 private:
  // The runs of a test, and which assumed inputs they rest on.
  void add_runs(const std::string& name, NonlinearInputs& inputs) {
    const auto seed = arguments_.seed;
    if (name == "tracking" || name == "slew") {
      const auto make = name == "slew" ? run_slew : run_tracking;
      under_position_loop_ = true;
      runs_.push_back({name, name, [this, make, seed](const RunProgress& progress) -> Record {
                         return make(antenna_, controller_, seed, progress);
                       }});
      return;
    }
    for (const auto& test : drive_tests(antenna_, name)) {
      // What follows the loop of the antenna's computer is written without a recorder's errors.
      inputs.recorder = true;
      inputs.rate_loop = inputs.rate_loop || test.rate_loop_closed;
      runs_.push_back({name, test.name, [this, test, seed](const RunProgress& progress) -> Record {
                         return run_drive_test(antenna_, test, seed, progress);
                       }});
    }
  }

  std::string path_of(const Run& run) const {
    return (folder_ / fmt::format("{}.{}", run.name, arguments_.format)).string();
  }

  void run_one(std::size_t i) {
    {
      const std::lock_guard lock(mutex_);
      if (failure_ || interrupted_()) return;
      states_[i].begun = true;
    }
    std::optional<Record> record;
    std::exception_ptr failure;
    try {
      record = runs_[i].make([this, i](double done) { return goes_on(i, done); });
    } catch (const std::exception&) {
      failure = std::current_exception();
    }
    const std::lock_guard lock(mutex_);
    states_[i].record = std::move(record);
    states_[i].failure = failure;
    states_[i].over = true;
    while (kept_ < runs_.size() && states_[kept_].over && !failure_) keep_next();
  }

  // One line for all on a terminal. A run ends early on request, and where one before it failed.
  bool goes_on(std::size_t i, double done) {
    const std::lock_guard lock(mutex_);
    states_[i].done = done;
    double sum = 0.0;
    for (const auto& state : states_) sum += state.over ? 1.0 : state.done;
    const auto part = static_cast<std::size_t>(sum / static_cast<double>(states_.size()) *
                                               static_cast<double>(progress_parts));
    if (part > 0) line_.show(part, progress_parts);
    return !failure_ && !interrupted_();
  }

  // The record goes to its file, the rest into the report. After a failure the records before it
  // are the user's all the same, and those behind it are left out, as if run one by one.
  void keep_next() {
    const Run& run = runs_[kept_];
    RunState& state = states_[kept_];
    if (!state.failure && state.record) {
      try {
        std::visit([&](auto& record) { keep(run, record); }, *state.record);
        ++kept_;
        return;
      } catch (const std::exception&) {
        state.failure = std::current_exception();
      }
    }
    failure_ = state.failure;
    report_.failed_test = run.name;
    try {
      std::rethrow_exception(failure_);
    } catch (const std::exception& error) {
      report_.failure = error.what();
    }
  }

  template <typename MadeRecord>
  void keep(const Run& run, MadeRecord& record) {
    const auto path = path_of(run);
    if constexpr (std::is_same_v<MadeRecord, DriveRecord>) {
      report_.figures.push_back(drive_test_figure(
          record, io::supply_torque(antenna_) / antenna_.drive.supply_pressure.value));
    } else {
      report_.figures.push_back(position_test_figure(record));
    }
    io::write_atomically(
        path, arguments_.format == "mat" ? to_mat(record.record) : to_csv(record.record));
    record.record = {};
    report_.written.push_back(path);
    report_.interrupted = report_.interrupted || !record.complete;
    if constexpr (std::is_same_v<MadeRecord, DriveRecord>) {
      report_.drive.push_back(std::move(record));
    } else {
      report_.position.push_back(std::move(record));
    }
  }

  const SimulateArguments& arguments_;
  const std::function<bool()>& interrupted_;
  io::Case antenna_;
  std::filesystem::path folder_;
  bool under_position_loop_ = false;  // any of the runs
  SimulatedController controller_;    // theirs
  std::vector<Run> runs_;
  std::mutex mutex_;  // of all below
  std::vector<RunState> states_;
  std::size_t kept_ = 0;  // so many of the first are in the report
  std::exception_ptr failure_;
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
  sub->add_option("--gains", arguments->gains,
                  "the controller of tracking and slew: 'tuned' (the one that `boresight tune` "
                  "recommends, tuned now), 'case' (what the antenna runs on now), or a report of "
                  "tune or redesign in JSON")
      ->capture_default_str();
  sub->add_option("--structure", arguments->structure,
                  "its structure, as `boresight tune` takes it (default: any)");
  sub->add_option("--sample-rate", arguments->sample_rate,
                  "samples a second of the records (default: as the case has it); slosh is sampled "
                  "at 1000 or more")
      ->check(CLI::Range(1.0, 1e5));
  add_seed(*sub, arguments->seed);
  add_threads(*sub, arguments->threads);
  return {sub, [arguments] { return run(*arguments); }, &arguments->outputs};
}

}  // namespace boresight::app
