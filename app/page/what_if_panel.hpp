#pragma once

#include <string>
#include <string_view>

namespace boresight::app {

/// HTML sliders over a table of boresight error rms, which is embedded as JSON
/// (what_if_description.hpp).
std::string what_if_panel(std::string_view what_if_json);

}  // namespace boresight::app
