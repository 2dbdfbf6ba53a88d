#pragma once

#include <optional>
#include <string>

#include <boresight/identification/records/drive_record.hpp>

namespace boresight::identification {

/// What an antenna's computer or a recorder wrote of its servo while it pointed: evenly sampled,
/// SI, every signal with the same number of samples. Signals that were not recorded are absent.
struct ServoRecord {
  std::string name;
  double sample_time = 0.0;                // s
  std::optional<Signal> position_command;  // rad at the sky
  std::optional<Signal> encoder;           // rad at the sky
  std::optional<Signal> position_error;    // rad at the sky, position command less encoder
  std::optional<Signal> boresight_error;   // rad at the sky
  std::optional<Signal> rate_command;      // rad/s of motor
  std::optional<Signal> motor_rate;        // rad/s of motor
  std::optional<Signal> valve_command;     // rad/s of no-load motor speed
  std::optional<Signal> motor_torque;      // N m, of all motors, by the pressure difference
  std::optional<Signal> wind_speed;        // m/s
  std::optional<Signal> wind_direction;    // rad, continuous through full turns
};

}  // namespace boresight::identification
