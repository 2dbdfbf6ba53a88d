#pragma once

#include <string>
#include <string_view>

namespace boresight::app {

/// The sliders over a table of beam rms, as JSON writes it (what_if_description.hpp): HTML with the
/// table in it.
std::string what_if_panel(std::string_view what_if_json);

}  // namespace boresight::app
