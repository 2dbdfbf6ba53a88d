#include <array>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <boresight/app/document/document_html.hpp>
#include <boresight/app/page/html_text.hpp>
#include <boresight/app/page/what_if_panel.hpp>

namespace boresight::app {
namespace {

struct Slider {
  const char* name = "";
  const char* label = "";
};

constexpr std::array<Slider, 4> sliders{{{"disks", "flywheel disks on each motor"},
                                         {"leakage", "leakage rate"},
                                         {"friction", "friction slope at the motors"},
                                         {"wind", "mean wind speed"}}};

}  // namespace

std::string what_if_panel(std::string_view what_if_json) {
  const auto table = nlohmann::json::parse(what_if_json);
  std::string html =
      "<p class=\"what-if-needs-script only-screen\">The sliders need JavaScript. The same table "
      "is in the JSON report, under <code>matched.what_if</code>.</p>\n<div class=\"sliders "
      "what-if\" "
      "id=\"what-if-panel\" role=\"group\" aria-label=\"What if\" hidden=\"\">\n<div "
      "class=\"knobs\">\n<label>loop structure <select name=\"structure\">";
  for (const auto& name : table.at("structures")) {
    html += fmt::format("<option>{}</option>", escaped_html(name.get<std::string>()));
  }
  html += "</select></label>\n";
  for (const auto& slider : sliders) {
    html += fmt::format(
        "<label>{} <output></output><input type=\"range\" name=\"{}\" min=\"0\" max=\"1\" "
        "step=\"0.1\" value=\"0\"></label>\n",
        slider.label, slider.name);
  }
  html +=
      "</div>\n<div aria-live=\"polite\"><p class=\"answer\"></p>\n<ul "
      "class=\"verdicts\"></ul>\n<svg class=\"curve\" viewBox=\"0 0 520 275\" font-size=\"12\" "
      "role=\"img\" aria-label=\"boresight rms against flywheel disks\"></svg></div>\n";
  html += fmt::format(
      "<p class=\"note\">Each controller has fixed gains, tuned robustly for its number of disks "
      "in {:.3g} m/s; the sliders change plant and wind. The {} entries hold for the linear plant; "
      "the logarithm of the rms is interpolated in disks, leakage, friction slope and log wind "
      "speed. A verdict is the worst of the surrounding entries. The friction slope at the "
      "tracking rate is {:g} N m s/rad. Grey: the other structures.</p>\n",
      table.at("start").at("wind_speed_m_per_s").get<double>(),
      table.at("boresight_rms_mdeg").size(),
      table.at("friction_slope_at_tracking_rate_N_m_s_per_rad").get<double>());
  return html +
         fmt::format("<script type=\"application/json\" class=\"data\">{}</script>\n</div>\n",
                     json_for_script(what_if_json));
}

}  // namespace boresight::app
