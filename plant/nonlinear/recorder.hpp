#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <boresight/plant/nonlinear/recorder_filter.hpp>
#include <boresight/plant/nonlinear/sensor.hpp>

namespace boresight::plant {

/// The transducers at the motors' ports and their converters: alike, but each with a gain and zero
/// of its own.
struct PressureRecording {
  double gain_error = 0.0;  // relative, standard deviation over the transducers
  double zero_error = 0.0;  // Pa, alike
  double noise = 0.0;       // Pa, rms of a sample
  double resolution = 0.0;  // Pa, step of the converter; 0: none
  double range = std::numeric_limits<double>::infinity();  // Pa, from 0
};

/// A tachometer that is recorded in volts.
struct TachometerRecording {
  double scale = 0.0;       // motor rate per volt, rad/(s V)
  double limit = 0.0;       // V, in either direction
  double gain_error = 0.0;  // relative, standard deviation
  double noise = 0.0;       // V, rms of a sample
  double resolution = 0.0;  // V, step of the converter; 0: none
};

/// What writes the records of an antenna's tests.
struct Recorder {
  double sample_rate = 0.0;  // Hz
  LowPass low_pass;          // before the converter, of every channel
  PressureRecording pressure;
  TachometerRecording tachometer;
};

/// Transducers of the motors' ports (Pa) and the tachometer (rad/s of motor), each with its gain
/// and zero.
struct RecorderSensors {
  std::vector<Sensor> inlet;   // one a motor
  std::vector<Sensor> outlet;  // one a motor
  Sensor tachometer;
};

/// The sensors of so many motors, their gains and zeros normal by the recorder's errors: numbers of
/// stream 1000 of the seed, in the order inlet and outlet of each motor, tachometer.
RecorderSensors drawn_sensors(const Recorder& recorder, std::size_t motors, std::uint64_t seed);

}  // namespace boresight::plant
