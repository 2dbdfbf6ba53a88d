#pragma once

#include <vector>

#include <boresight/app/io/case_file.hpp>
#include <boresight/app/simulate/recorder_filter.hpp>
#include <boresight/plant/nonlinear_antenna.hpp>
#include <boresight/plant/sensor.hpp>

namespace boresight::app {

// Tables of a case that simulated tests need. @throws InvalidInput naming the table if there is
// none.
const SimulationEntry& simulation_of(const Case& antenna);
const RecorderEntry& recorder_of(const Case& antenna);
const TachometerEntry& tachometer_of(const Case& antenna);

/// The nonlinear antenna of a case. Where the case names fewer lines than motors, those between
/// have lengths evenly between the shortest and the longest.
/// @throws InvalidInput naming the table that the case lacks.
plant::NonlinearAntenna make_nonlinear_antenna(const Case& antenna);

/// Transducers of one motor's ports (Pa) and the tachometer (rad/s of motor), each with the gain
/// and zero that the seed draws for it.
struct RecorderSensors {
  std::vector<plant::Sensor> inlet;
  std::vector<plant::Sensor> outlet;
  plant::Sensor tachometer;
};
RecorderSensors make_sensors(const Case& antenna, std::size_t motors, std::uint64_t seed);

/// The low-pass before the recorder's converter; order 0 without one.
LowPass low_pass_of(const Case& antenna);

/// Motor rate per tachometer volt (rad/(s V)), eq. 32 of Sommerville. @throws InvalidInput without
/// a tachometer table.
double tachometer_scale(const Case& antenna);

}  // namespace boresight::app
