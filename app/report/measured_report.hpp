#pragma once

#include <string>
#include <vector>

#include <boresight/app/document/document.hpp>
#include <boresight/app/tune/measured_section.hpp>

namespace boresight::io {
class Visitor;
}

namespace boresight::app {

/// What was measured, the laws, and what each rests on.
Document document_of(const MeasuredTuneSection& section);

/// "measured_tuning" of docs/report.schema.json.
void describe(io::Visitor& v, const MeasuredTuneSection& section);

/// A sentence a law.
std::vector<std::string> conclude(const MeasuredTuneSection& section);

}  // namespace boresight::app
