#include <CLI/CLI.hpp>

#include <boresight/app/commands/controller_option.hpp>

namespace boresight::app {

void add_controller(CLI::App& command, const std::string& subject, ControllerOptions& options) {
  command
      .add_option("--gains", options.gains,
                  subject +
                      ": 'tuned' (as `boresight tune` recommends, tuned now), 'case' (present "
                      "gains of the case), or a file: TOML with the keys of [gains], or the JSON "
                      "report of tune or redesign")
      ->capture_default_str();
  command.add_option("--structure", options.structure,
                     "its loop structure, as for `boresight tune` (default: any)");
  command.add_option("--controller", options.controller_path,
                     "any linear controller as state space, MAT (version 5) or JSON: see "
                     "docs/benchmark-protocol.md");
  command.add_option("--part", options.names.part,
                     "state space to use from a file of several (--mat or --json of model, "
                     "redesign, tune), such as controller, sampled_controller or "
                     "state_space_controller");
  command
      .add_option("--inputs", options.names.inputs,
                  "names of the controller's inputs, comma-separated, if its file has none")
      ->delimiter(',')
      ->allow_extra_args(false);
  command
      .add_option("--outputs", options.names.outputs, "names of the controller's outputs, likewise")
      ->delimiter(',')
      ->allow_extra_args(false);
}

}  // namespace boresight::app
