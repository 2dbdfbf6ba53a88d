#pragma once

#include <optional>
#include <string>

#include <boresight/control/controllers/control_law.hpp>
#include <boresight/design/studies/controller_study.hpp>
#include <boresight/io/campaign/designed_antenna.hpp>
#include <boresight/io/case/case_file.hpp>

namespace boresight::app {

/// A controller of Boresight's structures and where its gains come from, in words.
struct ChosenController {
  control::ControlLaw law;
  std::string structure;  // as the user names it
  std::string source;
};

/// A structure by the name that a ChosenController or a report has for it: in full ("PI with lag"),
/// short ("PI"), one of the case's own, or that of its present gains. @throws InvalidInput as
/// loop_structure.
control::LoopStructure structure_named(const io::Case& antenna, const std::string& name);

/// What the antenna runs on now: of [gains], or of the [[loop]] named `structure`.
/// @throws InvalidInput if the case has none.
ChosenController present_controller(const io::Case& antenna, const std::string& structure);

/// That of a report that `boresight tune` or `redesign` wrote as JSON, of `structure` unless that
/// is empty: of tune's io::recommended_row, whether it meets its goals or not.
/// @throws InvalidInput naming the file if there is none.
ChosenController controller_of_report(const io::Case& antenna, const std::string& path,
                                      const std::string& structure);

/// What the options --gains and --structure name: with "case" present_controller, with a path
/// controller_of_report; nothing with "tuned". @throws InvalidInput as they do
std::optional<ChosenController> named_controller(const io::Case& antenna, const std::string& gains,
                                                 const std::string& structure);

/// The controller that every command takes where none is named: the one recommended by
/// study_controllers; where none is fit for that, the least unfit that keeps the nominal antenna
/// stable.
/// @throws InfeasibleRequirement if no stable one is found; Interrupted; as study_controllers.
ChosenController recommended_controller(const io::DesignedAntenna& designed,
                                        const design::TuneOptions& options);

}  // namespace boresight::app
