#pragma once

#include <boresight/app/report/report.hpp>

namespace boresight::io {
class Visitor;
}

namespace boresight::app {

/// "identification" and "plant" of docs/report.schema.json.
void describe(io::Visitor& v, const IdentificationSection& section);
void describe(io::Visitor& v, const PlantSection& section);

}  // namespace boresight::app
