#include <algorithm>

#include <fmt/format.h>

#include <boresight/numerics/error.hpp>
#include <boresight/plant/integration/feedback_interconnection.hpp>

namespace boresight::plant {
namespace {

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

}  // namespace

FeedbackSystem closed(const FeedbackSystem& system, const StateSpace& controller) {
  feedback_matrices(system);  // refuses what is wrong with it
  const auto& linear = system.linear;
  const auto channels_begin = linear.inputs.end() - system.channel_outputs;
  const auto observed_begin = linear.outputs.begin() + system.channel_inputs;
  if (controller.sample_time != 0.0) {
    throw InvalidInput(
        fmt::format("closed: expected a continuous controller, found one sampled at {} s",
                    controller.sample_time));
  }
  for (const auto& output : controller.outputs) {
    if (std::find(linear.inputs.begin(), channels_begin, output) == channels_begin) {
      throw InvalidInput(
          fmt::format("closed: expected outputs of the controller that are inputs of the system, "
                      "found '{}'",
                      output));
    }
  }
  std::vector<std::string> inputs;
  for (auto name = linear.inputs.begin(); name != channels_begin; ++name) {
    if (!contains(controller.outputs, *name)) inputs.push_back(*name);
  }
  for (const auto& name : controller.inputs) {
    const bool fed = std::find(observed_begin, linear.outputs.end(), name) != linear.outputs.end();
    if (!fed && !contains(inputs, name)) inputs.push_back(name);
  }
  inputs.insert(inputs.end(), channels_begin, linear.inputs.end());
  std::vector<std::string> outputs = linear.outputs;
  outputs.insert(outputs.end(), controller.outputs.begin(), controller.outputs.end());
  return {connect({linear, controller}, inputs, outputs), system.channel_outputs,
          system.channel_inputs, system.channels};
}

}  // namespace boresight::plant
