#pragma once

#include <string>

#include <boresight/app/report/report.hpp>

namespace boresight::app {

/// The report as JSON (docs/report.schema.json): every key of a number with a unit ends in that
/// unit ("beam_rms_mdeg"); infinite and undefined numbers are null.
std::string to_json(const Report& report);

/// Writes a file whole or not at all: to a temporary beside it, then renamed.
/// @throws InvalidInput if that is not possible.
void write_atomically(const std::string& path, const std::string& content);

/// @throws InvalidInput if write_atomically could not write there now. Leaves nothing behind.
void require_writable(const std::string& path);

}  // namespace boresight::app
