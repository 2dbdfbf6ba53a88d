#pragma once

#include <string>
#include <string_view>

namespace boresight::app {

/// Sliders over gains, wind and drive of a loop, as JSON writes it
/// (adjustable_loop_description.hpp): HTML with the loop in it, for loop_sliders.js.
std::string loop_sliders_panel(std::string_view loop_json);

}  // namespace boresight::app
