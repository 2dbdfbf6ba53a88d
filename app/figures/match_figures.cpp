#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include <boresight/app/figures/match_figures.hpp>
#include <boresight/app/report/sky_units.hpp>

namespace boresight::app {
namespace {

constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

std::string conditions(const MatchSection& section) {
  return fmt::format(
      "{:.3g} m/s, wind model {}, linear plant with friction {:.3g} N.m.s/rad, all constraints met "
      "on {}.",
      section.wind_speed, plant::to_string(section.wind_model), section.friction,
      section.members == 0 ? "the case's plant" : fmt::format("{} plants", section.members));
}

Figure started(const char* id, const char* title, std::string caption) {
  Figure figure;
  figure.id = id;
  figure.section = "Inertia matching";
  figure.title = title;
  figure.caption = std::move(caption);
  figure.x = {.label = "flywheel disks on each motor"};
  return figure;
}

// The rule without its reasons, which the report states: labels along lines are short.
std::string short_name(const RuleVerdict& rule) {
  const std::string text = text_of(rule.rule);
  const std::string name = text.substr(0, text.find_first_of(",:"));
  return fmt::format("{} (R = {:.2g})", name.substr(0, name.find(" at ")),
                     rule.motor_to_load_ratio);
}

enum class RuleLabels { names, ratios };

void add_rules(const MatchSection& section, RuleLabels labels, Figure& figure) {
  for (auto& panel : figure.panels) {
    const bool first = &panel == &figure.panels.front();
    for (const auto& rule : section.rules) {
      if (!rule.disks || *rule.disks > section.points.back().disks) continue;
      const std::string label = labels == RuleLabels::names
                                    ? short_name(rule)
                                    : fmt::format("R = {:.2g}", rule.motor_to_load_ratio);
      panel.lines.push_back(
          {FigureLine::Direction::vertical, *rule.disks, first ? label : std::string()});
    }
    for (const auto& point : section.points) {
      if (!point.as_built || point.unit_ratio) continue;
      panel.lines.push_back(
          {FigureLine::Direction::vertical, point.disks, first ? label_of(point) : std::string()});
    }
  }
}

// Numbers of the points on the even grid, which the kinks are counted by.
std::vector<std::size_t> grid_points(const MatchSection& section) {
  std::vector<std::size_t> points;
  for (std::size_t i = 0; i < section.points.size(); ++i) {
    if (section.points[i].on_grid) points.push_back(i);
  }
  return points;
}

Figure rms_figure(const MatchSection& section) {
  Figure figure = started("match-rms", "Boresight rms against motor inertia",
                          "Each structure re-tuned at each number of disks. Circles: minima; small "
                          "points: kinks, where another constraint, plant or solution branch "
                          "becomes active. Vertical lines: classic rules. " +
                              conditions(section));
  FigurePanel panel;
  panel.y = {.label = "boresight rms", .unit = "mdeg"};
  FigureSeries kinks{.name = "kinks", .style = SeriesStyle::points};
  const auto on_grid = grid_points(section);
  for (const auto& series : section.series) {
    FigureSeries curve{.name = series.name};
    for (std::size_t i = 0; i < section.points.size(); ++i) {
      curve.x.push_back(section.points[i].disks);
      curve.y.push_back(series.values[i].found ? series.values[i].boresight_rms / millidegree
                                               : undefined);
    }
    for (const auto& kink : series.smoothness.kinks) {
      if (kink.after + 1 >= on_grid.size()) continue;
      const std::size_t a = on_grid[kink.after], b = on_grid[kink.after + 1];
      kinks.x.push_back(0.5 * (curve.x[a] + curve.x[b]));
      kinks.y.push_back(0.5 * (curve.y[a] + curve.y[b]));
    }
    if (series.best) {
      panel.marks.push_back({curve.x[*series.best], curve.y[*series.best],
                             fmt::format("{} {:.4f}", series.name, curve.y[*series.best])});
    }
    panel.series.push_back(std::move(curve));
  }
  if (!kinks.x.empty()) panel.series.push_back(std::move(kinks));
  figure.panels.push_back(std::move(panel));
  add_rules(section, RuleLabels::names, figure);
  return figure;
}

Figure plant_figure(const MatchSection& section) {
  Figure figure = started(
      "match-plant", "Hydraulic mode and drive capability against motor inertia",
      fmt::format("Hydraulic mode of the flexible antenna, with the rule \u00bd\u221a(J_L/J_m) for "
                  "its damping; acceleration available at the slew rate; time of a slew of {:.3g} "
                  "deg at {:.3g} deg/s. Vertical lines: classic rules, by motor-to-load ratio R.",
                  section.slew_distance * 180.0 / std::numbers::pi,
                  section.slew_rate * 180.0 / std::numbers::pi));
  FigurePanel frequency, damping, acceleration, time;
  frequency.y = {.label = "hydraulic frequency", .unit = "Hz"};
  damping.y = {.label = "damping ratio"};
  acceleration.y = {.label = "acceleration at the sky", .unit = "deg/s\u00b2"};
  time.y = {.label = "slew time", .unit = "s"};
  FigureSeries found{.name = "hydraulic mode"},
      rule{.name = "\u00bd\u221a(J_L/J_m)", .style = SeriesStyle::dashed};
  FigureSeries hertz, ability, slew;
  for (const auto& point : section.points) {
    for (FigureSeries* series : {&found, &rule, &hertz, &ability, &slew}) {
      series->x.push_back(point.disks);
    }
    hertz.y.push_back(point.hydraulic.frequency);
    found.y.push_back(point.hydraulic.damping_ratio);
    // Without flywheels the rule asks for more than any drive has: it would press the rest down.
    rule.y.push_back(point.two_mass_damping <= 1.0 ? point.two_mass_damping : undefined);
    ability.y.push_back(std::max(point.acceleration, 0.0) * 180.0 / std::numbers::pi);
    slew.y.push_back(point.slew_time);
  }
  hertz.name = found.name;
  frequency.series = {std::move(hertz)};
  damping.series = {std::move(found), std::move(rule)};
  acceleration.series = {std::move(ability)};
  time.series = {std::move(slew)};
  figure.panels = {std::move(frequency), std::move(damping), std::move(acceleration),
                   std::move(time)};
  add_rules(section, RuleLabels::ratios, figure);
  return figure;
}

Figure margins_figure(const MatchSection& section) {
  Figure figure = started("match-margins", "Margins of the tuned controllers against motor inertia",
                          "Smallest margins over the three loop breaks, and position-loop "
                          "bandwidth (|S| reaches 0.71), nominal plant. " +
                              conditions(section));
  figure.panels.resize(4);
  figure.panels[0].y = {.label = "phase margin", .unit = "deg"};
  figure.panels[1].y = {.label = "gain margin, up", .unit = "dB"};
  figure.panels[2].y = {.label = "delay margin", .unit = "ms"};
  figure.panels[3].y = {.label = "position loop bandwidth", .unit = "Hz"};
  for (const auto& series : section.series) {
    std::vector<FigureSeries> curves(figure.panels.size(), FigureSeries{.name = series.name});
    for (std::size_t i = 0; i < section.points.size(); ++i) {
      const MatchValue& value = series.values[i];
      double phase = undefined, gain = undefined, delay = undefined;
      if (value.found) {
        for (const auto& margins : value.margins) {
          phase = std::fmin(phase, margins.phase_margin_deg);
          gain = std::fmin(gain, 20.0 * std::log10(margins.increasing_gain_margin));
          delay = std::fmin(delay, 1e3 * margins.delay_margin);
        }
      }
      const double shown[] = {phase, gain, delay, value.found ? value.bandwidth : undefined};
      for (std::size_t k = 0; k < curves.size(); ++k) {
        curves[k].x.push_back(section.points[i].disks);
        curves[k].y.push_back(shown[k]);
      }
    }
    for (std::size_t k = 0; k < curves.size(); ++k) {
      figure.panels[k].series.push_back(std::move(curves[k]));
    }
  }
  return figure;
}

Figure friction_figure(const MatchSection& section) {
  Figure figure = started(
      "match-friction", "Velocity reversals and limit cycles of the tuned controllers",
      fmt::format("Nonlinear antenna in still air: peak boresight error after velocity reversals "
                  "at {:.4g} mdeg/s, and amplitude of the boresight limit cycle at rest (0: none).",
                  section.tracking_rate / millidegree));
  figure.panels.resize(2);
  figure.panels[0].y = {.label = "error after velocity reversals", .unit = "mdeg"};
  figure.panels[1].y = {.label = "limit cycle at rest", .unit = "mdeg"};
  for (const auto& series : section.series) {
    FigureSeries reversal{.name = series.name, .style = SeriesStyle::line_and_points};
    FigureSeries cycle = reversal;
    for (std::size_t i = 0; i < section.points.size(); ++i) {
      const auto& run = series.values[i].time_domain;
      if (!run) continue;
      if (run->reversal && run->reversal->status == design::RunStatus::complete) {
        reversal.x.push_back(section.points[i].disks);
        reversal.y.push_back(run->reversal->boresight_error / millidegree);
      }
      if (!run->limit_cycles.empty() &&
          run->limit_cycles.front().status == design::RunStatus::complete) {
        const auto& rest = run->limit_cycles.front();
        cycle.x.push_back(section.points[i].disks);
        cycle.y.push_back(rest.limit_cycle ? rest.boresight_amplitude / millidegree : 0.0);
      }
    }
    if (!reversal.x.empty()) figure.panels[0].series.push_back(std::move(reversal));
    if (!cycle.x.empty()) figure.panels[1].series.push_back(std::move(cycle));
  }
  return figure;
}

Figure variants_figure(const MatchSection& section, std::size_t number) {
  const MatchVariants& variants = section.variants[number];
  Figure figure =
      started(fmt::format("match-variants-{}", number + 1).c_str(), "",
              fmt::format("Boresight rms of {} against motor inertia with one assumption changed, "
                          "tuned on that plant alone. Circles: minima. {:.3g} m/s.",
                          variants.structure, section.wind_speed));
  figure.title = fmt::format("Sensitivity of the optimum: {}", variants.structure);
  FigurePanel panel;
  panel.y = {.label = "boresight rms", .unit = "mdeg"};
  for (const auto& variant : variants.variants) {
    FigureSeries series{.name = name_of(variant), .style = SeriesStyle::line_and_points};
    for (std::size_t i = 0; i < variant.rms.size(); ++i) {
      series.x.push_back(variants.disks[i]);
      series.y.push_back(variant.rms[i] / millidegree);
    }
    if (variant.best) panel.marks.push_back({series.x[*variant.best], series.y[*variant.best], ""});
    panel.series.push_back(std::move(series));
  }
  figure.panels.push_back(std::move(panel));
  return figure;
}

Figure rules_figure(const MatchSection& section) {
  Figure figure = started("match-rules", "What each rule costs",
                          "Boresight rms at the number of disks given by a rule, relative to the "
                          "minimum of each structure, minus 1. " +
                              conditions(section));
  figure.x = {.label = "rms increase over the best inertia", .unit = "%"};
  FigurePanel panel;
  for (const auto& rule : section.rules) {
    if (rule.disks) panel.y.categories.push_back(text_of(rule.rule));
  }
  for (std::size_t s = 0; s < section.series.size(); ++s) {
    FigureSeries bars{.name = section.series[s].name, .style = SeriesStyle::bars};
    double place = 0.0;
    for (const auto& rule : section.rules) {
      if (!rule.disks) continue;
      if (s < rule.cost.size() && std::isfinite(rule.cost[s])) {
        bars.x.push_back(100.0 * rule.cost[s]);
        bars.y.push_back(place);
      }
      place += 1.0;
    }
    if (!bars.x.empty()) panel.series.push_back(std::move(bars));
  }
  figure.panels.push_back(std::move(panel));
  return figure;
}

bool has_series(const Figure& figure) {
  return std::any_of(figure.panels.begin(), figure.panels.end(),
                     [](const auto& panel) { return !panel.series.empty(); });
}

}  // namespace

std::vector<Figure> match_figures(const MatchSection& section) {
  if (section.points.empty()) return {};
  std::vector<Figure> figures{rms_figure(section), plant_figure(section), margins_figure(section)};
  figures.push_back(friction_figure(section));
  for (std::size_t i = 0; i < section.variants.size(); ++i) {
    figures.push_back(variants_figure(section, i));
  }
  figures.push_back(rules_figure(section));
  std::erase_if(figures, [](const Figure& figure) { return !has_series(figure); });
  return figures;
}

}  // namespace boresight::app
