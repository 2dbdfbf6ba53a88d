#pragma once

#include <Eigen/Core>

#include <boresight/plant/wind/wind.hpp>

namespace boresight::plant {

/// A wind torque coefficient C over the attitude of the dish, as measured in a wind tunnel: axis
/// torque = 1/2 rho V^2 A D C with A = pi/4 D^2. Bilinear between the table's points. The yaw is
/// the direction from which the wind comes less the direction in which the dish points, in azimuth:
/// 0 with the wind into the dish's face. Convert tables with another yaw convention first.
class TorqueCoefficientTable {
 public:
  /// Yaw and elevation in rad, ascending, at least 2 of each; `coefficients`: yaws x elevations. A
  /// table whose yaw spans 360 deg (to 1e-9 rad) must have the same values at both ends and holds
  /// for every yaw. @throws InvalidInput for shapes, axes that do not ascend, elements that are not
  /// finite, a yaw over more than 360 deg, and ends of a full circle that differ by more than 1e-9
  /// of the largest coefficient.
  TorqueCoefficientTable(Eigen::VectorXd yaw, Eigen::VectorXd elevation,
                         Eigen::MatrixXd coefficients);

  /// C at a yaw and elevation (rad). @throws InvalidInput out of the table (by more than 1e-9 rad).
  double at(double yaw, double elevation) const;

  /// Whether the table holds for every yaw.
  bool full_circle() const { return full_circle_; }

 private:
  Eigen::VectorXd yaw_;
  Eigen::VectorXd elevation_;
  Eigen::MatrixXd coefficients_;
  bool full_circle_ = false;
};

/// A coefficient of the American tower standards EIA/TIA-222 (forces C_A, C_S = F/(A V^2), moment
/// C_M = M/(D A V^2), in lb, ft and mph) without its units: divided by the 0.00256 lb/ft^2 of
/// dynamic pressure at 1 mph in the standard's air (1.227 kg/m^3).
double coefficient_from_eia_222(double coefficient);

/// The coefficients about both axes of the mount, and quantities computed for each axis.
struct AxisTorqueTables {
  TorqueCoefficientTable azimuth;
  TorqueCoefficientTable elevation;
};
struct AxisTorques {
  double azimuth = 0.0;
  double elevation = 0.0;
};

/// The site with the torque_coefficient that the table has at a yaw and elevation (rad); for all
/// the functions of wind.hpp. @throws InvalidInput as the table.
WindSite at_attitude(const WindSite& site, const TorqueCoefficientTable& table, double yaw,
                     double elevation);

/// Mean torque about each axis (N m), as of one coefficient. @throws InvalidInput as that and `at`.
AxisTorques mean_wind_torque(const WindSite& site, const AxisTorqueTables& tables, double yaw,
                             double elevation, double mean_speed);

/// Torque per speed of a gust along the mean wind about each axis, dT/dV (N m per m/s), as of one
/// coefficient. @throws InvalidInput as that and `at`.
AxisTorques wind_torque_sensitivity(const WindSite& site, const AxisTorqueTables& tables,
                                    double yaw, double elevation, double mean_speed);

/// Attitude (rad) at which the torque coefficients were taken from their table: wind direction less
/// azimuth of the dish, and elevation of the dish.
struct WindAttitude {
  double yaw = 0.0;
  double elevation = 0.0;
};

}  // namespace boresight::plant
