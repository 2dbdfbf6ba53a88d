#pragma once

#include <optional>
#include <string>

#include <boresight/io/case/case_declaration.hpp>
#include <boresight/io/units/quantity.hpp>

namespace boresight::io {

/// A derived number printed in the source, for the audit.
struct StatedEntry {
  std::string quantity;  // id, see docs/case-file.md
  Quantity value;
};

/// The author's notes on the source: equations, captions, conventions.
struct RemarkEntry {
  std::string place;
  std::string text;
};

/// The kind of a stated quantity's id ("reflected_inertia" is an inertia), from the closed list of
/// docs/case-file.md; nothing for an unknown id.
std::optional<Kind> stated_kind(const std::string& id, const Case& antenna);

}  // namespace boresight::io
