#pragma once

#include <vector>

#include <boresight/app/report/report.hpp>

namespace boresight::io {
class Visitor;
}

namespace boresight::app {

/// "tuning" of docs/report.schema.json.
void describe(io::Visitor& v, const TuningSection& section);
/// "interpretations" of docs/report.schema.json.
void describe_interpretations(io::Visitor& v,
                              const std::vector<InterpretationResult>& interpretations);
/// "matching" of docs/report.schema.json.
void describe_matching(io::Visitor& v, const MatchingSection& section);

}  // namespace boresight::app
