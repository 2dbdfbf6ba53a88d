#include <algorithm>
#include <cmath>

#include <boresight/app/figures/figure_parts.hpp>
#include <boresight/app/figures/friction_figure.hpp>
#include <boresight/io/campaign/recommended_values.hpp>
#include <boresight/plant/antenna/friction.hpp>

namespace boresight::app {
namespace {

constexpr std::size_t max_windows = 600;
constexpr int curve_points = 60;

FigureSeries windows_of(const identification::FrictionCurveFit& fit, bool forward) {
  FigureSeries series =
      make_series(forward ? "windows, forward" : "windows, backward", SeriesStyle::points);
  const std::size_t step = 1 + fit.points.size() / max_windows;
  for (std::size_t i = 0; i < fit.points.size(); i += step) {
    const auto& point = fit.points[i];
    if ((point.rate > 0.0) != forward || point.rate == 0.0) continue;
    series.x.push_back(std::abs(point.rate));
    series.y.push_back(forward ? point.friction : -point.friction);
  }
  return series;
}

}  // namespace

std::vector<Figure> friction_figure(const io::CampaignSection& section) {
  const identification::FrictionCurveFit* fit = nullptr;
  if (section.impulse && section.impulse->friction) fit = &*section.impulse->friction;
  if (section.friction.empty()) return {};
  double lowest = section.friction.front().rate, highest = section.friction.back().rate;
  if (fit != nullptr) {
    lowest = lowest > 0.0 ? std::min(lowest, fit->lowest_rate) : fit->lowest_rate;
    highest = std::max(highest, fit->highest_rate);
  }
  if (!(highest > 0.0)) return {};
  lowest = std::clamp(lowest, 1e-4 * highest, 0.5 * highest);

  FigurePanel panel = make_panel(make_axis("friction torque", "N.m"));
  FigureSeries combined = make_series("combined, 95 % band", SeriesStyle::line);
  const bool recommended = io::recommended(section).has_value();
  FigureSeries fitted = make_series("curve through the windows", SeriesStyle::dashed);
  for (int i = 0; i < curve_points; ++i) {
    const double rate = lowest * std::pow(highest / lowest, i / (curve_points - 1.0));
    if (recommended) {
      const auto band = identification::friction_interval(*section.grey_box, rate);
      combined.x.push_back(rate);
      combined.y.push_back(band.value);
      combined.y_lower.push_back(band.lower);
      combined.y_upper.push_back(band.upper);
    }
    if (fit != nullptr) {
      fitted.x.push_back(rate);
      fitted.y.push_back(plant::friction_torque(fit->curve, rate));
    }
  }
  FigureSeries tested = make_series("constant-speed tests", SeriesStyle::points);
  for (const auto& row : section.friction) {
    if (row.tracking) {
      panel.lines.push_back(vertical_line(row.rate, "tracking rate"));
    }
    if (!row.tested) continue;
    tested.x.push_back(row.rate);
    tested.y.push_back(row.tested->value);
    tested.y_lower.push_back(row.tested->lower);
    tested.y_upper.push_back(row.tested->upper);
  }
  if (fit != nullptr) {
    for (const bool forward : {true, false}) panel.series.push_back(windows_of(*fit, forward));
  }
  for (auto* series : {&fitted, &combined, &tested}) panel.series.push_back(std::move(*series));
  std::erase_if(panel.series, [](const FigureSeries& series) { return series.x.empty(); });
  if (panel.series.empty()) return {};
  Figure figure =
      make_figure("campaign-friction", "Friction at the motor shaft, N.m (95 % intervals)",
                  "Friction against speed",
                  "At the motor shaft, all motors. Windows: mean torque minus inertial and offset "
                  "torque over stretches of all tests, transducer errors included. The combined "
                  "band is corrected for them.",
                  make_axis("motor rate", "rad/s", AxisScale::logarithmic));
  figure.panels.push_back(std::move(panel));
  return {figure};
}

}  // namespace boresight::app
