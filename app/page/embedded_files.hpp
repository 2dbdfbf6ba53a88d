#pragma once

#include <string_view>

namespace boresight::app {

// Files that a page is made of, in the program itself.
std::string_view page_style();      // page.css
std::string_view figures_script();  // figures.js
std::string_view what_if_script();  // what_if.js
/// matrices.js, loop_model.js, loop_analysis.js and loop_sliders.js.
std::string_view loop_sliders_script();
/// Plotly's basic bundle (web/package.json); empty in a program built without it.
std::string_view plotting_library();

}  // namespace boresight::app
