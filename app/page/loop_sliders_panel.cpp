#include <array>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <boresight/app/document/document_html.hpp>
#include <boresight/app/page/html_text.hpp>
#include <boresight/app/page/loop_sliders_panel.hpp>

namespace boresight::app {
namespace {

struct SettingSlider {
  const char* key = "";    // of a setting in loop_model.js
  const char* group = "";  // where the loop has its value
  const char* member = "";
  const char* label = "";
  const char* unit = "";
  double span = 1.0;  // largest factor up and down
};

constexpr std::array<SettingSlider, 4> setting_sliders{
    {{"wind_speed", "wind", "mean_speed_m_per_s", "mean wind speed", "m/s", 2.5},
     {"oil_stiffness", "drive", "oil_stiffness_N_m_per_rad", "oil stiffness", "N m/rad", 3.0},
     {"leakage_rate", "drive", "leakage_rate_per_s", "leakage rate", "1/s", 5.0},
     {"viscous_friction", "drive", "viscous_friction_N_m_s_per_rad", "friction slope", "N m s/rad",
      5.0}}};

constexpr double gain_span = 8.0;

std::string slider(std::string_view label, std::string_view place, std::string_view unit,
                   double span) {
  return fmt::format(
      "<label>{} <output></output><input type=\"range\" min=\"-1\" max=\"1\" step=\"0.01\" "
      "value=\"0\" data-span=\"{}\" data-unit=\"{}\" {}></label>\n",
      escaped_html(label), span, escaped_html(unit), place);
}

std::string gain_sliders(const nlohmann::json& loop) {
  std::string html;
  std::size_t next = 0;
  for (const auto& block : loop.at("blocks")) {
    for (const auto& gain : block.at("gains")) {
      const auto unit = gain.at("unit").get<std::string>();
      html += slider(gain.at("name").get<std::string>(), fmt::format("data-gain=\"{}\"", next++),
                     unit == "1" ? "" : unit, gain_span);
    }
  }
  return html;
}

}  // namespace

std::string loop_sliders_panel(std::string_view loop_json) {
  const auto loop = nlohmann::json::parse(loop_json);
  std::string html =
      "<p class=\"loop-sliders-needs-script only-screen\">The sliders need JavaScript.</p>\n<div "
      "class=\"sliders loop-sliders\" role=\"group\" aria-label=\"Change gains, wind and drive\" "
      "hidden=\"\">\n<div class=\"knobs\">\n<h3>Gains</h3>\n" +
      gain_sliders(loop) + "<h3>Wind and drive</h3>\n";
  for (const auto& one : setting_sliders) {
    // A factor moves nothing that is 0.
    if (!(loop.at(one.group).at(one.member).get<double>() > 0.0)) continue;
    html += slider(one.label, fmt::format("data-setting=\"{}\"", one.key), one.unit, one.span);
  }
  html +=
      "<button type=\"button\" class=\"reset\">Back to the start</button>\n</div>\n"
      "<div class=\"found\"><div aria-live=\"polite\"><p class=\"answer\"></p>\n"
      "<ul class=\"verdicts\"></ul></div>\n"
      "<div class=\"table margins\"><table><thead><tr><th scope=\"col\">loop cut at</th>"
      "<th scope=\"col\" class=\"right\">gain up dB</th>"
      "<th scope=\"col\" class=\"right\">gain down dB</th>"
      "<th scope=\"col\" class=\"right\">phase deg</th>"
      "<th scope=\"col\" class=\"right\">Ms</th></tr></thead><tbody></tbody></table></div>\n"
      "<svg class=\"steps\" viewBox=\"0 0 520 245\" font-size=\"12\" role=\"img\" "
      "aria-label=\"step responses of position and rate loop\"></svg>\n"
      "<p class=\"note\">Response to a unit step: position loop (solid), rate loop alone (dashed); "
      "grey: at the start.</p></div>\n"
      "<div class=\"gains\"><button type=\"button\" class=\"copy\">Copy the gains for --gains"
      "</button><code class=\"gains-text\"></code></div>\n"
      "<p class=\"note\">Linear plant, exact: the browser computes rms, stability, margins and "
      "step responses from the masses, springs and gains on this page, as the program does. Limit "
      "cycles, saturation and perturbed models are not included: run <code>boresight "
      "commission</code> with the copied gains before loading them. The start is ";
  return html + escaped_html(loop.at("structure").get<std::string>()) +
         fmt::format(
             " of this report.</p>\n<script type=\"application/json\" "
             "class=\"data\">{}</script>\n</div>\n",
             json_for_script(loop_json));
}

}  // namespace boresight::app
