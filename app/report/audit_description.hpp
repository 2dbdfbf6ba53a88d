#pragma once

#include <boresight/app/audit/audit_report.hpp>

namespace boresight::io {
class Visitor;
}

namespace boresight::app {

/// "audit" of docs/report.schema.json; each number's unit stands in a key beside it, "unit", since
/// the audited quantities have many.
void describe(io::Visitor& v, const AuditReport& report);

}  // namespace boresight::app
