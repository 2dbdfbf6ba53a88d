#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/control/controllers/sensor_response.hpp>
#include <boresight/io/exchange/sampled_controller_file.hpp>
#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/linear/interconnection.hpp>
#include <boresight/plant/linear/sampling.hpp>

namespace boresight::io {

SampledControllerFile read_sampled_controller(const std::string& path, double gear_ratio,
                                              double sample_time, const ControllerNames& names) {
  return sampled_controller_of(read_controller(path, gear_ratio, names), path, sample_time);
}

SampledControllerFile sampled_controller_of(ControllerFile file, const std::string& path,
                                            double sample_time) {
  std::vector<std::string> sensors;
  for (const char* sensor : control::sensor_names) {
    if (std::ranges::count(file.system.inputs, sensor) > 0) sensors.emplace_back(sensor);
  }
  if (sensors.size() < 2 || sensors[0] != "tachometer" || sensors[1] != "encoder") {
    throw InvalidInput(
        fmt::format("{}: expected a controller that reads tachometer and encoder, "
                    "found one that reads {}",
                    path, fmt::join(sensors, " and ")));
  }
  plant::StateSpace system = plant::subsystem(file.system, sensors, {"valve_demand"});
  if (system.sample_time == 0.0) {
    system = plant::sample(system, sample_time, plant::SamplingMethod::tustin);
    file.remarks.push_back(fmt::format(
        "the continuous controller is sampled every {:g} s by Tustin's method", sample_time));
  } else if (!(std::abs(system.sample_time - sample_time) <= 1e-9 * sample_time)) {
    throw InvalidInput(
        fmt::format("{}: expected the sample time of the antenna's computer, {:g} s "
                    "([controller] delay over 1.5), found {:g} s",
                    path, sample_time, system.sample_time));
  }
  const double radius = numerics::spectral_radius(system.a);
  if (!(radius < 1.0)) {
    throw InvalidInput(
        fmt::format("{}: expected a controller that is stable by itself, found a "
                    "pole of magnitude {:.9g}; give loops with integrals by their "
                    "gains",
                    path, radius));
  }
  system.sample_time = sample_time;
  return {control::state_space_controller(fmt::format("state space, order {}", system.a.rows()),
                                          system),
          std::move(file.remarks)};
}

}  // namespace boresight::io
