#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include <boresight/app/redesign/antenna_model.hpp>
#include <boresight/app/simulate/nonlinear_model.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/normal_numbers.hpp>

namespace boresight::app {
namespace {

// What is recorded; a run of the position loop is not.
constexpr const char* recorded_only = "; tracking and slew need none";

[[noreturn]] void refuse_missing(const io::Case& antenna, const char* table, const char* purpose) {
  throw InvalidInput(fmt::format(
      "{}: expected a table [{}] with {}, found none (see docs/case-file.md{})", antenna.path,
      table, purpose, std::string_view(table) == "simulation" ? "" : recorded_only));
}

std::vector<double> line_lengths(const io::Case& antenna) {
  std::vector<double> given;
  for (const auto& line : antenna.campaign.lines) given.push_back(line.length.value);
  if (given.empty()) return {};
  const auto motors = static_cast<std::size_t>(antenna.motor.count);
  std::ranges::sort(given);
  if (given.size() >= motors) return {given.begin(), given.begin() + antenna.motor.count};
  if (motors == 1) return {given.front()};
  std::vector<double> lengths;
  for (std::size_t i = 0; i < motors; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(motors - 1);
    lengths.push_back(given.front() + share * (given.back() - given.front()));
  }
  return lengths;
}

}  // namespace

const io::SimulationEntry& simulation_of(const io::Case& antenna) {
  if (!antenna.simulation) {
    refuse_missing(antenna, "simulation", "what the linear plant leaves out of the drive");
  }
  return *antenna.simulation;
}

const io::RecorderEntry& recorder_of(const io::Case& antenna) {
  if (!antenna.recorder) refuse_missing(antenna, "recorder", "how records are written");
  return *antenna.recorder;
}

RecorderTachometer tachometer_of(const io::Case& antenna) {
  const auto& tachometer = antenna.campaign.tachometer;
  if (!tachometer) {
    refuse_missing(antenna, "tachometer", "the scale the recorder writes motor rates in");
  }
  const auto& [shaft, motor_teeth, tachometer_teeth, voltage, shaft_speed, limit] = *tachometer;
  if (!voltage || !shaft_speed) {
    throw InvalidInput(
        fmt::format("{}: expected tachometer.voltage and tachometer.shaft_speed, for a simulated "
                    "recorder writes volts, found neither{}",
                    antenna.path, recorded_only));
  }
  if (!limit) {
    throw InvalidInput(fmt::format(
        "{}: expected tachometer.recorder_limit, which the tests' amplitudes go by, found none{}",
        antenna.path, recorded_only));
  }
  double turns = 1.0;  // of the motor, one of the shaft
  if (motor_teeth && tachometer_teeth) turns = motor_teeth->value / tachometer_teeth->value;
  if (shaft == "antenna") turns = io::gear_ratio(antenna);
  return {shaft_speed->value * turns / voltage->value, limit->value};
}

plant::NonlinearAntenna make_nonlinear_antenna(const io::Case& antenna) {
  const io::SimulationEntry& entry = simulation_of(antenna);
  plant::DriveDetails details;
  details.supply_pressure = antenna.drive.supply_pressure.value;
  details.return_pressure = entry.return_pressure.value;
  details.null_leakage_share = entry.null_leakage_share.value;
  details.case_leakage_share = entry.case_leakage_share.value;
  details.stroke_limit = entry.valve_stroke.value;
  details.slew_limit = entry.valve_stroke.value / entry.valve_stroke_time.value;
  details.overlap = entry.valve_overlap.value * entry.valve_stroke.value;
  details.makeup_pressure = entry.makeup_pressure.value;
  details.air_fraction = entry.air_fraction.value;
  if (antenna.oil.density) details.oil_density = antenna.oil.density->value;
  details.line_lengths = line_lengths(antenna);
  details.line_damping_ratio = entry.line_damping_ratio.value;
  details.friction = {io::friction_curve(antenna), entry.bristle_stiffness.value,
                      entry.bristle_damping.value, 0.0};
  details.offset = io::offset_torque(antenna);
  if (entry.backlash) {
    details.backlash = entry.backlash->value;
    details.preload_torque = entry.preload_torque.value;
  }
  return plant::make_nonlinear_antenna(make_plant(antenna), io::hydraulic_drive(antenna), details);
}

plant::NonlinearAntenna make_recorded_antenna(const io::Case& antenna) {
  auto model = make_nonlinear_antenna(antenna);
  if (model.oil.lines.empty()) {
    throw InvalidInput(
        fmt::format("{}: expected an [[oil.line]] with its length, whose ends the recorder's "
                    "transducers sit at, found none{}",
                    antenna.path, recorded_only));
  }
  return model;
}

LowPass low_pass_of(const io::Case& antenna) {
  const io::RecorderEntry& recorder = recorder_of(antenna);
  return {static_cast<int>(recorder.filter_order),
          recorder.filter_frequency ? recorder.filter_frequency->value : 0.0};
}

double tachometer_scale(const io::Case& antenna) {
  return tachometer_of(antenna).scale;
}

RecorderSensors make_sensors(const io::Case& antenna, std::size_t motors, std::uint64_t seed) {
  const io::RecorderEntry& recorder = recorder_of(antenna);
  const numerics::NormalNumbers numbers(seed, 1000);
  std::uint64_t drawn = 0;
  const auto pressure = [&] {
    const auto pair = numbers.pair(drawn++);
    return plant::Sensor{1.0 + recorder.pressure_gain.value * pair.real(),
                         recorder.pressure_zero.value * pair.imag(),
                         recorder.pressure_noise.value,
                         recorder.pressure_resolution.value,
                         0.0,
                         recorder.pressure_range.value};
  };
  RecorderSensors sensors;
  for (std::size_t motor = 0; motor < motors; ++motor) {
    sensors.inlet.push_back(pressure());
    sensors.outlet.push_back(pressure());
  }
  const auto [scale, limit] = tachometer_of(antenna);
  sensors.tachometer = {1.0 + recorder.tachometer_gain.value * numbers.pair(drawn).real(),
                        0.0,
                        recorder.tachometer_noise.value * scale,
                        recorder.tachometer_resolution.value * scale,
                        -limit * scale,
                        limit * scale};
  return sensors;
}

}  // namespace boresight::app
