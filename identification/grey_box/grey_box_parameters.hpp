#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <boresight/identification/grey_box/grey_box_hydraulics.hpp>
#include <boresight/identification/grey_box/grey_box_record.hpp>
#include <boresight/identification/records/drive_record.hpp>
#include <boresight/numerics/statistics/interval.hpp>

namespace boresight::identification {

/// A parameter of the grey box. A positive one is represented by its logarithm.
struct GreyBoxParameter {
  std::string name;
  std::string unit;  // SI; empty: a plain number
  bool logarithmic = true;
  double prior = 0.0;   // median
  double spread = 0.0;  // standard deviation, of the logarithm if logarithmic; 0: known
  /// True if drawings, data sheets or instruments give the prior. Otherwise it is a wide guess that
  /// keeps undetermined parameters within reason.
  bool from_drawings = false;
};

/// The grey box's parameters of a campaign, and their map to the coefficients of its two halves.
/// Points are distances from the prior in units of the spreads, so the prior is standard normal.
class GreyBoxParameters {
 public:
  enum : Eigen::Index {
    motor_inertia,    // kg m2, all motors with flywheels
    gear_inertia,     // kg m2, all motors' gears
    antenna_inertia,  // kg m2, at the motor shaft
    pressure_gain,    // recorded per true pressure, mean of all transducers
    torque_factor,    // torque per pressure, true per stated
    flow_factor,      // flow per motor rate, true per stated
    tachometer_gain,  // recorded per true rate
    bulk_modulus,     // Pa
    volume_1,         // m3
    volume_2,
    coulomb_torque,  // from here to tachometer_lag as MechanicalCoefficients has them
    stribeck_torque,
    stribeck_rate,
    saturating_torque,
    saturating_rate,
    viscous_friction,
    bristle_stiffness,
    bristle_damping,
    offset_torque,
    common_torque,
    tachometer_zero,
    tachometer_lag,
    rate_correction,
    mode_damping,
    cross_leakage,  // from here to valve_lap as HydraulicCoefficients has them
    null_leakage,
    case_leakage,
    valve_gain,
    valve_null,
    valve_lag,
    valve_curvature,
    line_resistance,
    supply_torque,
    supply_droop,
    pressure_correction,
    valve_lap,
    command_gain,  // opening per rate command, where the rate command drives the valve
    modes          // inertia fraction and frequency of each mode of the locked rotor
  };
  static Eigen::Index fraction(Eigen::Index mode) { return modes + 2 * mode; }
  static Eigen::Index frequency(Eigen::Index mode) { return modes + 2 * mode + 1; }

  /// Sets the priors: from drawings and instruments of the campaign; for the bulk modulus from
  /// `bulk` if given (from drawings unless `bulk_guessed`). All others are wide, about rough
  /// estimates from the records. A gear inertia of zero is taken as known.
  /// @throws InvalidInput for knowledge without motors, displacement, volumes, inertias or supply
  /// pressure above the return's, or without records.
  GreyBoxParameters(const Campaign& campaign, const std::vector<GreyBoxRecord>& records,
                    const std::optional<numerics::Interval>& bulk = {}, bool bulk_guessed = false);

  Eigen::Index size() const { return static_cast<Eigen::Index>(list_.size()); }
  Eigen::Index mode_count() const { return (size() - modes) / 2; }
  const std::vector<GreyBoxParameter>& list() const { return list_; }
  const HydraulicUnits& units() const { return units_; }
  double tracking_rate() const { return tracking_rate_; }  // rad/s of motor

  /// Values of the parameters at a point, SI.
  Eigen::VectorXd values(const Eigen::VectorXd& point) const;

  /// Coefficients, and their derivatives by the point (coefficients x parameters).
  struct Coefficients {
    Eigen::VectorXd values;
    Eigen::MatrixXd by_point;
  };
  Coefficients mechanical(const Eigen::VectorXd& point) const;
  /// For a record whose valve command is calibrated or is a rate command.
  Coefficients hydraulic(const Eigen::VectorXd& point, bool valve_calibrated) const;

  /// The same with predictions that reach ahead over 1/factor of the time.
  GreyBoxParameters with_correction(double factor) const;

  /// The oil's stiffness on both sides together (N m/rad), true, from parameter values: what torque
  /// has against rate, with both efficiencies whatever the knowledge's convention of K.
  double oil_stiffness(const Eigen::VectorXd& values) const;
  /// All inertia at the motor shaft as the recorder shows it (kg m2), per true inertia.
  static double recorded_inertia_factor(const Eigen::VectorXd& values);

 private:
  void add_drawings(const Campaign& campaign, const std::optional<numerics::Interval>& bulk,
                    bool guessed);
  void add_friction(const std::vector<GreyBoxRecord>& records);
  void add_sensors(const Campaign& campaign, const std::vector<GreyBoxRecord>& records);
  void add_hydraulics(const Campaign& campaign, const std::vector<GreyBoxRecord>& records);
  void add_modes(const DriveKnowledge& knowledge);

  std::vector<GreyBoxParameter> list_;
  HydraulicUnits units_;
  /// Stiffness of a side as recorded, both efficiencies in it, per Pa of bulk modulus and m3: K =
  /// stiffness_scale_ beta/V.
  double stiffness_scale_ = 0.0;
  double largest_rate_ = 0.0;
  double largest_torque_ = 0.0;
  double tracking_rate_ = 0.0;
};

}  // namespace boresight::identification
