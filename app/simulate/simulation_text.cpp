#include <fmt/format.h>

#include <boresight/app/document/document_text.hpp>
#include <boresight/app/report/axis_wording.hpp>
#include <boresight/app/report/decision.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/app/report/text_report.hpp>
#include <boresight/app/simulate/simulation_report.hpp>

namespace boresight::app {
namespace {

using Rows = std::vector<std::vector<std::string>>;

std::string length_of(double duration, bool complete) {
  return fmt::format("{:.1f}{}", duration, complete ? "" : " (interrupted)");
}

std::string in_millidegrees(const std::optional<double>& angle) {
  return angle ? fmt::format("{:.3f}", *angle / millidegree) : "-";
}

Document drive_part(const SimulationReport& report) {
  if (report.drive.empty()) return {};
  Rows rows{{"test", "s", "samples/s", "rate rad/s", "torque N.m", "friction near rest N.m",
             "tach at limit"}};
  for (const auto& record : report.drive) {
    rows.push_back({record.test, length_of(record.duration, record.complete),
                    fmt::format("{:.0f}", 1.0 / record.sample_time),
                    fmt::format("{:.2f}", record.largest_rate),
                    fmt::format("{:.1f}", record.largest_torque),
                    fmt::format("{:.1f}", record.static_friction),
                    fmt::format("{:.1f} %", 100.0 * record.at_limit)});
  }
  return heading("Tests of the drive (true values, at the motor shaft)") + table(rows);
}

// Seconds after the end of the slew's command.
std::string settling_text(const PositionTestSection& record) {
  if (record.settling_time) {
    return *record.settling_time > 0.0 ? fmt::format("{:.2f}", *record.settling_time) : "at once";
  }
  return record.test == "slew" && record.complete ? "never" : "-";
}

Document position_part(const SimulationReport& report) {
  if (report.position.empty()) return {};
  Rows rows{{"test", "s", "boresight rms", "linear", "encoder rms", "boresight mean", "settled s",
             "overshoot"}};
  for (const auto& record : report.position) {
    rows.push_back({record.test, length_of(record.duration, record.complete),
                    in_millidegrees(record.boresight_rms), in_millidegrees(record.predicted_rms),
                    in_millidegrees(record.encoder_rms), in_millidegrees(record.boresight_mean),
                    settling_text(record), in_millidegrees(record.overshoot)});
  }
  return heading("Position loop, at the sky (mdeg)") + table(rows);
}

// Friction where the motor first leaves standstill, either way.
Document breakaway_part(const SimulationReport& report) {
  Rows rows{{"test", "starts", "up at s", "rad/s", "friction N.m", "torque N.m", "down at s",
             "rad/s", "friction N.m", "torque N.m", "curve N.m"}};
  for (const auto& record : report.drive) {
    if (!first_start(record.events, true) && !first_start(record.events, false)) continue;
    std::vector<std::string> row{record.test,
                                 fmt::format("{}", record.events.sliding_starts.size())};
    for (const bool upward : {true, false}) {
      const auto start = first_start(record.events, upward);
      row.push_back(start ? fmt::format("{:.2f}", start->time) : "-");
      row.push_back(start ? fmt::format("{:.3f}", start->rate) : "-");
      row.push_back(start ? fmt::format("{:.2f}", start->friction) : "-");
      row.push_back(start ? fmt::format("{:.2f}", start->motor_torque) : "-");
    }
    row.push_back(fmt::format("{:.2f}", record.curve_breakaway));
    rows.push_back(std::move(row));
  }
  if (rows.size() == 1) return {};
  return heading("Breakaway: first slow start of sliding in each direction") + table(rows) +
         wrapped(
             "At the end of presliding: motor rate, friction without gravity offset, and motor "
             "torque from the pressures, offset and inertia included. Curve: breakaway torque of "
             "the case's friction curve, which friction exceeds where it rises with rate.",
             "  ");
}

std::string fraction_of(const plant::SampledEvent& event) {
  if (event.samples == 0) return "-";
  return fmt::format("{:.3g} % from {:.3f}", 100.0 * event.fraction, event.first.value_or(0.0));
}

void add_limits(Rows& rows, const std::string& test, const plant::RunEvents& events) {
  rows.push_back({test, fraction_of(events.command_limit), fraction_of(events.stroke_limit),
                  fraction_of(events.slew_limit),
                  events.contact_losses == 0 ? "-"
                                             : fmt::format("{}, {}", events.contact_losses,
                                                           fraction_of(events.contact_lost)),
                  fraction_of(events.below_makeup), fraction_of(events.below_zero)});
}

Document limits_part(const SimulationReport& report) {
  Rows rows{
      {"test", "command", "port open", "spool speed", "backlash open", "below make-up", "below 0"}};
  for (const auto& record : report.drive) add_limits(rows, record.test, record.events);
  for (const auto& record : report.position) add_limits(rows, record.test, record.events);
  if (rows.size() == 1) return {};
  Document text = heading("Limits reached: fraction of samples, and time of the first in s") +
                  table(rows, "lllllll");
  for (const auto& record : report.drive) {
    for (const auto& channel : record.clipped) {
      text += wrapped(fmt::format("{}: the recorder clips {} in {} samples, first at {:.3f} s.",
                                  record.test, channel.name, channel.samples, channel.first),
                      "  ", "  ");
    }
  }
  return text;
}

// What ran, what it showed, which records there are and which are missing.
Document runs_part(const SimulationReport& report) {
  Document text = heading("What was run");
  for (const auto& record : report.drive) {
    text += wrapped(fmt::format("{}: {}", record.test, record.description), "  ", "  ");
  }
  for (const auto& record : report.position) {
    text += wrapped(fmt::format("{}: {}", record.test, record.description), "  ", "  ");
  }
  if (report.drive.empty() && report.position.empty()) text += "  no test was completed\n";
  text += drive_part(report) + position_part(report) + breakaway_part(report) + limits_part(report);
  text += heading("Records");
  if (report.written.empty()) text += "  none\n";
  for (const auto& path : report.written) text += "  " + path + "\n";
  if (report.interrupted) text += "\nInterrupted: the last record ends where the run did.\n";
  if (!report.failure.empty()) {
    text += "\n" + wrapped(fmt::format("FAILED in {}: {}", report.failed_test, report.failure), "");
  }
  if (!report.not_run.empty()) {
    text += wrapped(fmt::format("Not run: {}.", fmt::join(report.not_run, ", ")), "");
  }
  return text;
}

}  // namespace

Document document_of(const SimulationReport& report) {
  Document text = report_title("simulate", report.title, words_beside(report.title, report.axis),
                               report.case_path, report.seed);
  text += lead(decision(report));
  return text + essential(runs_part(report)) + document_of(report.assumed);
}

std::string to_text(const SimulationReport& report) {
  return to_text(document_of(report));
}

}  // namespace boresight::app
