#include "random_drive.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "../random_numbers.hpp"
#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/plant/antenna/hydraulics.hpp>
#include <boresight/plant/antenna/structure_dynamics.hpp>

namespace boresight::coverage {
namespace {

using numerics::Uncertain;

constexpr double turn = 2.0 * std::numbers::pi;

class Draw {
 public:
  Draw(std::uint64_t seed, std::uint64_t number)
      : numbers_(seed * 0x9E3779B97F4A7C15U + number * 0xD1B54A32D192ED03U) {}
  double between(double low, double high) { return numbers_.uniform(low, high); }
  double logarithmic(double low, double high) { return numbers_.log_uniform(low, high); }
  int whole(int low, int high) { return numbers_.integer(low, high); }
  bool coin() { return whole(0, 1) == 1; }
  double normal() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - between(0.0, 1.0)));
    return radius * std::cos(between(0.0, turn));
  }
  /// What somebody states who is off by this relative standard uncertainty.
  Uncertain stated(double truth, double relative) {
    const double value = truth * std::exp(relative * normal());
    return {value, relative * value};
  }

 private:
  reference::RandomNumbers numbers_;
};

// Frequencies (Hz) of the structure with the motor held, rising.
std::vector<double> locked_rotor_frequencies(const plant::Structure& structure) {
  const auto model = plant::structure_dynamics(structure);
  // The gear spring as feedback of the bull gear's angle.
  const Eigen::MatrixXd held = model.a - structure.gear_stiffness * model.b.col(0) * model.c.row(0);
  const Eigen::VectorXcd poles = numerics::eigenvalues(held);
  std::vector<double> frequencies;
  for (const auto& pole : poles) {
    if (pole.imag() > 0.0) frequencies.push_back(std::abs(pole) / turn);
  }
  std::sort(frequencies.begin(), frequencies.end());
  return frequencies;
}

plant::Structure random_structure(Draw& draw, double antenna_inertia, double hydraulic_frequency) {
  plant::StructureSpecification structure;
  structure.antenna_inertia = antenna_inertia;
  structure.locked_rotor_frequency = hydraulic_frequency * draw.between(1.9, 3.2);
  structure.gear_damping_ratio = draw.between(0.005, 0.02);
  const int modes = draw.whole(3, 5);
  double frequency = structure.locked_rotor_frequency * draw.between(1.1, 1.4);
  double fraction = draw.between(0.45, 0.7);
  double left = 1.0 - fraction;
  for (int i = 0; i < modes; ++i) {
    const double wind_part = i == 0 ? 0.75 : 0.25 / (modes - 1);
    structure.modes.push_back(
        {frequency, draw.between(0.005, 0.02), fraction, wind_part, i == 0 ? 1.0 : 0.0});
    frequency *= draw.between(1.25, 1.5);
    fraction = left * draw.between(0.25, 0.5);
    left -= fraction;
  }
  return plant::make_structure(structure);
}

plant::MotorFriction random_friction(Draw& draw, double level, double rate_limit, double inertia) {
  plant::MotorFriction friction;
  const double at_standstill = draw.between(0.1, 0.6);
  auto& curve = friction.curve;
  curve.coulomb_torque = at_standstill * level;
  curve.saturating_torque = (1.0 - at_standstill) * level;
  curve.breakaway_torque = curve.coulomb_torque * draw.between(1.1, 1.7);
  curve.stribeck_rate = rate_limit * draw.logarithmic(0.004, 0.015);
  curve.saturating_rate = rate_limit * draw.logarithmic(0.04, 0.12);
  curve.viscous_friction = level * draw.between(0.3, 0.8) / rate_limit;
  friction.bristle_stiffness = curve.breakaway_torque / draw.logarithmic(0.004, 0.015);
  friction.bristle_damping =
      std::sqrt(friction.bristle_stiffness * inertia) * draw.between(0.03, 0.12);
  return friction;
}

void add_recorder(Draw& draw, RandomDrive& drive, int motors, double supply) {
  auto& instruments = drive.instruments;
  instruments.pressure_gain = draw.between(0.003, 0.01);
  instruments.pressure_zero = supply * draw.between(0.0005, 0.002);
  instruments.tachometer_scale = draw.between(0.002, 0.005);
  instruments.valve_scale = draw.between(0.02, 0.05);
  const double noise = supply * draw.logarithmic(5e-5, 3e-4);
  const double range = 1.2 * supply;
  const auto pressure = [&] {
    return plant::Sensor{1.0 + instruments.pressure_gain * draw.normal(),
                         instruments.pressure_zero * draw.normal(),
                         noise,
                         range / 65536.0,
                         -0.02 * range,
                         range};
  };
  for (int motor = 0; motor < motors; ++motor) {
    drive.inlet.push_back(pressure());
    drive.outlet.push_back(pressure());
  }
  drive.tachometer = {1.0 + instruments.tachometer_scale * draw.normal(),
                      drive.rate_limit * 0.001 * draw.normal(),
                      drive.rate_limit * draw.logarithmic(3e-4, 1e-3),
                      drive.rate_limit / 32768.0,
                      -drive.rate_limit,
                      drive.rate_limit};
  drive.tachometer_ripple = draw.between(0.0, 0.002);
  drive.ripple_order = draw.between(0.5, 6.0);
  drive.valve_scale = 1.0 + instruments.valve_scale * draw.normal();
  drive.encoder.resolution = turn / draw.logarithmic(4e6, 3e7);
  drive.encoder.noise = 0.5 * drive.encoder.resolution;
  drive.knowledge.gear_ratio = draw.logarithmic(1000.0, 10000.0);
}

}  // namespace

RandomDrive random_drive(std::uint64_t seed, std::uint64_t number) {
  Draw draw(seed, number);
  RandomDrive drive;
  const int motors = draw.whole(2, 4);
  drive.inertia = draw.logarithmic(0.3, 3.0);
  const double motors_fraction = draw.between(0.45, 0.72);
  const double gears_fraction = draw.between(0.06, 0.13);
  drive.motor_inertia = motors_fraction * drive.inertia;
  const double gear_inertia = gears_fraction * drive.inertia;
  const double antenna_inertia = drive.inertia - drive.motor_inertia - gear_inertia;

  const double supply = draw.logarithmic(10e6, 21e6);
  const double back = supply * draw.between(0.01, 0.04);
  const double supply_torque = drive.inertia * draw.logarithmic(120.0, 300.0);
  const double torque_efficiency = draw.between(0.91, 0.96);
  const double volumetric_efficiency = draw.between(0.92, 0.97);
  drive.torque_per_pressure = supply_torque / (supply - back);
  const double displacement = drive.torque_per_pressure / (torque_efficiency * motors);

  const double frequency = draw.logarithmic(0.7, 1.6);
  drive.oil_stiffness = drive.inertia * std::pow(turn * frequency, 2);
  drive.bulk_modulus = draw.between(1.0e9, 1.6e9);
  const double density = draw.between(840.0, 890.0);
  const double volumes = torque_efficiency * volumetric_efficiency * drive.bulk_modulus *
                         std::pow(displacement * motors, 2) / drive.oil_stiffness;
  const double unlike = draw.between(0.97, 1.03);
  const double volume_1 = volumes * (1.0 + unlike);
  const double volume_2 = volumes * (1.0 + 1.0 / unlike);
  drive.leakage_rate = draw.logarithmic(0.4, 2.5);

  const double slew = draw.logarithmic(60.0, 150.0);
  drive.rate_limit = slew * draw.between(0.15, 0.3);
  const double level = supply_torque * draw.between(0.12, 0.25);

  plant::AntennaPlant linear;
  linear.drive.oil_stiffness = drive.oil_stiffness;
  linear.drive.leakage_rate = drive.leakage_rate;
  linear.drive.motor_inertia = drive.motor_inertia + gear_inertia;
  linear.drive.valve_corner = turn * draw.logarithmic(12.0, 50.0);
  linear.drive.valve_damping = draw.between(0.6, 0.9);
  linear.drive.tachometer_corner = turn * draw.logarithmic(20.0, 80.0);
  const auto structure = random_structure(draw, antenna_inertia, frequency);
  linear.structure = structure;

  plant::DriveDetails details;
  details.supply_pressure = supply;
  details.return_pressure = back;
  details.stroke_limit = 1.2 * slew;
  details.supply_droop = draw.between(0.0, 0.03) * supply / details.stroke_limit;
  details.null_leakage_share = draw.between(0.05, 0.2);
  details.case_leakage_share = draw.between(0.0, 0.2);
  details.slew_limit = details.stroke_limit / draw.between(0.015, 0.05);
  details.overlap = draw.coin() ? 0.001 * details.stroke_limit : 0.0;
  details.null_offset = 0.003 * details.stroke_limit * draw.normal();
  details.makeup_pressure = 0.3 * back;
  details.air_fraction = draw.coin() ? draw.between(0.0, 3e-4) : 0.0;
  details.oil_density = density;
  details.line_damping_ratio = draw.logarithmic(0.004, 0.012);
  const double shortest = draw.logarithmic(7.0, 16.0);
  for (int motor = 0; motor < motors; ++motor) {
    details.line_lengths.push_back(shortest * (1.0 + 0.06 * motor * draw.between(0.8, 1.2)));
  }
  details.friction = random_friction(draw, level, drive.rate_limit, drive.inertia);
  details.offset.constant = (draw.coin() ? 1.0 : -1.0) * level * draw.between(0.03, 0.12);
  if (draw.coin()) {
    details.preload_torque = supply_torque * draw.between(0.08, 0.15);
    details.backlash = draw.between(0.05, 0.2);
  }
  const plant::HydraulicDrive hydraulic{static_cast<double>(motors),
                                        displacement,
                                        torque_efficiency,
                                        volumetric_efficiency,
                                        drive.bulk_modulus,
                                        volume_1,
                                        volume_2,
                                        plant::EfficiencyInStiffness::both};
  drive.antenna = plant::make_nonlinear_antenna(linear, hydraulic, details);
  drive.wind_rms = level * draw.between(0.001, 0.008);
  drive.wind_corner = draw.between(0.02, 0.1);
  // Half the gain at which the hydraulic mode would ring on.
  drive.integral_gain =
      0.35 * (drive.leakage_rate + details.friction.curve.viscous_friction / drive.inertia);

  auto& k = drive.knowledge;
  k.motor_count = motors;
  k.motor_inertia = draw.stated(drive.motor_inertia / motors, 0.005);
  k.gear_inertia = draw.stated(gear_inertia, 0.05);
  k.antenna_inertia = draw.stated(antenna_inertia, draw.between(0.05, 0.1));
  k.displacement = draw.stated(displacement, 0.002);
  k.torque_efficiency = draw.stated(torque_efficiency, 0.003);
  k.volumetric_efficiency = draw.stated(volumetric_efficiency, 0.005);
  k.oil_density = draw.stated(density, 0.002);
  k.volume_1 = draw.stated(volume_1, 0.01);
  k.volume_2 = draw.stated(volume_2, 0.01);
  for (const double length : details.line_lengths) {
    k.line_lengths.push_back(draw.stated(length, 0.002));
  }
  auto modes = locked_rotor_frequencies(structure);
  modes.resize(structure.modes.size() - (draw.coin() ? 1U : 0U));
  for (const double f : modes) k.locked_rotor_frequencies.push_back(draw.stated(f, 0.03));
  k.supply_pressure = supply * std::exp(0.005 * draw.normal());
  k.return_pressure = back;
  k.tracking_rate = 0.1 * drive.rate_limit;
  add_recorder(draw, drive, motors, supply);
  return drive;
}

}  // namespace boresight::coverage
