#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace boresight::app {

/// How wide a text is in DejaVu Sans of `size` pixels, the widest of the usual sans serif faces:
/// what has room by this has room in any of them.
double text_width(std::string_view text, double size);

/// Breaks a text at blanks to at most `width`; a word that is wider has a line of its own.
std::vector<std::string> text_lines(std::string_view text, double width, double size);

}  // namespace boresight::app
