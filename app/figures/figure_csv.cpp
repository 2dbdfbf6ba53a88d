#include <algorithm>
#include <filesystem>
#include <system_error>

#include <fmt/format.h>

#include <boresight/app/figures/figure_csv.hpp>
#include <boresight/app/figures/figure_number.hpp>
#include <boresight/io/files/write_atomically.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::app {
namespace {

std::string axis_name(const FigureAxis& axis) {
  return axis.unit.empty() ? axis.label : fmt::format("{} [{}]", axis.label, axis.unit);
}

// Panels of one figure may be of different units: then the panel's own column says which.
std::string y_name(const Figure& figure) {
  const std::string name = figure.panels.empty() ? "y" : axis_name(figure.panels.front().y);
  const bool one = std::all_of(figure.panels.begin(), figure.panels.end(),
                               [&](const auto& panel) { return axis_name(panel.y) == name; });
  return one ? name : "y";
}

std::string at(const std::vector<double>& values, std::size_t index) {
  return index < values.size() ? figure_number(values[index]) : std::string();
}

struct Column {
  const char* name;
  std::vector<double> FigureSeries::*values;
};

constexpr Column intervals[] = {{"x lower", &FigureSeries::x_lower},
                                {"x upper", &FigureSeries::x_upper},
                                {"y lower", &FigureSeries::y_lower},
                                {"y upper", &FigureSeries::y_upper}};

bool any_series(const Figure& figure, const auto& has) {
  return std::any_of(figure.panels.begin(), figure.panels.end(), [&](const auto& panel) {
    return std::any_of(panel.series.begin(), panel.series.end(), has);
  });
}

}  // namespace

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + "\"";
}

std::string to_csv(const Figure& figure) {
  std::vector<Column> columns;
  for (const auto& column : intervals) {
    if (any_series(figure, [&](const auto& s) { return !(s.*column.values).empty(); })) {
      columns.push_back(column);
    }
  }
  const bool labelled = any_series(figure, [](const auto& s) { return !s.labels.empty(); });
  std::string text =
      fmt::format("panel,series,{},{}", csv_field(axis_name(figure.x)), csv_field(y_name(figure)));
  for (const auto& column : columns) text += fmt::format(",{}", column.name);
  text += labelled ? ",label\n" : "\n";
  for (const auto& panel : figure.panels) {
    for (const auto& series : panel.series) {
      const std::string start = csv_field(axis_name(panel.y)) + "," + csv_field(series.name) + ",";
      for (std::size_t i = 0; i < series.x.size(); ++i) {
        text += start + at(series.x, i) + "," + at(series.y, i);
        for (const auto& column : columns) text += "," + at(series.*column.values, i);
        if (labelled) text += "," + (i < series.labels.size() ? csv_field(series.labels[i]) : "");
        text += '\n';
      }
    }
  }
  return text;
}

void write_curves(const std::vector<Figure>& figures, const std::string& folder) {
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure || !std::filesystem::is_directory(folder, failure)) {
    throw InvalidInput(fmt::format("{}: expected a folder to write curves to, found none{}", folder,
                                   failure ? " (" + failure.message() + ")" : ""));
  }
  for (const auto& figure : figures) {
    const auto path = std::filesystem::path(folder) / (figure.id + ".csv");
    io::write_atomically(path.string(), to_csv(figure));
  }
}

}  // namespace boresight::app
