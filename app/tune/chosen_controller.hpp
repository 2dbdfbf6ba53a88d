#pragma once

#include <optional>
#include <string>

#include <boresight/control/controllers/controller.hpp>
#include <boresight/design/studies/controller_study.hpp>
#include <boresight/io/campaign/designed_antenna.hpp>
#include <boresight/io/case/case_declaration.hpp>

namespace boresight::app {

/// A controller of Boresight's structures and where its gains come from, in words.
struct ChosenController {
  control::Controller controller;
  std::string structure;  // as the user names it
  std::string source;
};

/// What the antenna runs on now: of [gains], or of the [[loop]] named `structure`.
/// @throws InvalidInput if the case has none.
ChosenController present_controller(const io::Case& antenna, const std::string& structure);

/// What the options --gains and --structure name: with "case" present_controller, with a path
/// io::controller_of_report; nothing with "tuned". @throws InvalidInput as they do
std::optional<ChosenController> named_controller(const io::Case& antenna, const std::string& gains,
                                                 const std::string& structure);

/// The controller that every command takes where none is named: the one recommended by
/// study_controllers; where none is fit for that, the least unfit that keeps the nominal antenna
/// stable.
/// @throws InfeasibleRequirement if no stable one is found; Interrupted; as study_controllers.
ChosenController recommended_controller(const io::DesignedAntenna& designed,
                                        const design::TuneOptions& options);

}  // namespace boresight::app
