#pragma once

#include <span>
#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

namespace boresight::io {

/// A key of JSON reports, whole, with its unit: of version 0.1 and now.
struct RenamedKey {
  std::string_view before;
  std::string_view now;
};

/// All keys that version 0.1 had under other names, in alphabetical order of these. Kept for one
/// version.
std::span<const RenamedKey> renamed_keys();

/// Gives the objects of a report, at any depth, the present keys, in place, in their order. A key
/// stays where its object has the present one too. Where anything was renamed, notes one warning
/// (note_warning) that names the file and each key with its present name.
void use_present_keys(nlohmann::ordered_json& report, const std::string& path);

}  // namespace boresight::io
