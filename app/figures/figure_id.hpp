#pragma once

#include <string>
#include <string_view>

namespace boresight::app {

/// A figure's id from words: lower-case letters, digits, and one hyphen for all between.
std::string figure_id(std::string_view words);

}  // namespace boresight::app
