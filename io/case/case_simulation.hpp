#pragma once

#include <optional>

#include <boresight/io/units/quantity.hpp>

namespace boresight::io {

/// Quantities that the linear plant omits and `boresight simulate` needs, all motors at the motor
/// shaft.
struct SimulationEntry {
  Quantity return_pressure;
  Quantity null_leakage_share, case_leakage_share;
  Quantity valve_stroke;            // no-load motor speed with the valve fully open
  bool valve_stroke_stated = true;  // else by the valve's rated flow, or assumed
  Quantity valve_stroke_time;       // from centre to fully open
  Quantity valve_overlap;           // fraction of the stroke
  Quantity bristle_stiffness, bristle_damping;
  Quantity line_damping_ratio;
  Quantity makeup_pressure;
  Quantity air_fraction;
  Quantity offset_torque;
  std::optional<Quantity> offset_cosine, offset_sine;  // by the elevation; else 0
  Quantity preload_torque;
  std::optional<Quantity> backlash;           // of the motor; else none
  Quantity rate_loop_gain, rate_loop_corner;  // the analog rate loop of the tests
};

/// Properties of the antenna's recorder.
struct RecorderEntry {
  Quantity sample_rate;
  Quantity pressure_gain, pressure_zero, pressure_noise, pressure_resolution, pressure_range;
  Quantity tachometer_gain, tachometer_noise, tachometer_resolution;
  long filter_order = 0;                     // of the low-pass before the converter; 0: none
  std::optional<Quantity> filter_frequency;  // its corner
};

}  // namespace boresight::io
