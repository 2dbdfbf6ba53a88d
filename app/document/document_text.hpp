#pragma once

#include <string>

#include <boresight/app/document/document.hpp>

namespace boresight::app {

/// The document for a terminal, in UTF-8. A heading has a blank line before and a rule below it;
/// paragraphs are broken to at most 108 columns where their words allow it; tables are as wide as
/// they need, two blanks between columns. Columns count characters, not bytes.
std::string to_text(const Document& document);

}  // namespace boresight::app
