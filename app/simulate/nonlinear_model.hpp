#pragma once

#include <vector>

#include <boresight/app/simulate/recorder_filter.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/plant/nonlinear/nonlinear_antenna.hpp>
#include <boresight/plant/nonlinear/sensor.hpp>

namespace boresight::app {

// Tables of a case that simulated tests need: the first all, the others those that are recorded.
// @throws InvalidInput naming the table if there is none.
const io::SimulationEntry& simulation_of(const io::Case& antenna);
const io::RecorderEntry& recorder_of(const io::Case& antenna);

/// The tachometer's channel of the recorder.
struct RecorderTachometer {
  double scale = 0.0;  // motor rate per volt, rad/(s V)
  double limit = 0.0;  // V, in either direction
};
/// Of a tachometer on a shaft of its own, the motor's or the antenna's.
/// @throws InvalidInput naming what is missing: the table, its voltage or its recorder_limit
RecorderTachometer tachometer_of(const io::Case& antenna);

/// The nonlinear antenna of a case. Where the case names fewer lines than motors, those between
/// have lengths evenly between the shortest and the longest.
/// @throws InvalidInput naming the table that the case lacks.
plant::NonlinearAntenna make_nonlinear_antenna(const io::Case& antenna);

/// The same for tests that are recorded: pressures are read at the motors' ends of the oil lines.
/// @throws InvalidInput without lines, too
plant::NonlinearAntenna make_recorded_antenna(const io::Case& antenna);

/// Transducers of one motor's ports (Pa) and the tachometer (rad/s of motor), each with the gain
/// and zero that the seed draws for it.
struct RecorderSensors {
  std::vector<plant::Sensor> inlet;
  std::vector<plant::Sensor> outlet;
  plant::Sensor tachometer;
};
RecorderSensors make_sensors(const io::Case& antenna, std::size_t motors, std::uint64_t seed);

/// The low-pass before the recorder's converter; order 0 without one.
LowPass low_pass_of(const io::Case& antenna);

/// Motor rate per tachometer volt (rad/(s V)), eq. 32 of Sommerville. @throws InvalidInput as
/// tachometer_of does
double tachometer_scale(const io::Case& antenna);

}  // namespace boresight::app
