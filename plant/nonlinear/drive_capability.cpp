#include <algorithm>
#include <cmath>

#include <boresight/plant/nonlinear/drive_capability.hpp>
#include <boresight/plant/nonlinear/nonlinear_drive.hpp>

namespace boresight::plant {
namespace {

double return_pressure(const Antenna& antenna) {
  return antenna.nonlinear ? antenna.nonlinear->return_pressure : antenna.drive.return_pressure;
}

// At the antenna's elevation, either way.
double offset_magnitude(const Antenna& antenna) {
  return std::abs(offset_torque(offset_torque(antenna), 0.0).value);
}

double tracking_rate_at_motor(const Antenna& antenna) {
  return sky_to_motor(antenna, antenna.drive.tracking_rate);
}

}  // namespace

double tracking_slope(const Antenna& antenna) {
  return friction_slope(antenna.friction_curve, tracking_rate_at_motor(antenna));
}

double tracking_friction(const Antenna& antenna) {
  return std::max(0.0, tracking_slope(antenna));
}

double largest_viscous_friction(const Antenna& antenna) {
  return std::max(tracking_friction(antenna), antenna.drive.viscous_friction);
}

double supply_torque(const Antenna& antenna) {
  return antenna.drive.supply_pressure * torque_per_pressure(antenna.hydraulics);
}

double available_wind_torque(const Antenna& antenna) {
  const double friction = friction_torque(antenna.friction_curve, tracking_rate_at_motor(antenna));
  return std::max(0.0, supply_torque(antenna) - friction - offset_magnitude(antenna));
}

std::optional<double> rated_stroke(const Antenna& antenna) {
  const auto& flow = antenna.drive.rated_flow;
  const auto& drop = antenna.drive.rated_pressure_drop;
  if (!flow || !drop) return std::nullopt;
  const double driving = antenna.drive.supply_pressure - return_pressure(antenna);
  return *flow * std::sqrt(driving / *drop) /
         (antenna.hydraulics.motor_count * antenna.hydraulics.displacement);
}

double largest_demand(const Antenna& antenna) {
  if (antenna.nonlinear) return antenna.nonlinear->valve_stroke;
  if (const auto rated = rated_stroke(antenna)) return *rated;
  return sky_to_motor(antenna, antenna.drive.slew_rate);
}

std::optional<double> disks_at_unit_ratio(const Antenna& antenna, double load_inertia) {
  const Flywheels& flywheels = antenna.flywheels;
  const double each = load_inertia / antenna.hydraulics.motor_count;
  const double disks =
      flywheels.counted_disks + (each - flywheels.motor_inertia) / flywheels.disk_inertia;
  return disks >= 0.0 ? std::optional(disks) : std::nullopt;
}

LoadedDrive::LoadedDrive(const Antenna& antenna)
    : LoadedDrive(antenna, oil_stiffness(antenna), plant::supply_torque(antenna)) {}

LoadedDrive::LoadedDrive(const Antenna& antenna, double oil_stiffness, double supply_torque)
    : curve_(antenna.friction_curve),
      offset_(offset_magnitude(antenna)),
      leakage_(antenna.drive.leakage_rate / oil_stiffness),
      available_(supply_torque * (1.0 - return_pressure(antenna) / antenna.drive.supply_pressure)) {
}

double LoadedDrive::load(double rate) const {
  return friction_torque(curve_, rate) + offset_;
}

double LoadedDrive::excess(double rate, double stroke) const {
  const double torque = load(rate);
  const double fraction = (rate + leakage_ * torque) / stroke;
  return torque - available_ * (1.0 - fraction * fraction);
}

double LoadedDrive::attainable_rate(double stroke) const {
  double lowest = 0.0, highest = stroke;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (lowest + highest);
    (excess(middle, stroke) <= 0.0 ? lowest : highest) = middle;
  }
  return lowest;
}

std::optional<double> slew_rate_margin(const Antenna& antenna) {
  if (!antenna.nonlinear && !rated_stroke(antenna)) return std::nullopt;
  return LoadedDrive(antenna).attainable_rate(largest_demand(antenna)) /
         sky_to_motor(antenna, antenna.drive.slew_rate);
}

}  // namespace boresight::plant
