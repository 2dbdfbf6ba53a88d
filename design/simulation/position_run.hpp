#pragma once

#include <cstdint>
#include <optional>

#include <boresight/control/controllers/controller.hpp>
#include <boresight/design/problem/mission.hpp>
#include <boresight/design/simulation/simulated_record.hpp>

namespace boresight::design {

/// The gusts of a measured wind.
struct MeasuredGusts {
  double rms = 0.0;          // m/s, about the mean speed
  double sample_time = 0.0;  // s
};

/// Tracking rate and wind of a simulated run.
struct TrackingCourse {
  double rate = 0.0;             // rad/s at the sky
  double mean_wind_speed = 0.0;  // m/s
  plant::WindModel wind_model = plant::WindModel::coherence;
  plant::GustSpectrumKind spectrum = plant::GustSpectrumKind::davenport;
  std::optional<MeasuredGusts> measured;  // of Mission::wind_record
};

/// Slew of a simulated run. At the sky.
struct SlewCourse {
  double distance = 0.0;      // rad
  double largest_rate = 0.0;  // rad/s, of the command
  double acceleration = 0.0;  // rad/s2, of the command
  double wanted_rate = 0.0;   // rad/s
  double attainable = 0.0;    // rad/s, up to the wanted one: attainable_rate
};

/// The antenna under its position loop, in the time domain. Channels: time, reference (deg),
/// encoder_error and boresight_error (mdeg), all at the sky; motor_rate, motor_torque,
/// valve_command, wind_torque_at_motor.
struct PositionTestRecord : SimulatedRecord {
  control::Controller controller;
  /// The manoeuvre; exactly one is set.
  std::optional<TrackingCourse> tracking;
  std::optional<SlewCourse> slew;
  /// Boresight error about its mean, once settled (rad at the sky). The mean is the static
  /// deflection of the structure under the mean wind, which calibration removes. None if the run
  /// ended earlier, or never settled.
  std::optional<double> boresight_rms;
  std::optional<double> boresight_mean;
  std::optional<double> encoder_rms;
  /// Tracking: boresight rms by the linear design for the same wind and noise (rad at the sky).
  std::optional<double> predicted_rms;
  /// Slew: time from the end of the command until the encoder stays within a millidegree (s), and
  /// its largest error after the command's end (rad at the sky). The time is none if the encoder
  /// has not settled for the last 10 s.
  std::optional<double> settling_time;
  std::optional<double> overshoot;
};

/// Simulates 600 s of tracking at the mission's rate, after 60 s of settling. The wind is the
/// mission's measured wind, or without one wind of its design speed. The run uses the controller in
/// its sampled form (control::AntennaController: feedforward, anti-windup), all noise, friction,
/// orifices and lines. The controller's sample time is two thirds of the antenna's dead time: one
/// sample of computing plus half a sample of hold. An anemometer does not measure the wind gradient
/// over the dish. The gradient is therefore sampled from the site's spectrum at the record's mean
/// speed. Wind and noise depend on the seed.
/// @throws InvalidInput without Antenna::nonlinear, and as tracking_problem, constraints and
/// control::validate; NumericalFailure as run_loop.
PositionTestRecord run_tracking(const Mission& mission, const control::Controller& controller,
                                std::uint64_t seed, const RunProgress& progress);

/// Simulates a slew of one degree through the command preprocessor in still air, then 60 s of
/// holding. The rate is the mission's slew rate, or 0.8 times the rate that the supply sustains
/// against friction, if that is less. The acceleration is 0.2 deg/s2, or that from half the
/// supply's remaining torque at that rate, if that is less.
/// @throws as run_tracking, and InfeasibleRequirement if the supply cannot move the antenna.
PositionTestRecord run_slew(const Mission& mission, const control::Controller& controller,
                            std::uint64_t seed, const RunProgress& progress);

}  // namespace boresight::design
