#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include <fmt/format.h>

#include <boresight/app/figures/figure_parts.hpp>
#include <boresight/app/figures/inertia_figures.hpp>
#include <boresight/io/campaign/recommended_values.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/statistics/order_statistics.hpp>

namespace boresight::app {
namespace {

using numerics::Interval;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

struct Row {
  std::string method;
  Interval inertia;  // kg m2
  Interval ratio;    // all motors over everything else
  double printed_inertia = none, printed_ratio = none;
  bool reconciled = false;
};

Interval interval_of(const numerics::PropagatedResult& result) {
  return {result.value, result.standard_uncertainty, result.lower, result.upper};
}

// What a figure shows of a row.
struct Shown {
  const Interval& interval;
  double printed = none;
};

// Methods one below the other, each with its interval. A ratio has none where the motors alone have
// more than the method's inertia.
Figure forest(const std::vector<Row>& rows, const FigureAxis& axis,
              const std::function<Shown(const Row&)>& shown) {
  // A method that a campaign hardly allows may be off by orders: it must not squeeze the others.
  std::vector<double> values;
  for (const auto& row : rows) {
    const double value = shown(row).interval.value;
    if (std::isfinite(value) && value > 0.0) values.push_back(value);
  }
  const double most = values.empty() ? 1.0 : 4.0 * numerics::median(std::move(values));
  double largest = 0.0;
  for (const auto& row : rows) {
    const auto [interval, printed] = shown(row);
    for (const double value : {interval.value, interval.upper, printed}) {
      if (std::isfinite(value)) largest = std::max(largest, std::min(value, most));
    }
  }
  const double edge = 1.05 * largest;
  FigureSeries reconciled = make_series("combined, 95 % interval", SeriesStyle::points);
  FigureSeries methods = make_series("method, 95 % interval", SeriesStyle::points);
  FigureSeries printed = make_series("as stated", SeriesStyle::points);
  FigurePanel panel;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    panel.y.categories.push_back(rows[i].method);
    const auto [interval, value] = shown(rows[i]);
    const auto place = static_cast<double>(i);
    FigureSeries& series = rows[i].reconciled ? reconciled : methods;
    series.x.push_back(interval.value > 0.0 && interval.value <= edge ? interval.value : none);
    series.y.push_back(place);
    series.x_lower.push_back(std::isfinite(interval.lower) ? std::clamp(interval.lower, 0.0, edge)
                                                           : interval.value);
    series.x_upper.push_back(std::isfinite(interval.upper) ? std::clamp(interval.upper, 0.0, edge)
                                                           : edge);
    if (std::isfinite(value)) {
      printed.x.push_back(value);
      printed.y.push_back(place);
    }
  }
  for (auto* series : {&reconciled, &methods, &printed}) {
    if (!series->x.empty()) panel.series.push_back(std::move(*series));
  }
  Figure figure;
  figure.x = axis;
  figure.panels.push_back(std::move(panel));
  return figure;
}

std::vector<Figure> figures_of(const std::vector<Row>& rows, const std::string& id,
                               const std::string& section, const std::string& conditions) {
  if (rows.empty()) return {};
  Figure inertia =
      forest(rows, make_axis("reflected inertia at the motor shaft", "kg.m2"), [](const Row& row) {
        return Shown{row.inertia, row.printed_inertia};
      });
  inertia.id = id + "-inertia";
  inertia.title = "Reflected inertia by method";
  inertia.caption = conditions;
  Figure ratio = forest(rows, make_axis("motor-to-load inertia ratio R", ""), [](const Row& row) {
    return Shown{row.ratio, row.printed_ratio};
  });
  ratio.id = id + "-ratio";
  ratio.title = "Motor-to-load inertia ratio by method";
  ratio.caption = conditions +
                  " R = Jm/(J - Jm), all motors against the rest; open intervals run to the edge. "
                  "R is undefined where J < Jm.";
  ratio.panels.front().lines.push_back(vertical_line(1.0, "one to one"));
  for (auto* figure : {&inertia, &ratio}) figure->section = section;
  return {std::move(inertia), std::move(ratio)};
}

// A value that a case prints, in SI; it was read with the case and so can be read again.
double printed_value(const std::string& text, io::Kind kind) {
  if (text.empty()) return none;
  try {
    return io::parse_quantity(text, kind).value;
  } catch (const InvalidInput&) {
    return none;
  }
}

}  // namespace

std::vector<Figure> inertia_figures(const io::CampaignSection& section) {
  std::vector<Row> rows;
  if (const auto values = io::recommended(section)) {
    rows.push_back(
        {"combined (grey box)", values->inertia, values->motor_to_load_ratio, none, none, true});
  }
  for (const auto& row : section.inertia) {
    rows.push_back({(row.of_the_paper ? "* " : "") + row.name, row.inertia, row.motor_to_load_ratio,
                    none, none, false});
  }
  return figures_of(
      rows, "campaign", "Inertia at the motor shaft, by method (95 % intervals)",
      fmt::format(
          "From {} records, with the case's uncertainties of transducers, drawings and oil data. "
          "Intervals exclude model errors of the method. * procedures of the founding paper.",
          section.notes.records.size()));
}

std::vector<Figure> inertia_figures(const IdentificationSection& section) {
  std::vector<Row> rows;
  if (section.reconciled) {
    const auto& one = *section.reconciled;
    rows.push_back({"combined",
                    {one.value, one.standard_uncertainty, one.lower, one.upper},
                    {one.motor_to_load_ratio, 0.0, one.ratio_lower, one.ratio_upper},
                    none,
                    none,
                    true});
  }
  for (std::size_t i = 0; i < section.inertia.methods.size(); ++i) {
    const auto& method = section.inertia.methods[i];
    rows.push_back({method.name, interval_of(method.reflected_inertia),
                    interval_of(method.motor_to_load_ratio),
                    printed_value(section.printed[i].inertia, io::Kind::inertia),
                    printed_value(section.printed[i].ratio, io::Kind::number), false});
  }
  return figures_of(
      rows, "stated",
      "Inertia at the motor shaft, by method (95 % intervals from the inputs' uncertainties)",
      "From the values that the case states, without records. Intervals exclude model errors of "
      "the method (flexible antenna, efficiencies in the oil spring, friction model).");
}

}  // namespace boresight::app
