#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <boresight/identification/campaign/inertia_methods.hpp>

namespace boresight::identification {

/// What was done with the drive while its recorder ran.
enum class TestKind {
  slosh,           // the valve opened and closed suddenly
  fast_ramp,       // triangle up to high speed
  slow_ramp,       // triangle of a slow rate, through breakaway
  constant_speed,  // square wave of one speed
  valve_steps,     // small valve steps about a moving operating point
  valve_chirp,     // valve sine sweep about a moving operating point
  other
};

/// A channel of a record at the record's samples, SI.
struct Signal {
  /// Finite everywhere: where a sample is not valid, the straight line between its neighbours.
  Eigen::VectorXd values;
  /// One a sample; false: missing, clipped or otherwise not what the sensor saw. Empty: all valid.
  std::vector<bool> valid;
  bool is_valid(Eigen::Index sample) const {
    return valid.empty() || valid[static_cast<std::size_t>(sample)];
  }
};

/// What an antenna's recorder wrote in one test, evenly sampled, all motors at the motor shaft.
struct DriveRecord {
  std::string name;
  TestKind test = TestKind::other;
  bool rate_loop_closed = false;
  double sample_time = 0.0;             // s
  std::vector<Signal> inlet_pressure;   // Pa, one a motor; above the outlet's for positive torque
  std::vector<Signal> outlet_pressure;  // Pa
  Signal motor_rate;                    // rad/s, from the tachometer; clipped samples not valid
  /// rad/s: the recorder shows no faster motion.
  double motor_rate_limit = std::numeric_limits<double>::infinity();
  std::optional<Signal> rate_command;   // rad/s of motor
  std::optional<Signal> valve_command;  // rad/s of no-load motor speed, by the stated scale
  /// rad at the sky, continuous through full turns. No method but channel_consistency uses it.
  std::optional<Signal> encoder;
  Eigen::Index samples() const { return motor_rate.values.size(); }
};

/// Standard uncertainties of what the recorder's channels were calibrated to, each channel on its
/// own. They do not shrink with the length of a record.
struct Instruments {
  double pressure_gain = 0.0;     // relative
  double pressure_zero = 0.0;     // Pa
  double tachometer_scale = 0.0;  // relative
  double valve_scale = 0.0;       // relative
  /// What is not known of the sum of all pressures where some stand for others, whose zeros they do
  /// not have. Pa.
  double unknown_pressure_sum = 0.0;
};

/// What drawings, data sheets and the structural model say of the drive. SI at the motor shaft.
struct DriveKnowledge {
  double motor_count = 1.0;
  numerics::Uncertain motor_inertia;  // one motor with its flywheel, kg m2
  numerics::Uncertain gear_inertia;   // gear train and counter-torque motors, all motors' together
  /// The antenna's at the motor shaft.
  numerics::Uncertain antenna_inertia;
  numerics::Uncertain displacement;  // one motor, m3/rad
  numerics::Uncertain torque_efficiency;
  numerics::Uncertain volumetric_efficiency;
  numerics::Uncertain oil_density;
  numerics::Uncertain volume_1;  // m3, the side that drives upwards (the inlets')
  numerics::Uncertain volume_2;
  plant::EfficiencyInStiffness efficiency_in_stiffness = plant::EfficiencyInStiffness::both;
  /// From valve to motor, one a motor (or fewer: the shortest first, the longest last); inlet and
  /// outlet alike. m.
  std::vector<numerics::Uncertain> line_lengths;
  /// Of the structure on a locked rotor, rising, Hz.
  std::vector<numerics::Uncertain> locked_rotor_frequencies;
  double supply_pressure = 0.0;  // Pa
  /// Standard, Pa; the fit of all records takes at least 1 % of the pressure.
  double supply_uncertainty = 0.0;
  double return_pressure = 0.0;  // Pa
  /// Motor speed at which the antenna tracks a star, rad/s.
  double tracking_rate = 0.0;
  /// Motor turns per turn of the antenna; 0: not known.
  double gear_ratio = 0.0;
};

/// A test campaign: records and what is known beside them.
struct Campaign {
  DriveKnowledge knowledge;
  Instruments instruments;
  std::vector<DriveRecord> records;
};

/// Torque of all motors at the motor shaft from the port pressures (N m, one a sample): torque
/// efficiency times displacement times the sum over the motors of inlet less outlet pressure.
/// Sommerville eq. 29.
Eigen::VectorXd recorded_torque(const DriveRecord& record, const DriveKnowledge& knowledge);

/// Torque (N m) per Pa of the sum over the motors of pressure difference.
double torque_per_pressure(const DriveKnowledge& knowledge);

}  // namespace boresight::identification
