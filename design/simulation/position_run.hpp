#pragma once

#include <cstdint>
#include <optional>

#include <boresight/control/controllers/control_law.hpp>
#include <boresight/design/problem/mission.hpp>
#include <boresight/design/simulation/simulated_record.hpp>

namespace boresight::design {

/// The gusts of a measured wind.
struct MeasuredGusts {
  double rms = 0.0;          // m/s, about the mean speed
  double sample_time = 0.0;  // s
};

/// What a simulated antenna tracked, and in which wind.
struct TrackingCourse {
  double rate = 0.0;             // rad/s at the sky
  double mean_wind_speed = 0.0;  // m/s
  plant::WindModel wind_model = plant::WindModel::coherence;
  plant::GustSpectrumKind spectrum = plant::GustSpectrumKind::davenport;
  std::optional<MeasuredGusts> measured;  // of Mission::wind_record
};

/// How a simulated antenna slewed. At the sky.
struct SlewCourse {
  double distance = 0.0;      // rad
  double largest_rate = 0.0;  // rad/s, of the command
  double acceleration = 0.0;  // rad/s2, of the command
  double wanted_rate = 0.0;   // rad/s
  double attainable = 0.0;    // rad/s, up to the wanted one: attainable_rate
};

/// The antenna under its position loop, in the time domain. Channels: time, reference (deg),
/// encoder_error and beam_error (mdeg), all at the sky; motor_rate, motor_torque, valve_command,
/// wind_torque_at_motor.
struct PositionTestRecord : SimulatedRecord {
  control::ControlLaw controller;
  /// What was done: one of them.
  std::optional<TrackingCourse> tracking;
  std::optional<SlewCourse> slew;
  /// Of the beam's error about its mean, once settled (rad at the sky); the mean is the bending of
  /// the structure under the mean wind, which calibration takes out. None if the run did not get
  /// that far, or never settled.
  std::optional<double> beam_rms;
  std::optional<double> beam_mean;
  std::optional<double> encoder_rms;
  /// Tracking: beam rms the linear design predicts for the same wind and noise (rad at the sky).
  std::optional<double> predicted_rms;
  /// Slew: time from the end of the command until the encoder stays within a millidegree (s), none
  /// if it does not for the last 10 s, and its largest error after the command's end (rad at the
  /// sky).
  std::optional<double> settling_time;
  std::optional<double> overshoot;
};

/// Tracks at the mission's rate in its measured wind, or without one in wind of its design speed
/// for 600 s, after 60 s to settle: the law in its sampled form (control::AntennaController:
/// feedforward, anti-windup), all noise, friction, orifices and lines. The controller's sample time
/// is two thirds of the antenna's dead time, which is one sample of computing and half of one of
/// holding. The gradient over the dish, which an anemometer does not see, is drawn from the site's
/// spectrum at the record's mean speed. Wind and noise are the seed's.
/// @throws InvalidInput without Antenna::nonlinear, and as tracking_problem, constraints and
/// control::validate; NumericalFailure as run_loop.
PositionTestRecord run_tracking(const Mission& mission, const control::ControlLaw& law,
                                std::uint64_t seed, const RunProgress& progress);

/// One degree through the command preprocessor, at the mission's slew rate, or at 0.8 times what
/// the supply can hold against friction if that is less, and at 0.2 deg/s2, or with half the torque
/// the supply has left at that rate if that is less, in still air, then 60 s of holding.
/// @throws as run_tracking, and InfeasibleRequirement if the supply cannot move the antenna.
PositionTestRecord run_slew(const Mission& mission, const control::ControlLaw& law,
                            std::uint64_t seed, const RunProgress& progress);

}  // namespace boresight::design
