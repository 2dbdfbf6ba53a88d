#pragma once

#include <nlohmann/json_fwd.hpp>

#include <boresight/app/audit/audit_report.hpp>

namespace boresight::app {

/// The audit as a JSON object; each number's unit stands in a key beside it, "unit", since the
/// audited quantities have many.
nlohmann::ordered_json audit_json(const AuditReport& report);

}  // namespace boresight::app
