#pragma once

#include <optional>

#include <boresight/io/case/case_file.hpp>
#include <boresight/plant/antenna/friction.hpp>

namespace boresight::io {

/// What the motors must hold while they turn steadily, and what the supply has for it and for the
/// drop of the valve, fully open. At the motor shaft, all motors: N m and rad/s.
class LoadedDrive {
 public:
  /// `oil_stiffness` (N m/rad), with the leakage rate, says what leaks past the motors;
  /// `supply_torque` is at the supply pressure, the return pressure not taken off.
  LoadedDrive(const Case& antenna, double oil_stiffness, double supply_torque);

  /// The supply's torque above the return's.
  double available() const { return available_; }
  bool has_offset() const { return offset_ > 0.0; }
  /// Friction and offset at a rate; either way, so that the offset resists.
  double load(double rate) const;
  /// What load and valve need together beyond what is available: the valve's flow goes with the
  /// root of its drop, and some of it leaks past the motors. `stroke`: the rate without load.
  double excess(double rate, double stroke) const;
  /// The highest rate without an excess.
  double attainable_rate(double stroke) const;

 private:
  plant::FrictionCurve curve_;
  double offset_ = 0.0;
  double leakage_ = 0.0;
  double available_ = 0.0;
};

/// The highest rate that the drive holds against its load over what slewing takes; none where the
/// case states nothing of its valve's stroke (largest_demand).
std::optional<double> slew_rate_margin(const Case& antenna);

}  // namespace boresight::io
