#pragma once

#include <string>

#include <boresight/control/controllers/controller.hpp>
#include <boresight/io/case/case_declaration.hpp>

namespace boresight::io {

/// A controller that a report in JSON holds.
struct ReportedController {
  control::Controller controller;
  std::string structure;  // as the report names it
  std::string tuned_for;  // "nominal" or "robust"; empty: the report is of one controller
};

/// A structure by any name that a report may have for it: in full ("PI with lag"), short ("PI"),
/// one of the case's own, or that of its present gains. @throws InvalidInput as loop_structure.
control::LoopStructure structure_named(const Case& antenna, const std::string& name);

/// The controller of a JSON report by `boresight tune` or `redesign`, of `structure` unless that is
/// empty, from the gains of its design in SI. Among tune's controllers, the first wind speed with a
/// stable one is used. There the one that the report recommends is returned. If the report
/// recommends none of these, design::recommend chooses by the report's data, whether constraints
/// are met or not. Data missing in an older report, such as its verification, count as good;
/// keys of version 0.1 are read (use_present_keys).
/// @throws InvalidInput naming the file if there is none.
ReportedController controller_of_report(const Case& antenna, const std::string& path,
                                        const std::string& structure);

/// The same of the text of tune's report, of one that meets its goals on every plant, by the gains
/// as they are written for an engineer: in the case's units and digits.
/// @throws InvalidInput naming the path.
ReportedController written_controller_of_report(const Case& antenna, const std::string& text,
                                                const std::string& path,
                                                const std::string& structure);

}  // namespace boresight::io
