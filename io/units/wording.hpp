#pragma once

#include <span>
#include <string>
#include <string_view>

namespace boresight::io {

/// Text from outside as a message shows it: in single quotes, control characters and bytes that are
/// not UTF-8 as a backslash, x and two digits, cut after 60 characters. Keeps a hostile file from
/// driving the terminal.
std::string in_quotes(std::string_view text);

/// Characters (code points) of a UTF-8 text. A stray byte counts as one or none, never fails.
int character_count(std::string_view text);

/// "a length", "an inertia".
std::string with_article(std::string_view name);

/// The known name closest to a misspelt one: equal except for case, else within a third of its
/// letters (at least one, at most three) by insertion, deletion, replacement or swap of neighbours.
/// Empty if none is near; the first of several equally near.
std::string_view nearest_name(std::string_view misspelt, std::span<const std::string_view> known);

}  // namespace boresight::io
