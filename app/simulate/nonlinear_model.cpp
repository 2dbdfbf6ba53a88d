#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include <boresight/app/simulate/nonlinear_model.hpp>
#include <boresight/io/case/antenna_of.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/normal_numbers.hpp>
#include <boresight/plant/nonlinear/nonlinear_drive.hpp>

namespace boresight::app {
namespace {

// What is recorded; a run of the position loop is not.
constexpr const char* recorded_only = "; tracking and slew need none";

[[noreturn]] void refuse_missing(const io::Case& antenna, const char* table, const char* purpose) {
  throw InvalidInput(fmt::format(
      "{}: expected a table [{}] with {}, found none (see docs/case-file.md{})", antenna.path,
      table, purpose, std::string_view(table) == "simulation" ? "" : recorded_only));
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
  simulation_of(antenna);  // refuses a case without
  return plant::nonlinear_antenna(antenna_of(antenna));
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
