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

constexpr const char* no_combined_value = " No combined estimate: see the section's text.";

struct Row {
  std::string method;
  Interval inertia;  // kg m2
  Interval ratio;    // all motors over everything else
  double printed_inertia = none, printed_ratio = none;
  bool combined = false;
};

Interval interval_of(const numerics::PropagatedResult& result) {
  return {result.value, result.standard_uncertainty, result.lower, result.upper};
}

// What a figure shows of a row.
struct Shown {
  Interval interval;
  double printed = none;
};

struct Scale {
  double lowest = 0.0, highest = 1.0;
  bool clips = false;  // an end of an interval, or a value
};

// A method that a campaign hardly allows may be off by orders: it must not squeeze the others.
// Values beyond four times their median do not count, ends of intervals up to twice the median.
Scale scale_of(const std::vector<Shown>& all) {
  std::vector<double> values;
  for (const auto& one : all) {
    if (std::isfinite(one.interval.value) && one.interval.value > 0.0) {
      values.push_back(one.interval.value);
    }
  }
  const double middle = values.empty() ? 1.0 : numerics::median(std::move(values));
  double low = std::numeric_limits<double>::infinity(), high = 0.0;
  const auto add = [&](double value, double maximum) {
    if (!std::isfinite(value)) return;
    low = std::min(low, std::clamp(value, 0.0, maximum));
    high = std::max(high, std::min(value, maximum));
  };
  const double farthest = 4.0 * middle;
  for (const auto& [interval, printed] : all) {
    if (printed <= farthest) add(printed, farthest);
    if (!(interval.value <= farthest)) continue;
    add(interval.lower, farthest);
    add(interval.value, farthest);
    add(interval.upper, 2.0 * middle);
  }
  if (!(low < high)) return {0.0, 2.0 * middle};
  const double margin = 0.035 * (high - low);
  Scale scale{std::max(0.0, low - margin), high + margin};
  scale.clips = std::ranges::any_of(all, [&](const Shown& one) {
    return one.interval.value > scale.highest || one.interval.upper > scale.highest;
  });
  return scale;
}

// Methods one below the other, each with its interval; an open one has an end beyond the scale. A
// ratio has none where the motors alone have more than the method's inertia.
Figure forest(const std::vector<Row>& rows, const FigureAxis& axis,
              const std::function<Shown(const Row&)>& shown, std::string caption) {
  std::vector<Shown> all;
  for (const auto& row : rows) all.push_back(shown(row));
  const Scale scale = scale_of(all);
  FigureSeries combined = make_series("combined, 95 % interval", SeriesStyle::points);
  FigureSeries methods = make_series("method, 95 % interval", SeriesStyle::points);
  FigureSeries printed = make_series("as stated", SeriesStyle::points);
  FigurePanel panel;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    panel.y.categories.push_back(rows[i].method);
    const auto& [interval, value] = all[i];
    const auto place = static_cast<double>(i);
    FigureSeries& series = rows[i].combined ? combined : methods;
    if (interval.value > scale.highest && std::isfinite(interval.value)) {
      panel.marks.push_back(
          {scale.highest, place, fmt::format("{:.3g}, off scale", interval.value)});
    }
    series.x.push_back(interval.value > 0.0 ? interval.value : none);
    series.y.push_back(place);
    series.x_lower.push_back(std::isfinite(interval.lower) ? std::max(interval.lower, 0.0)
                                                           : interval.value);
    series.x_upper.push_back(std::isfinite(interval.upper)
                                 ? std::max(interval.upper, 0.0)
                                 : std::max(1.05 * scale.highest, interval.value));
    if (std::isfinite(value)) {
      printed.x.push_back(value);
      printed.y.push_back(place);
    }
  }
  for (auto* series : {&combined, &methods, &printed}) {
    if (!series->x.empty()) panel.series.push_back(std::move(*series));
  }
  Figure figure;
  figure.x = axis;
  figure.x.lowest = scale.lowest;
  figure.x.highest = scale.highest;
  figure.panels.push_back(std::move(panel));
  figure.caption = std::move(caption);
  if (scale.clips) figure.caption += " Arrows: beyond the scale.";
  return figure;
}

std::vector<Figure> figures_of(const std::vector<Row>& rows, const std::string& id,
                               const std::string& section, const std::string& conditions) {
  if (rows.empty()) return {};
  Figure inertia = forest(
      rows, make_axis("reflected inertia at the motor shaft", "kg.m2"),
      [](const Row& row) {
        return Shown{row.inertia, row.printed_inertia};
      },
      conditions);
  inertia.id = id + "-inertia";
  inertia.title = "Reflected inertia by method";
  Figure ratio = forest(
      rows, make_axis("motor-to-load inertia ratio R", ""),
      [](const Row& row) {
        return Shown{row.ratio, row.printed_ratio};
      },
      conditions + " R = Jm/(J - Jm), all motors against the rest; R is undefined where J < Jm.");
  ratio.id = id + "-ratio";
  ratio.title = "Motor-to-load inertia ratio by method";
  // The rule's line is to be seen.
  ratio.x.lowest = std::min(*ratio.x.lowest, 0.9);
  ratio.x.highest = std::max(*ratio.x.highest, 1.1);
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
  const auto values = io::recommended(section);
  if (values) {
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
          "Intervals exclude model errors of the method. * procedures of the founding paper.{}",
          section.notes.records.size(), values ? "" : no_combined_value));
}

std::vector<Figure> inertia_figures(const IdentificationSection& section) {
  std::vector<Row> rows;
  const bool contradictory = section.combined && section.combined->contradictory();
  if (section.combined && !contradictory) {
    const auto& one = *section.combined;
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
      fmt::format(
          "From the values that the case states, without records. Intervals exclude model "
          "errors of the method (flexible antenna, efficiencies in the oil spring, friction "
          "model).{}",
          contradictory ? no_combined_value : ""));
}

}  // namespace boresight::app
