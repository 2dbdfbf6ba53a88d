#include <string_view>

#include <fmt/format.h>

#include <boresight/io/case/antenna_of.hpp>
#include <boresight/io/case/case_campaign.hpp>
#include <boresight/io/case/case_drive.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_simulation.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/tested_drive_of.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/nonlinear/nonlinear_drive.hpp>

namespace boresight::io {
namespace {

// What is recorded; a run of the position loop is not.
constexpr const char* recorded_only = "; tracking and slew need none";

[[noreturn]] void refuse_missing(const Case& stated, const char* table, const char* purpose) {
  throw InvalidInput(fmt::format(
      "{}: expected a table [{}] with {}, found none (see docs/case-file.md{})", stated.path, table,
      purpose, std::string_view(table) == "simulation" ? "" : recorded_only));
}

plant::TachometerRecording tachometer_of(const Case& stated, const RecorderEntry& recorder) {
  const auto& tachometer = stated.campaign->tachometer;
  if (!tachometer) {
    refuse_missing(stated, "tachometer", "the scale the recorder writes motor rates in");
  }
  const auto& limit = tachometer->recorder_limit;
  if (!motor_rate_per_volt(stated)) {
    throw InvalidInput(
        fmt::format("{}: expected tachometer.voltage and tachometer.shaft_speed, for a simulated "
                    "recorder writes volts, found neither{}",
                    stated.path, recorded_only));
  }
  if (!limit) {
    throw InvalidInput(fmt::format(
        "{}: expected tachometer.recorder_limit, which the tests' amplitudes go by, found none{}",
        stated.path, recorded_only));
  }
  return {*motor_rate_per_volt(stated), limit->value, recorder.tachometer_gain.value,
          recorder.tachometer_noise.value, recorder.tachometer_resolution.value};
}

}  // namespace

void require_simulation(const Case& stated) {
  if (!stated.simulation) {
    refuse_missing(stated, "simulation", "what the linear plant leaves out of the drive");
  }
}

std::optional<double> motor_rate_per_volt(const Case& stated) {
  if (!stated.campaign->tachometer) return std::nullopt;
  const RecordedTachometerEntry& entry = *stated.campaign->tachometer;
  if (!entry.voltage || !entry.shaft_speed) return std::nullopt;
  double turns = 1.0;  // of the motor, one of the shaft
  if (entry.motor_teeth && entry.tachometer_teeth) {
    turns = entry.motor_teeth->value / entry.tachometer_teeth->value;
  }
  if (entry.shaft == "antenna") turns = gear_ratio(stated);
  // Eq. 32 of Sommerville.
  return entry.shaft_speed->value * turns / entry.voltage->value;
}

plant::NonlinearAntenna make_nonlinear_antenna(const Case& stated) {
  require_simulation(stated);
  return plant::nonlinear_antenna(antenna_of(stated));
}

plant::Recorder recorder_of(const Case& stated) {
  if (!stated.recorder) refuse_missing(stated, "recorder", "how records are written");
  const RecorderEntry& entry = *stated.recorder;
  plant::Recorder recorder;
  recorder.sample_rate = entry.sample_rate.value;
  recorder.low_pass = {static_cast<int>(entry.filter_order),
                       entry.filter_frequency ? entry.filter_frequency->value : 0.0};
  recorder.pressure = {entry.pressure_gain.value, entry.pressure_zero.value,
                       entry.pressure_noise.value, entry.pressure_resolution.value,
                       entry.pressure_range.value};
  recorder.tachometer = tachometer_of(stated, entry);
  return recorder;
}

design::TestedDrive tested_drive_of(const Case& stated) {
  design::TestedDrive drive;
  drive.antenna = make_nonlinear_antenna(stated);
  if (drive.antenna.oil.lines.empty()) {
    throw InvalidInput(
        fmt::format("{}: expected an [[oil.line]] with its length, whose ends the recorder's "
                    "transducers sit at, found none{}",
                    stated.path, recorded_only));
  }
  const SimulationEntry& entry = *stated.simulation;
  drive.rate_loop = {entry.rate_loop_gain.value, entry.rate_loop_corner.value};
  drive.slew_rate = stated.drive->slew_rate.value * gear_ratio(stated);
  drive.recorder = recorder_of(stated);
  return drive;
}

}  // namespace boresight::io
