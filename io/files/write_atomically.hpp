#pragma once

#include <string>

namespace boresight::io {

/// Writes a file atomically: to a temporary file in the same folder, then renamed.
/// @throws InvalidInput if that is not possible.
void write_atomically(const std::string& path, const std::string& content);

/// @throws InvalidInput if write_atomically could not write there now. Leaves nothing behind.
void require_writable(const std::string& path);

}  // namespace boresight::io
