#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <boresight/app/figures/benchmark_figures.hpp>
#include <boresight/app/figures/figure_parts.hpp>
#include <boresight/app/figures/thinned_series.hpp>
#include <boresight/app/figures/time_domain_figures.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::app {
namespace {

constexpr double per_meganewton = 1e6 / millidegree;  // rad/(N m) to mdeg/(MN m)
constexpr std::size_t response_samples = 1000;

std::string conditions(const BenchmarkReport& report) {
  return fmt::format(
      "{}; protocol {}, linear plant {}.", report.controller.description,
      design::rejection_protocol,
      report.from_records ? "that the case's records show" : "as the case states it");
}

Figure compliance(const BenchmarkReport& report) {
  FigurePanel panel =
      make_panel(make_axis("|boresight/torque|", "mdeg/(MN.m)", AxisScale::logarithmic));
  FigureSeries curve = make_series("this controller", SeriesStyle::line);
  for (const auto& point : report.score.compliance) {
    curve.x.push_back(point.frequency);
    curve.y.push_back(point.compliance * per_meganewton);
  }
  panel.series.push_back(std::move(curve));
  if (report.compared_sheet) {
    const auto& other = *report.compared_sheet;
    panel.series.push_back(
        make_series("compared sheet", SeriesStyle::dashed, other.frequency, other.compliance));
  }
  panel.marks.push_back({report.score.worst.frequency / two_pi,
                         report.score.worst.lower * per_meganewton,
                         fmt::format("worst, {:.3g} Hz", report.score.worst.frequency / two_pi)});
  panel.lines.push_back(horizontal_line(report.score.flexure_compliance * per_meganewton,
                                        "flexure with the encoder fixed"));
  Figure figure =
      make_figure("compliance", "Torque at the dish", "Compliance of the boresight",
                  conditions(report) + " Angle at the sky by torque at the antenna's axis.",
                  make_axis("frequency", "Hz", AxisScale::logarithmic));
  figure.panels.push_back(std::move(panel));
  return figure;
}

Figure course(const BenchmarkReport& report, const std::vector<control::ResponseSample>& points,
              const control::ResponseScore& score, const std::string& id, const std::string& title,
              const std::string& unit) {
  const double factor = per_meganewton / std::pow(report.gear_ratio, 2);
  const auto count = static_cast<Eigen::Index>(points.size());
  Eigen::VectorXd time(count), boresight(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    time[i] = points[static_cast<std::size_t>(i)].time;
    boresight[i] = points[static_cast<std::size_t>(i)].boresight * factor;
  }
  const auto drawn = thinned(time, boresight, response_samples);
  FigurePanel panel = make_panel(make_axis("boresight", unit));
  panel.series.push_back(make_series("this controller", SeriesStyle::line, drawn.x, drawn.y));
  panel.lines.push_back(horizontal_line(score.final_value * per_meganewton, "final value"));
  if (score.return_time && *score.return_time <= drawn.x.back()) {
    panel.lines.push_back(vertical_line(
        *score.return_time, fmt::format("settled (5 %), {:.3g} s", *score.return_time)));
  }
  Figure figure =
      make_figure(id, "Torque at the dish", title, conditions(report) + " From rest, at the sky.",
                  make_axis("time", "s"));
  figure.panels.push_back(std::move(panel));
  return figure;
}

void draw_budgets(const BenchmarkReport& report, FigurePanel& panel) {
  for (const auto& budget : report.budgets) {
    panel.lines.push_back(horizontal_line(budget.rms / millidegree,
                                          fmt::format("{} ({})", budget.name, budget.band)));
  }
}

Figure winds(const BenchmarkReport& report) {
  FigurePanel panel =
      make_panel(make_axis("boresight rms per axis", "mdeg", AxisScale::logarithmic));
  const auto of = [&](const std::string& name) -> FigureSeries& {
    const auto found = std::ranges::find(panel.series, name, &FigureSeries::name);
    if (found != panel.series.end()) return *found;
    panel.series.push_back(make_series(name, SeriesStyle::line_and_points));
    return panel.series.back();
  };
  for (const auto& wind : report.score.winds) {
    if (!wind.attitude.empty()) continue;
    FigureSeries& series = of(fmt::format("model {}", plant::to_string(wind.model)));
    series.x.push_back(wind.mean_speed);
    series.y.push_back(wind.boresight_rms / millidegree);
  }
  if (report.compared_sheet && !report.compared_sheet->wind_speed.empty()) {
    const auto& other = *report.compared_sheet;
    panel.series.push_back(
        make_series(fmt::format("compared sheet, model {}", plant::to_string(report.wind.model)),
                    SeriesStyle::dashed, other.wind_speed, other.boresight_rms));
  }
  draw_budgets(report, panel);
  Figure figure =
      make_figure("winds", "Wind", "Boresight rms against wind speed",
                  conditions(report) +
                      fmt::format(" Torque coefficient {:g}; wind and noise over {:g} to {:g} Hz "
                                  "about the mean.",
                                  report.wind.site.torque_coefficient, report.rms_band.lowest,
                                  report.rms_band.highest),
                  make_axis("mean wind speed", "m/s"));
  figure.panels.push_back(std::move(panel));
  return figure;
}

// Attitudes are called "YAW, ELEVATION": a panel an elevation, a series a yaw.
Figure attitudes(const BenchmarkReport& report) {
  Figure figure = make_figure(
      "attitudes", "Wind", "Boresight rms by direction and elevation",
      conditions(report) + fmt::format(" Wind model {}.", plant::to_string(report.wind.model)),
      make_axis("mean wind speed", "m/s"));
  std::vector<std::string> elevations;
  for (const auto& wind : report.score.winds) {
    const auto comma = wind.attitude.find(", ");
    if (comma == std::string::npos) continue;
    const std::string yaw = wind.attitude.substr(0, comma);
    const std::string elevation = wind.attitude.substr(comma + 2);
    const auto known = std::ranges::find(elevations, elevation);
    const auto place = static_cast<std::size_t>(known - elevations.begin());
    if (known == elevations.end()) {
      elevations.push_back(elevation);
      figure.panels.push_back(
          make_panel(make_axis("rms, " + elevation, "mdeg", AxisScale::logarithmic)));
    }
    auto& series = figure.panels[place].series;
    auto found = std::ranges::find(series, yaw, &FigureSeries::name);
    if (found == series.end()) {
      series.push_back(make_series(yaw, SeriesStyle::line));
      found = series.end() - 1;
    }
    found->x.push_back(wind.mean_speed);
    found->y.push_back(wind.boresight_rms / millidegree);
  }
  return figure;
}

}  // namespace

std::vector<Figure> benchmark_figures(const BenchmarkReport& report) {
  std::vector<Figure> figures;
  if (!report.score.stable) return figures;
  const auto keep = [&](Figure figure) {
    const bool drawn = std::ranges::any_of(
        figure.panels, [](const FigurePanel& panel) { return !panel.series.empty(); });
    if (drawn) figures.push_back(std::move(figure));
  };
  if (!report.score.compliance.empty()) keep(compliance(report));
  if (!report.step_course.empty()) {
    keep(course(report, report.step_course, report.score.step, "step",
                "Boresight response to a torque step", "mdeg/(MN.m)"));
  }
  if (!report.impulse_course.empty()) {
    keep(course(report, report.impulse_course, report.score.impulse, "impulse",
                "Boresight response to a torque impulse", "mdeg/(MN.m.s)"));
  }
  keep(winds(report));
  keep(attitudes(report));
  if (report.time_domain) {
    for (auto& figure : time_domain_figures(*report.time_domain, "Nonlinear antenna")) {
      keep(std::move(figure));
    }
  }
  return figures;
}

}  // namespace boresight::app
