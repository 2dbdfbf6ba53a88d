#pragma once

#include <string>
#include <string_view>

namespace boresight::app {

/// JSON as the content of a <script> element: no tag can begin in it.
std::string json_for_script(std::string_view json);

/// Text as a string of a style sheet, quotes included.
std::string css_string(std::string_view text);

}  // namespace boresight::app
