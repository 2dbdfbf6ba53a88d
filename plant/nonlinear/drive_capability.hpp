#pragma once

#include <optional>

#include <boresight/plant/antenna/antenna.hpp>

/// What the drive of an antenna has against friction and offset torque while it turns steadily. At
/// the motor shaft, all motors: N m, rad/s and N m s/rad.
namespace boresight::plant {

/// Slope of the friction curve at the tracking rate; negative where friction falls with the rate
/// there, which is what makes a drive stick and slip.
double tracking_slope(const Antenna& antenna);
/// The same as the viscous friction of a linear plant, 0 at least: a steady loop about a falling
/// slope is a question for the simulation, which has the whole curve.
double tracking_friction(const Antenna& antenna);

/// The most viscous friction that a linear plant may have: tracking_friction, or the antenna's own.
double largest_viscous_friction(const Antenna& antenna);

/// Torque at the supply pressure, the return pressure not taken off.
double supply_torque(const Antenna& antenna);

/// What of the supply torque is left against wind: less the friction at the tracking rate and the
/// magnitude of the offset torque at the antenna's elevation, since the wind may blow the way that
/// both resist; 0 where they take all of it.
double available_wind_torque(const Antenna& antenna);

/// No-load rate of the motors with the valve fully open, by its rated flow Q at the total drop p
/// over both edges: Q sqrt((supply - return)/p)/(motors x displacement), as flow goes with the root
/// of the drop (H. E. Merritt, Hydraulic Control Systems, 1967, section 5.2). Without the
/// volumetric efficiency: without load nothing drives oil past the pistons. None where the flow is
/// not known.
std::optional<double> rated_stroke(const Antenna& antenna);

/// The largest rate that may be asked of the valve: its stroke; else rated_stroke; else what the
/// slew rate takes.
double largest_demand(const Antenna& antenna);

/// Number of flywheel disks on each motor at which motors and a load (kg m2 at the motor shaft)
/// have one inertia; none if that would need fewer than 0.
std::optional<double> disks_at_unit_ratio(const Antenna& antenna, double load_inertia);

/// Steady load, and what supply and valve leave for it.
class LoadedDrive {
 public:
  /// By the antenna's own oil stiffness and supply torque.
  explicit LoadedDrive(const Antenna& antenna);
  /// `oil_stiffness` (N m/rad), with the leakage rate, says what leaks past the motors;
  /// `supply_torque` is at the supply pressure, the return pressure not taken off.
  LoadedDrive(const Antenna& antenna, double oil_stiffness, double supply_torque);

  /// The supply's torque above the return's.
  double available() const { return available_; }
  bool has_offset() const { return offset_ > 0.0; }
  /// Friction and offset at a rate; either way, so that the offset resists.
  double load(double rate) const;
  /// What load and valve need together beyond what is available: the valve's flow goes with the
  /// root of its drop, and some of it leaks past the motors. `stroke`: the rate without load.
  double excess(double rate, double stroke) const;
  /// The highest rate without an excess, by bisection.
  double attainable_rate(double stroke) const;

 private:
  FrictionCurve curve_;
  double offset_ = 0.0;
  double leakage_ = 0.0;
  double available_ = 0.0;
};

/// The highest rate that the drive holds against its load over what slewing takes; none where
/// nothing of the valve's stroke is known.
std::optional<double> slew_rate_margin(const Antenna& antenna);

}  // namespace boresight::plant
