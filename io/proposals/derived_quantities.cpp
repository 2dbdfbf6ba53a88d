#include <algorithm>
#include <cmath>
#include <limits>

#include <boresight/io/case/antenna_of.hpp>
#include <boresight/io/case/case_drive.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_friction.hpp>
#include <boresight/io/case/case_goals.hpp>
#include <boresight/io/case/case_motor.hpp>
#include <boresight/io/case/case_oil.hpp>
#include <boresight/io/case/case_sensors.hpp>
#include <boresight/io/case/case_simulation.hpp>
#include <boresight/io/case/case_structure.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/mission_of.hpp>
#include <boresight/io/case/plant_numbers.hpp>
#include <boresight/io/case/structure_numbers.hpp>
#include <boresight/io/proposals/proposed_case.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/plant/wind/wind.hpp>

namespace boresight::io {
namespace {

double all_motors(const Case& antenna) {
  return motor_inertia(antenna, antenna.motor->flywheel_disks);
}

double load(const Case& antenna) {
  return gear_train_inertia(antenna) + antenna_inertia(antenna);
}

double rigid_frequency(const Case& antenna) {
  return std::sqrt(oil_stiffness(antenna) / (all_motors(antenna) + load(antenna))) / two_pi;
}

double wind_torque(const Case& antenna) {
  const auto problem = make_problem(antenna);
  return plant::mean_wind_torque(problem.wind.site, problem.wind.mean_speed) / problem.gear_ratio;
}

double sky_friction(const Case& antenna) {
  const auto& curve = *antenna.friction_curve;
  return (curve.coulomb.value + curve.saturating.value) * gear_ratio(antenna);
}

// The valve fully open; NaN where the case states nothing of it.
double no_load_motor_rate(const Case& antenna) {
  if (antenna.simulation) return antenna.simulation->valve_stroke.value;
  const auto rated = rated_stroke(antenna);
  return rated ? rated->value : std::nan("");
}

// With the bull gear held; infinite without modes.
double lowest_mode(const Case& antenna) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const auto& mode : structure_specification(*antenna.structure).modes) {
    lowest = std::min(lowest, mode.frequency);
  }
  return lowest;
}

struct Derived {
  const char* quantity = "";
  const char* unit = "";
  double (*value)(const Case&) = nullptr;
  const char* follows_from = "";
  const char* key = "";      // of the case's own number, where it is one
  bool motors_held = false;  // only of a case that states its modes with the motors held
};

constexpr Derived derived[] = {
    {"gear ratio", "1", gear_ratio, "product of driven over driving teeth"},
    {"inertia of all motors", "kg.m2", all_motors, "count x (rotor + disks x disk inertia)"},
    {"gear train at the motors", "kg.m2", gear_train_inertia,
     "each body over the square of the ratio before it"},
    {"antenna at the motors", "kg.m2", [](const Case& c) { return antenna_inertia(c); },
     "over the square of the gear ratio"},
    {"gear spring Kg at the motors", "N.m/rad",
     [](const Case& c) { return make_plant(c).structure.gear_stiffness; },
     "w^2 (Jb + sum Ji/(1 - (w/wi)^2)), w with the rotor locked, wi with the bull gear held"},
    {"locked-rotor frequency", "Hz",
     [](const Case& c) { return c.structure->locked_rotor_frequency.value; },
     "the gear spring under a structure that stays", "structure.locked_rotor_frequency"},
    {"lowest mode with the bull gear held", "Hz", lowest_mode,
     "all frequencies with the motors held and the inertia fractions, solved anew", "", true},
    {"motor-to-load ratio", "1", [](const Case& c) { return all_motors(c) / load(c); },
     "motors over gear train and antenna"},
    {"volume 1", "m3", [](const Case& c) { return c.oil->volume_1.value; }, "line lengths",
     "oil.volume_1"},
    {"volume 2", "m3", [](const Case& c) { return c.oil->volume_2.value; }, "line lengths",
     "oil.volume_2"},
    {"oil stiffness K", "N.m/rad", [](const Case& c) { return oil_stiffness(c); },
     "et ev beta D^2 (1/V1 + 1/V2)"},
    {"leakage rate", "1/s", [](const Case& c) { return c.drive->leakage_rate.value; },
     "C beta (1/V1 + 1/V2), C a property of the hardware", "drive.leakage_rate"},
    {"leakage damper K/lambda", "N.m.s/rad",
     [](const Case& c) { return oil_stiffness(c) / c.drive->leakage_rate.value; }, "D^2/C"},
    {"rigid oil resonance", "Hz", rigid_frequency, "sqrt(K/J)/2 pi, all inertia rigid"},
    {"supply torque", "N.m", supply_torque, "supply pressure x D x torque efficiency"},
    {"valve stroke, no-load motor rate", "rad/s", no_load_motor_rate,
     "flow over D; flow with the root of the pressure", "simulation.valve_stroke"},
    {"control effort allowed", "rad/s", [](const Case& c) { return c.goals->control_effort.value; },
     "the same fraction of the valve's stroke"},
    {"torque noise", "N.m",
     [](const Case& c) { return c.sensors->torque_noise ? c.sensors->torque_noise->value : 0.0; },
     "pressure noise x D", "sensors.torque_noise"},
    {"encoder noise at the motor", "mrad",
     [](const Case& c) { return 1e3 * c.sensors->encoder_noise.value * gear_ratio(c); },
     "noise at the sky x gear ratio"},
    {"slew rate at the motor", "rad/s",
     [](const Case& c) { return c.drive->slew_rate.value * gear_ratio(c); },
     "rate at the sky x gear ratio"},
    {"tracking rate at the motor", "rad/s",
     [](const Case& c) { return c.drive->tracking_rate.value * gear_ratio(c); },
     "rate at the sky x gear ratio"},
    {"friction slope at the tracking rate", "N.m.s/rad", tracking_friction,
     "the friction curve's slope at that motor rate"},
    {"friction level at the sky", "kN.m", [](const Case& c) { return 1e-3 * sky_friction(c); },
     "the same at the motor shaft, x gear ratio"},
    {"mean wind torque at the motors", "N.m", wind_torque,
     "torque on the dish over the gear ratio"},
    {"dead time", "s", [](const Case& c) { return c.controller->delay.value; },
     "one and a half samples", "controller.delay"},
    {"noise bandwidth", "Hz", [](const Case& c) { return c.sensors->noise_bandwidth.value; },
     "half the sampling rate", "sensors.noise_bandwidth"},
    {"slew rate at the sky within the stroke", "deg/s",
     [](const Case& c) { return no_load_motor_rate(c) / gear_ratio(c) / degree; },
     "valve stroke over the gear ratio, without load"},
};

}  // namespace

std::vector<DerivedChange> derived_quantities_of(const Case& before, const Case& after) {
  constexpr double rounding = 1e-9;
  std::vector<DerivedChange> found;
  for (const auto& one : derived) {
    if (one.motors_held && !before.structure->motors_held) continue;
    const double was = one.value(before), is = one.value(after);
    if (!std::isfinite(was) || !std::isfinite(is)) continue;
    if (std::abs(is - was) <= rounding * std::max(std::abs(was), std::abs(is))) continue;
    found.push_back({one.quantity, one.unit, was, is, one.follows_from, one.key});
  }
  return found;
}

}  // namespace boresight::io
