#pragma once

#include <string>
#include <vector>

#include <boresight/control/controllers/controller.hpp>
#include <boresight/io/exchange/controller_file.hpp>

namespace boresight::io {

/// A state space of a file as the antenna's computer runs it, with remarks on the conversion.
struct SampledControllerFile {
  control::Controller controller;  // control::state_space_controller, "state space, order N"
  std::vector<std::string> remarks;
};

/// Reads a state space as read_controller and takes it to the sample time (s): a continuous one by
/// Tustin's method. References and the rate command's ports rest at 0.
/// @throws InvalidInput naming the file, as read_controller; for another sample time, for one that
/// does not read tachometer and encoder, and for one that is not stable by itself: nothing would
/// keep its states from growing while the valve is at its limit.
SampledControllerFile read_sampled_controller(const std::string& path, double gear_ratio,
                                              double sample_time,
                                              const ControllerNames& names = {});
/// The same of what read_controller or parse_controller made of the file. `path` is for messages.
SampledControllerFile sampled_controller_of(ControllerFile file, const std::string& path,
                                            double sample_time);

}  // namespace boresight::io
