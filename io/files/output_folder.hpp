#pragma once

#include <filesystem>
#include <string>

namespace boresight::io {

/// A folder to write to, made with those above it if it is not there. `what`: the files, in words.
/// @throws InvalidInput if it cannot be made.
std::filesystem::path output_folder(const std::filesystem::path& folder, const std::string& what);

}  // namespace boresight::io
