#pragma once

#include <cstdint>
#include <vector>

#include <boresight/identification/records/drive_record.hpp>
#include <boresight/plant/nonlinear/nonlinear_antenna.hpp>
#include <boresight/plant/nonlinear/sensor.hpp>

namespace boresight::coverage {

/// An antenna's drive that nobody knows, what its drawings say of it, and the recorder on it. SI at
/// the motor shaft.
struct RandomDrive {
  plant::NonlinearAntenna antenna;
  /// Off the truth by errors drawn from the standard uncertainties that it states.
  identification::DriveKnowledge knowledge;
  identification::Instruments instruments;

  // What the knowledge says, as it is.
  double motor_inertia = 0.0;  // of all motors
  double inertia = 0.0;        // of everything
  double oil_stiffness = 0.0;  // without air
  double bulk_modulus = 0.0;
  double leakage_rate = 0.0;
  double torque_per_pressure = 0.0;  // of all motors together

  // The recorder.
  std::vector<plant::Sensor> inlet, outlet;  // Pa, one a motor
  plant::Sensor tachometer;                  // rad/s of motor
  double tachometer_ripple = 0.0;            // amplitude, fraction of the rate
  double ripple_order = 0.0;                 // periods a turn of the motor
  double valve_scale = 1.0;                  // recorded per true command
  plant::Sensor encoder;                     // rad at the sky

  // How the tests are run.
  double rate_limit = 0.0;     // rad/s: the recorder shows no more
  double integral_gain = 0.0;  // 1/s, of the rate loop
  double wind_rms = 0.0;       // N m
  double wind_corner = 0.0;    // Hz
};

/// Drive `number` of a seed. Two to four motors; inertia, displacement, volumes and supply over a
/// decade or more, chosen so that the hydraulic mode lies from 0.7 to 1.6 Hz and friction takes an
/// eighth to a quarter of the supply's torque; a structure of three to five modes, of which the
/// drawings leave out one in half of the cases; half with a valve whose lands lap, half with air in
/// the oil, half with backlash under a counter-torque preload; wind and ripple of the tachometer.
RandomDrive random_drive(std::uint64_t seed, std::uint64_t number);

}  // namespace boresight::coverage
