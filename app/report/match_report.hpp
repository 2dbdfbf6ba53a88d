#pragma once

#include <string>

#include <boresight/app/document/document.hpp>
#include <boresight/app/match/match_section.hpp>

namespace boresight::io {
class Visitor;
}

namespace boresight::app {

/// The section of the report.
Document document_of(const MatchSection& section);
/// One controller on the case's plant, the loop opened at one place.
struct MatchMargins {
  control::LoopBreak loop_break = control::LoopBreak::valve_command;
  control::Margins margins;
};
void describe(io::Visitor& v, const MatchMargins& cut);

/// "matched" of docs/report.schema.json.
void describe(io::Visitor& v, const MatchSection& section);

}  // namespace boresight::app
