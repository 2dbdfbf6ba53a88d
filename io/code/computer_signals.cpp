#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include <boresight/design/problem/standstill.hpp>
#include <boresight/io/case/case_computer.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_simulation.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/tested_drive_of.hpp>
#include <boresight/io/code/computer_signals.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/plant/antenna/hydraulics.hpp>

namespace boresight::io {
namespace {

// Powers of two that an encoder may have.
constexpr double fewest_bits = 8.0, most_bits = 30.0;

void set_encoder(const Case& antenna, const ComputerEntry& entry, const design::Mission& mission,
                 CaseSignals& result) {
  auto& signals = result.signals;
  if (entry.encoder_counts) {
    signals.encoder_counts = *entry.encoder_counts;
  } else {
    const double step = design::encoder_step(mission.antenna);
    const double bits = step > 0.0 ? std::round(std::log2(two_pi / step)) : most_bits;
    signals.encoder_counts = std::int64_t{1}
                             << static_cast<int>(std::clamp(bits, fewest_bits, most_bits));
  }
  signals.encoder_zero = entry.encoder_zero ? entry.encoder_zero->value : 0.0;
  const double usual = antenna.axis == "elevation" ? 45.0 * degree : std::numbers::pi;
  signals.encoder_centre = entry.encoder_centre ? entry.encoder_centre->value : usual;
  result.descriptions.push_back(
      {"encoder",
       fmt::format("{} counts per turn, 0 at {:g} deg, travel about {:g} deg",
                   signals.encoder_counts, signals.encoder_zero / degree,
                   signals.encoder_centre / degree),
       entry.encoder_counts && entry.encoder_zero && entry.encoder_centre});
}

void set_tachometer(const Case& antenna, CaseSignals& result) {
  const auto rate = motor_rate_per_volt(antenna);
  if (rate) result.signals.tachometer = {1.0 / *rate, "V"};
  result.descriptions.push_back(
      {"tachometer", rate ? fmt::format("{:.6g} rad/s of motor per V", *rate) : "rad/s of motor",
       rate.has_value()});
}

void set_torque(const Case& antenna, const ComputerEntry& entry, CaseSignals& result) {
  const double torque = plant::torque_per_pressure(hydraulic_drive(antenna));
  const bool stated = entry.transducer_pressure && entry.transducer_voltage;
  if (stated) {
    const double pressure = entry.transducer_pressure->value / entry.transducer_voltage->value;
    result.signals.motor_torque = {1.0 / (torque * pressure), "V"};
  } else {
    result.signals.motor_torque = {1.0 / torque, "Pa"};
  }
  result.descriptions.push_back(
      {"motor torque",
       fmt::format("{:.6g} N.m per {} of pressure difference between the ports",
                   1.0 / result.signals.motor_torque.scale, result.signals.motor_torque.unit),
       stated});
}

void set_valve(const Case& antenna, const ComputerEntry& entry, CaseSignals& result) {
  constexpr double milliamperes = 1000.0;
  const double stroke = antenna.simulation->valve_stroke.value;
  double full = 100.0;
  const char* unit = "%";
  if (entry.valve_voltage) {
    full = entry.valve_voltage->value;
    unit = "V";
  } else if (entry.valve_current) {
    full = entry.valve_current->value * milliamperes;
    unit = "mA";
  }
  result.signals.valve_command = {full / stroke, unit};
  result.descriptions.push_back(
      {"valve command",
       fmt::format("{:g} {} at full stroke, {:g} rad/s of motor without load", full, unit, stroke),
       entry.valve_voltage || entry.valve_current});
}

}  // namespace

CaseSignals computer_signals(const Case& antenna, const design::Mission& mission,
                             bool reads_torque) {
  require_simulation(antenna);
  const ComputerEntry entry = antenna.computer ? *antenna.computer : ComputerEntry{};
  CaseSignals result;
  set_encoder(antenna, entry, mission, result);
  set_tachometer(antenna, result);
  if (reads_torque) set_torque(antenna, entry, result);
  set_valve(antenna, entry, result);
  return result;
}

}  // namespace boresight::io
