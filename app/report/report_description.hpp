#pragma once

#include <boresight/app/report/report.hpp>

namespace boresight::io {
class Visitor;
}

namespace boresight::app {

/// The report of a command: docs/report.schema.json.
void describe(io::Visitor& v, const Report& report);

}  // namespace boresight::app
