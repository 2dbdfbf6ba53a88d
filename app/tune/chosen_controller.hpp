#pragma once

#include <optional>
#include <string>

#include <boresight/control/controllers/controller.hpp>
#include <boresight/design/studies/controller_study.hpp>
#include <boresight/io/campaign/designed_antenna.hpp>
#include <boresight/io/case/case_declaration.hpp>
#include <boresight/io/exchange/controller_file.hpp>

namespace boresight::app {

/// A controller and where it comes from, in words.
struct ChosenController {
  control::Controller controller;
  std::string structure;  // as the user names it
  std::string source;
};

/// What a command line names. With a path of a state space, nothing else is named.
struct ControllerOptions {
  std::string gains = "tuned";  // "tuned", "case", or a path for io::read_gains_file
  std::string structure;        // empty: any
  std::string controller_path;  // of a state space; empty: none
  io::ControllerNames names;    // of that file

  bool recommended() const { return controller_path.empty() && gains == "tuned"; }
  /// @throws InvalidInput for --controller beside --gains or --structure, and for --part, --inputs
  /// or --outputs without --controller.
  void validate() const;
};

/// What the antenna runs on now: of [gains], or of the [[loop]] named `structure`.
/// @throws InvalidInput if the case has none.
ChosenController present_controller(const io::Case& antenna, const std::string& structure);

/// The controller of a command line: with "case" present_controller, with a path of gains
/// io::read_gains_file, with one of a state space io::read_sampled_controller at the sample time of
/// the antenna's computer; nothing if recommended().
/// @throws InvalidInput as they do; InfeasibleRequirement for a state space that is not stable on
/// the nominal antenna, with the factor of its output at which it is.
std::optional<ChosenController> named_controller(const io::Case& antenna,
                                                 const ControllerOptions& options);

/// The controller that every command takes where none is named: the one recommended by
/// study_controllers; where none is fit for that, the least unfit that keeps the nominal antenna
/// stable. `structure`: the only one to be tuned, as --structure names it; empty: those of
/// `options`.
/// @throws InvalidInput as structure_option; InfeasibleRequirement if no stable one is found;
/// Interrupted; as study_controllers.
ChosenController recommended_controller(const io::DesignedAntenna& designed,
                                        const std::string& structure, design::TuneOptions options);

}  // namespace boresight::app
