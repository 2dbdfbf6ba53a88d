#pragma once

#include <string>

#include <boresight/app/tune/chosen_controller.hpp>

namespace CLI {
class App;
}

namespace boresight::app {

/// The options that name a controller: --gains, --structure, and --controller with --part, --inputs
/// and --outputs. `subject` begins the description of the first, such as "the controller".
void add_controller(CLI::App& command, const std::string& subject, ControllerOptions& options);

}  // namespace boresight::app
