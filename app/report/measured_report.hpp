#pragma once

#include <string>
#include <vector>

#include <boresight/app/document/document.hpp>
#include <boresight/app/tune/measured_section.hpp>

namespace boresight::io {
class Visitor;
}

namespace boresight::app {

/// The measurements, the controllers, and the assumptions of each.
Document document_of(const MeasuredTuneSection& section);

/// "measured_tuning" of docs/report.schema.json.
void describe(io::Visitor& v, const MeasuredTuneSection& section);

/// One sentence per controller.
std::vector<std::string> conclude(const MeasuredTuneSection& section);

}  // namespace boresight::app
