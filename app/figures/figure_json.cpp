#include <cstdlib>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <boresight/app/figures/figure_json.hpp>
#include <boresight/app/figures/figure_number.hpp>

namespace boresight::app {
namespace {

using Json = nlohmann::ordered_json;

Json short_number(double value) {
  const std::string text = figure_number(value);
  return text.empty() ? Json(nullptr) : Json(std::strtod(text.c_str(), nullptr));
}

Json list(const std::vector<double>& values) {
  Json json = Json::array();
  for (const double value : values) json.push_back(short_number(value));
  return json;
}

Json axis_json(const FigureAxis& axis) {
  Json json{{"label", axis.label},
            {"unit", axis.unit},
            {"scale", axis.scale == AxisScale::logarithmic ? "logarithmic" : "linear"}};
  if (!axis.categories.empty()) json["categories"] = axis.categories;
  if (axis.lowest) json["lowest"] = short_number(*axis.lowest);
  if (axis.highest) json["highest"] = short_number(*axis.highest);
  return json;
}

const char* style_name(SeriesStyle style) {
  switch (style) {
    case SeriesStyle::line:
      return "line";
    case SeriesStyle::dashed:
      return "dashed";
    case SeriesStyle::steps:
      return "steps";
    case SeriesStyle::points:
      return "points";
    case SeriesStyle::line_and_points:
      return "line and points";
    case SeriesStyle::bars:
      return "bars";
  }
  return "line";
}

Json series_json(const FigureSeries& series) {
  Json json{{"name", series.name},
            {"style", style_name(series.style)},
            {"x", list(series.x)},
            {"y", list(series.y)}};
  if (!series.x_lower.empty()) json["x_lower"] = list(series.x_lower);
  if (!series.x_upper.empty()) json["x_upper"] = list(series.x_upper);
  if (!series.y_lower.empty()) json["y_lower"] = list(series.y_lower);
  if (!series.y_upper.empty()) json["y_upper"] = list(series.y_upper);
  if (!series.labels.empty()) json["labels"] = series.labels;
  return json;
}

Json panel_json(const FigurePanel& panel) {
  Json json{{"y", axis_json(panel.y)}, {"series", Json::array()}};
  for (const auto& series : panel.series) json["series"].push_back(series_json(series));
  for (const auto& mark : panel.marks) {
    json["marks"].push_back(
        {{"x", short_number(mark.x)}, {"y", short_number(mark.y)}, {"label", mark.label}});
  }
  for (const auto& line : panel.lines) {
    const bool horizontal = line.direction == FigureLine::Direction::horizontal;
    json["lines"].push_back({{"direction", horizontal ? "horizontal" : "vertical"},
                             {"at", short_number(line.at)},
                             {"label", line.label}});
  }
  for (const auto& circle : panel.circles) {
    json["circles"].push_back({{"x", short_number(circle.x)},
                               {"y", short_number(circle.y)},
                               {"radius", short_number(circle.radius)},
                               {"label", circle.label}});
  }
  return json;
}

}  // namespace

Json figures_json(const std::vector<Figure>& figures) {
  Json json = Json::array();
  for (const auto& figure : figures) {
    Json panels = Json::array();
    for (const auto& panel : figure.panels) panels.push_back(panel_json(panel));
    json.push_back({{"id", figure.id},
                    {"section", figure.section},
                    {"title", figure.title},
                    {"caption", figure.caption},
                    {"x", axis_json(figure.x)},
                    {"equal_scales", figure.equal_scales},
                    {"panels", std::move(panels)}});
  }
  return json;
}

}  // namespace boresight::app
