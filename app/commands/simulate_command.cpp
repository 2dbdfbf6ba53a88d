#include <algorithm>
#include <filesystem>
#include <optional>
#include <system_error>

#include <fmt/format.h>

#include <boresight/app/commands/progress_line.hpp>
#include <boresight/app/commands/simulate_command.hpp>
#include <boresight/app/redesign/sections.hpp>
#include <boresight/app/report/json_report.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/app/report/text_layout.hpp>
#include <boresight/app/report/text_report.hpp>
#include <boresight/app/simulate/position_run.hpp>
#include <boresight/plant/error.hpp>

namespace boresight::app {
namespace {

using Rows = std::vector<std::vector<std::string>>;

constexpr std::size_t progress_parts = 100;  // percent

std::string length_of(double duration, bool complete) {
  return fmt::format("{:.1f}{}", duration, complete ? "" : " (interrupted)");
}

std::vector<std::string> drive_row(const DriveRecord& record) {
  return {record.test,
          length_of(record.duration, record.complete),
          fmt::format("{:.0f}", 1.0 / record.sample_time),
          fmt::format("{:.2f}", record.largest_rate),
          fmt::format("{:.1f}", record.largest_torque),
          fmt::format("{:.1f}", record.static_friction),
          fmt::format("{:.1f} %", 100.0 * record.at_limit)};
}

std::string in_millidegrees(const std::optional<double>& angle) {
  return angle ? fmt::format("{:.3f}", *angle / millidegree) : "-";
}

std::vector<std::string> position_row(const PositionRecord& record) {
  const bool slew = record.test == "slew";
  return {record.test,
          length_of(record.duration, record.complete),
          in_millidegrees(record.beam_rms),
          in_millidegrees(record.predicted_rms),
          in_millidegrees(record.encoder_rms),
          in_millidegrees(record.beam_mean),
          record.settling_time ? fmt::format("{:.2f}", *record.settling_time)
                               : std::string(slew && record.complete ? "never" : "-"),
          in_millidegrees(record.overshoot)};
}

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
    folder_ = make_folder(arguments.folder);
    for (const auto& name : arguments.tests) {
      const auto tests = drive_tests(antenna_, name);
      if (tests.empty()) require_writable((folder_ / (name + ".csv")).string());
      for (const auto& test : tests) require_writable((folder_ / (test.name + ".csv")).string());
    }
  }

  SimulateOutcome run() {
    for (const auto& name : arguments_.tests) {
      if (!complete_) break;
      if (name == "tracking" || name == "slew") {
        run_position(name);
      } else {
        run_drive(name);
      }
    }
    return {report(), complete_};
  }

 private:
  // One line a test on a terminal.
  RunProgress progress_of(ProgressLine& line) const {
    return [this, &line](double done) {
      const auto part = static_cast<std::size_t>(done * static_cast<double>(progress_parts));
      if (part > 0) line.show(part, progress_parts);
      return !interrupted_();
    };
  }

  void keep(const std::string& name, const CsvTable& record, bool complete) {
    const auto path = (folder_ / (name + ".csv")).string();
    write_atomically(path, to_csv(record));
    written_.push_back(path);
    complete_ = complete;
  }

  void run_drive(const std::string& name) {
    for (const auto& test : drive_tests(antenna_, name)) {
      if (!complete_) return;
      ProgressLine line(test.name + ", percent");
      const auto record = run_drive_test(antenna_, test, arguments_.seed, progress_of(line));
      keep(test.name, record.record, record.complete);
      drive_rows_.push_back(drive_row(record));
      descriptions_.push_back(fmt::format("{}: {}", record.test, record.description));
    }
  }

  void run_position(const std::string& name) {
    ProgressLine line(name + ", percent");
    const auto record = name == "slew" ? run_slew(antenna_, arguments_.seed, progress_of(line))
                                       : run_tracking(antenna_, arguments_.seed, progress_of(line));
    keep(name, record.record, record.complete);
    position_rows_.push_back(position_row(record));
    descriptions_.push_back(fmt::format("{}: {}", record.test, record.description));
  }

  std::string report() const {
    std::string text =
        fmt::format("boresight simulate: {}\n{}, {} axis, seed {}\n", arguments_.case_path,
                    antenna_.title, antenna_.axis, arguments_.seed);
    text += heading("What was run");
    for (const auto& line : descriptions_) text += wrapped(line, "  ", "  ");
    if (drive_rows_.size() > 1) {
      text += heading("Tests of the drive (true values, at the motor shaft)");
      text += table(drive_rows_);
    }
    if (position_rows_.size() > 1) {
      text += heading("Position loop, tuned PI with lag, at the sky (mdeg)");
      text += table(position_rows_);
    }
    text += heading("Records");
    for (const auto& path : written_) text += "  " + path + "\n";
    if (!complete_) text += "\nInterrupted: the last record ends where the run did.\n";
    text += assumed_text(assumed_inputs(antenna_, true));
    return text;
  }

  const SimulateArguments& arguments_;
  const std::function<bool()>& interrupted_;
  Case antenna_;
  std::filesystem::path folder_;
  bool complete_ = true;
  Rows drive_rows_{{"test", "s", "samples/s", "rate rad/s", "torque N.m", "friction near rest N.m",
                    "tach at limit"}};
  Rows position_rows_{
      {"test", "s", "beam rms", "linear", "encoder rms", "beam mean", "settled s", "overshoot"}};
  std::vector<std::string> descriptions_;
  std::vector<std::string> written_;
};

}  // namespace

SimulateOutcome simulate_tests(const SimulateArguments& arguments,
                               const std::function<bool()>& interrupted) {
  return Campaign(arguments, interrupted).run();
}

}  // namespace boresight::app
