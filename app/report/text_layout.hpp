#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace boresight::app {

/// "\nTITLE\n-----\n"
std::string heading(std::string_view title);

/// Breaks a paragraph at blanks to at most 108 columns, each line behind `indent`, all but the
/// first behind `hanging` too.
std::string wrapped(std::string_view paragraph, std::string_view indent,
                    std::string_view hanging = {});

/// A table with a header row, two blanks between columns, each to the left ('l') or right ('r') by
/// its letter in `alignment`; columns beyond it to the right. Columns count characters, not bytes.
std::string table(const std::vector<std::vector<std::string>>& rows,
                  std::string_view alignment = "l");

}  // namespace boresight::app
