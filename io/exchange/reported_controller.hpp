#pragma once

#include <string>

#include <boresight/control/controllers/controller.hpp>
#include <boresight/design/decisions/assessment.hpp>
#include <boresight/io/case/case_declaration.hpp>

namespace boresight::io {

/// The controller of a file that holds gains.
struct GainsOfFile {
  control::Controller controller;
  std::string structure;  // as the file names it
  std::string tuned_for;  // "nominal" or "robust"; empty: the file is of one controller
};

/// A structure by any name that a report may have for it: in full ("PI with lag"), short ("PI"),
/// one of the case's own, or that of its present gains. @throws InvalidInput as loop_structure.
control::LoopStructure structure_named(const Case& antenna, const std::string& name);

/// The controller of a JSON report (`text`) by `boresight tune` or `redesign`, of `structure`
/// unless that is empty, from the gains of its design in SI. Among tune's controllers, the first
/// wind speed with one of at least the fitness `accepted` is used. There the one that the report
/// recommends is returned. If the report recommends none of these, design::recommend chooses by the
/// report's data. Data missing in an older report, such as its verification, count as good; keys of
/// version 0.1 are read (use_present_keys).
/// @throws InvalidInput naming the file (`path`) if there is none.
GainsOfFile controller_of_report(const Case& antenna, const std::string& text,
                                 const std::string& path, const std::string& structure,
                                 design::Fitness accepted = design::Fitness::unverified);

}  // namespace boresight::io
