#pragma once

#include <string>

#include <boresight/app/document/document.hpp>
#include <boresight/app/match/match_section.hpp>
#include <boresight/app/report/json_design.hpp>

namespace boresight::app {

/// The section of the report.
Document document_of(const MatchSection& section);
/// "matched" of docs/report.schema.json.
Json match_json(const MatchSection& section);

}  // namespace boresight::app
