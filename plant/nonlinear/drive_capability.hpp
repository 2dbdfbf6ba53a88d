#pragma once

#include <optional>

#include <boresight/plant/antenna/antenna.hpp>

/// Capability of an antenna's drive against friction and offset torque in steady motion. At the
/// motor shaft, all motors: N m, rad/s and N m s/rad.
namespace boresight::plant {

/// Slope of the friction curve at the tracking rate. A negative slope, friction falling with rate,
/// causes stick-slip.
double tracking_slope(const Antenna& antenna);
/// The same as the viscous friction of a linear plant, at least 0. Stability on a falling slope
/// needs the simulation, which has the whole curve.
double tracking_friction(const Antenna& antenna);

/// The largest viscous friction of a linear plant: tracking_friction, or the antenna's own if
/// larger.
double largest_viscous_friction(const Antenna& antenna);

/// Torque at the supply pressure, return pressure not subtracted.
double supply_torque(const Antenna& antenna);

/// Supply torque available against wind. Subtracted are the friction at the tracking rate and the
/// magnitude of the offset torque at the antenna's elevation, as the wind may act in the direction
/// that both resist. 0 if nothing is left.
double available_wind_torque(const Antenna& antenna);

/// No-load rate of the motors with the valve fully open, by its rated flow Q at the total drop p
/// over both edges: Q sqrt((supply - return)/p)/(motors x displacement). The flow scales with the
/// square root of the drop (H. E. Merritt, Hydraulic Control Systems, 1967, section 5.2). The
/// volumetric efficiency is excluded: without load nothing drives oil past the pistons. None if the
/// flow is not known.
std::optional<double> rated_stroke(const Antenna& antenna);

/// The largest rate that may be commanded of the valve: its stroke; else rated_stroke; else the
/// rate needed for slewing.
double largest_demand(const Antenna& antenna);

/// Number of flywheel disks on each motor at which the motors' inertia equals that of a load (kg m2
/// at the motor shaft); none if it would be below 0.
std::optional<double> disks_at_unit_ratio(const Antenna& antenna, double load_inertia);

/// The steady load, and the capability of supply and valve to drive it.
class LoadedDrive {
 public:
  /// With the antenna's own oil stiffness and supply torque.
  explicit LoadedDrive(const Antenna& antenna);
  /// `oil_stiffness` (N m/rad) and the leakage rate determine the leakage past the motors.
  /// `supply_torque` is at the supply pressure, return pressure not subtracted.
  LoadedDrive(const Antenna& antenna, double oil_stiffness, double supply_torque);

  /// The supply's torque less the return's.
  double available() const { return available_; }
  bool has_offset() const { return offset_ > 0.0; }
  /// Friction and offset at a rate; for the direction in which the offset resists.
  double load(double rate) const;
  /// Torque that load and valve need together in excess of the available one. The valve's flow
  /// scales with the square root of its drop; part of it leaks past the motors. `stroke`: the rate
  /// without load.
  double excess(double rate, double stroke) const;
  /// The highest rate without an excess, by bisection.
  double attainable_rate(double stroke) const;

 private:
  FrictionCurve curve_;
  double offset_ = 0.0;
  double leakage_ = 0.0;
  double available_ = 0.0;
};

/// The highest rate that the drive holds against its load, over the slew rate; none if the valve's
/// stroke is not known.
std::optional<double> slew_rate_margin(const Antenna& antenna);

}  // namespace boresight::plant
