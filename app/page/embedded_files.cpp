#include <boresight/app/page/embedded_files.hpp>

// Laid down by embedded_files.S.
extern "C" {
extern const char boresight_page_css[], boresight_page_css_end[];
extern const char boresight_figures_js[], boresight_figures_js_end[];
extern const char boresight_what_if_js[], boresight_what_if_js_end[];
extern const char boresight_loop_sliders_js[], boresight_loop_sliders_js_end[];
extern const char boresight_plotly_js[], boresight_plotly_js_end[];
}

namespace boresight::app {
namespace {

std::string_view between(const char* begin, const char* end) {
  return {begin, static_cast<std::size_t>(end - begin)};
}

}  // namespace

std::string_view page_style() {
  return between(boresight_page_css, boresight_page_css_end);
}

std::string_view figures_script() {
  return between(boresight_figures_js, boresight_figures_js_end);
}

std::string_view what_if_script() {
  return between(boresight_what_if_js, boresight_what_if_js_end);
}

std::string_view loop_sliders_script() {
  return between(boresight_loop_sliders_js, boresight_loop_sliders_js_end);
}

std::string_view plotting_library() {
  return between(boresight_plotly_js, boresight_plotly_js_end);
}

}  // namespace boresight::app
