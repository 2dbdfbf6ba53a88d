#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <boresight/app/simulate/drive_run.hpp>
#include <boresight/control/controllers/control_law.hpp>

namespace boresight::app {

/// The controller that a simulated position loop runs on.
struct SimulatedController {
  control::ControlLaw law;
  std::string source;  // of its gains, in words
};

/// The antenna under its position loop, in the time domain.
struct PositionRecord {
  std::string test;
  std::string description;
  control::ControlLaw controller;
  io::CsvTable record;
  bool complete = true;
  double duration = 0.0;     // s simulated
  double sample_time = 0.0;  // s of the record
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
  RunEvents events;
};

/// Tracks at the case's rate in wind of its design speed for 600 s after 60 s to settle: the law in
/// its sampled form (control::AntennaController: feedforward, anti-windup), all noise,
/// friction, orifices and lines. The controller's sample time is two thirds of the case's delay,
/// which is one sample of computing and half of one of holding. @throws as run_drive_test, and
/// InfeasibleRequirement for a slew if the supply cannot move the antenna.
PositionRecord run_tracking(const io::Case& antenna, const SimulatedController& controller,
                            std::uint64_t seed, const RunProgress& progress);

/// One degree through the command preprocessor, at the case's slew rate, or at 0.8 times what the
/// supply can hold against friction if that is less, and at 0.2 deg/s2, or with half the torque the
/// supply has left at that rate if that is less, in still air, then 60 s of holding.
PositionRecord run_slew(const io::Case& antenna, const SimulatedController& controller,
                        std::uint64_t seed, const RunProgress& progress);

}  // namespace boresight::app
