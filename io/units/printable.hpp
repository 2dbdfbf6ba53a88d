#pragma once

#include <cstddef>
#include <string_view>

namespace boresight::io {

/// Bytes of the printable UTF-8 character that begins at a place of the text; 0 if there is none: a
/// control character, also line end and tab, or a byte that is not UTF-8.
std::size_t printable_length(std::string_view text, std::size_t place);

}  // namespace boresight::io
