#pragma once

#include <boresight/app/tune/tune_section.hpp>

namespace boresight::io {
class Visitor;
}

namespace boresight::app {

/// "tuned" of docs/report.schema.json.
void describe(io::Visitor& v, const TuneSection& section);

}  // namespace boresight::app
