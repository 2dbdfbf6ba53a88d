#pragma once

#include <string>

#include <boresight/app/report/report.hpp>

namespace boresight::app {

/// The report as JSON (docs/report.schema.json): every key of a number with a unit ends in that
/// unit ("boresight_rms_mdeg"); infinite and undefined numbers are null.
std::string to_json(const Report& report);

}  // namespace boresight::app
