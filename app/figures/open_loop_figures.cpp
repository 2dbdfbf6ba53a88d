#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <boresight/app/figures/frequency_curves.hpp>
#include <boresight/app/figures/open_loop_figures.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::app {
namespace {

constexpr std::array short_names{"rate", "valve", "position"};  // of control::loop_breaks

// Each allowed Ms once, with its label.
std::vector<std::pair<double, std::string>> allowed_peaks(const DrawnController& drawn) {
  const auto& goals = drawn.goals.sensitivity_peak;
  const auto shown = shown_breaks(drawn);
  const bool one = std::ranges::all_of(
      shown, [&](std::size_t b) { return goals.at(b) == goals.at(shown.front()); });
  std::vector<std::pair<double, std::string>> allowed;
  for (const std::size_t b : shown) {
    const double goal = goals.at(b);
    if (std::ranges::find(allowed, goal, &std::pair<double, std::string>::first) != allowed.end()) {
      continue;
    }
    allowed.emplace_back(
        goal, one ? fmt::format("Ms {:g}", goal) : fmt::format("Ms {:g}, {}", goal, break_name(b)));
  }
  return allowed;
}

// The value of a curve over rising frequencies (Hz), straight in ln f between its points.
double value_at(const FigureSeries& curve, double hertz) {
  const auto next = std::ranges::lower_bound(curve.x, hertz);
  const auto i = static_cast<std::size_t>(next - curve.x.begin());
  if (i == 0) return curve.y.front();
  if (i == curve.x.size()) return curve.y.back();
  const double part = std::log(hertz / curve.x[i - 1]) / std::log(curve.x[i] / curve.x[i - 1]);
  return std::lerp(curve.y[i - 1], curve.y[i], part);
}

FigureMark mark_on(const FigureSeries& curve, double angular_frequency, std::string label) {
  const double hertz = angular_frequency / two_pi;
  return {hertz, value_at(curve, hertz), std::move(label)};
}

// The smallest margins of one break and its Ms, on its curves of gain and phase.
void mark_margins(const control::Margins& margins, const char* name, std::size_t curve,
                  FigurePanel& gain, FigurePanel& phase) {
  for (const auto& crossover : margins.gain_crossovers) {
    const bool smallest = std::abs(crossover.phase_margin_deg) == margins.phase_margin_deg;
    const double hertz = crossover.frequency / two_pi;
    gain.marks.push_back({hertz, 0.0, smallest ? fmt::format("{:.2f} Hz", hertz) : std::string()});
    if (!smallest) continue;
    phase.marks.push_back(
        mark_on(phase.series[curve], crossover.frequency,
                fmt::format("PM {} {:.0f}\u00b0", name, crossover.phase_margin_deg)));
  }
  for (const auto& crossover : margins.phase_crossovers) {
    const double factor = crossover.gain_margin;
    const bool smallest =
        factor == margins.increasing_gain_margin || factor == margins.decreasing_gain_margin;
    if (!smallest || !(factor > 0.0) || !(crossover.frequency > 0.0) ||
        !std::isfinite(factor * crossover.frequency)) {
      continue;
    }
    const double decibels = 20.0 * std::log10(factor);
    gain.marks.push_back(
        {crossover.frequency / two_pi, -decibels, fmt::format("GM {} {:.1f} dB", name, decibels)});
  }
  const auto& peak = margins.sensitivity;
  if (!(peak.frequency > 0.0) || !std::isfinite(peak.frequency)) return;
  gain.marks.push_back(mark_on(gain.series[curve], peak.frequency,
                               fmt::format("Ms {} {:.2f}", name, peak.magnitude)));
}

// Phase within [-360, 0] degrees against magnitude in dB, with a gap where the phase jumps.
FigureSeries nichols_curve(std::string name, const Eigen::ArrayXcd& values) {
  constexpr double gap = std::numeric_limits<double>::quiet_NaN();
  FigureSeries curve;
  curve.name = std::move(name);
  const std::vector<double> decibels = in_decibels(values);
  for (std::size_t i = 0; i < decibels.size(); ++i) {
    double angle = std::arg(values[static_cast<Eigen::Index>(i)]) * 180.0 / std::numbers::pi;
    if (angle > 0.0) angle -= 360.0;
    if (!curve.x.empty() && std::abs(angle - curve.x.back()) > 180.0) {
      curve.x.push_back(gap);
      curve.y.push_back(gap);
    }
    curve.x.push_back(angle);
    curve.y.push_back(decibels[i]);
  }
  return curve;
}

}  // namespace

Figure open_loop_figure(const DrawnController& drawn, const ControllerResponses& on_grid) {
  const auto shown = shown_breaks(drawn);
  const bool all = shown.size() == drawn.margins.size();
  Figure figure = controller_figure(
      drawn, "open-loop", all ? "Open loop at three breaks" : "Open loop at the valve command");
  figure.caption = fmt::format(
      "Loop gain broken {}. Circles: gain crossovers, and{} the smallest gain margin (GM), the "
      "smallest phase margin (PM) and the frequency of the maximum sensitivity (Ms). ",
      all ? "in the rate loop (position loop open), at the valve command and in the position loop"
          : "at the valve command",
      all ? " at each break" : "");
  figure.caption += controller_conditions(drawn);
  std::vector<NamedResponse> loops;
  for (const std::size_t b : shown) {
    loops.push_back({break_name(b), on_grid.gain.at(b)});
  }
  figure.panels = bode_panels(on_grid.frequency, loops, "loop gain");
  FigurePanel& gain = figure.panels[0];
  FigurePanel& phase = figure.panels[1];
  gain.y.lowest = -60.0;
  gain.y.highest = 80.0;
  // Dead time turns on for ever where nothing is left of the gain.
  phase.y.lowest = -720.0;
  phase.y.highest = 90.0;
  gain.lines.push_back({FigureLine::Direction::horizontal, 0.0, ""});
  phase.lines.push_back({FigureLine::Direction::horizontal, -180.0, ""});
  for (std::size_t i = 0; i < shown.size(); ++i) {
    mark_margins(drawn.margins.at(shown[i]), short_names.at(shown[i]), i, gain, phase);
  }
  return figure;
}

Figure nyquist_figure(const DrawnController& drawn, const ControllerResponses& on_grid) {
  Figure figure = controller_figure(drawn, "nyquist", "Nyquist plot with exclusion disks");
  const auto shown = shown_breaks(drawn);
  const std::size_t at = *std::ranges::min_element(
      shown, {}, [&](std::size_t b) { return drawn.margins.at(b).disk.alpha; });
  const auto& disk = drawn.margins.at(at).disk;
  figure.caption = fmt::format(
      "Loop gain {}. No curve may enter the exclusion disk about \u22121 of the allowed Ms. The "
      "disk of the smallest disk margin, alpha = {:.3f} ({}, {:.2f} Hz: gain {:.2f} to {:.2f}, "
      "phase {:.0f}\u00b0), touches its curve. ",
      at_breaks(drawn), disk.alpha, break_name(at), disk.frequency / two_pi, disk.lowest_gain,
      disk.highest_gain, disk.phase_deg);
  figure.caption += controller_conditions(drawn);
  figure.equal_scales = true;
  figure.x = {.label = "real part", .lowest = -3.5, .highest = 1.5};
  FigurePanel panel;
  panel.y = {.label = "imaginary part", .lowest = -2.5, .highest = 2.0};
  for (const std::size_t b : shown) {
    panel.series.push_back({.name = break_name(b),
                            .x = numbers(on_grid.gain.at(b).real()),
                            .y = numbers(on_grid.gain.at(b).imag())});
  }
  panel.marks.push_back({-1.0, 0.0, "\u22121"});
  for (const auto& [goal, label] : allowed_peaks(drawn)) {
    panel.circles.push_back({-1.0, 0.0, 1.0 / goal, label});
  }
  if (disk.lowest_gain > 0.0 && std::isfinite(disk.highest_gain)) {
    const double near = 1.0 / disk.highest_gain, away = 1.0 / disk.lowest_gain;
    panel.circles.push_back({-0.5 * (near + away), 0.0, 0.5 * (away - near), "disk margin"});
  }
  figure.panels.push_back(std::move(panel));
  return figure;
}

Figure nichols_figure(const DrawnController& drawn, const ControllerResponses& on_grid) {
  Figure figure = controller_figure(drawn, "nichols", "Nichols chart with exclusion regions");
  figure.caption = fmt::format(
      "Loop gain {}, magnitude against phase, phases within \u2212360\u00b0 to 0\u00b0. No curve "
      "may enter the region about \u2212180\u00b0 and 0 dB in which |1/(1 + L)| exceeds the "
      "allowed Ms. {}",
      at_breaks(drawn), controller_conditions(drawn));
  figure.x = {.label = "phase", .unit = "deg", .lowest = -360.0, .highest = 0.0};
  FigurePanel panel;
  panel.y = {.label = "loop gain", .unit = "dB", .lowest = -30.0, .highest = 40.0};
  for (const std::size_t b : shown_breaks(drawn)) {
    panel.series.push_back(nichols_curve(break_name(b), on_grid.gain.at(b)));
  }
  constexpr Eigen::Index points = 181;
  const Eigen::ArrayXd angle = Eigen::ArrayXd::LinSpaced(points, 0.0, two_pi);
  for (const auto& [goal, label] : allowed_peaks(drawn)) {
    Eigen::ArrayXcd contour(points);
    for (Eigen::Index i = 0; i < points; ++i) contour[i] = -1.0 + std::polar(1.0 / goal, angle[i]);
    FigureSeries limit = nichols_curve("limit: " + label, contour);
    limit.style = SeriesStyle::dashed;
    panel.series.push_back(std::move(limit));
  }
  panel.marks.push_back({-180.0, 0.0, "\u22121"});
  figure.panels.push_back(std::move(panel));
  return figure;
}

}  // namespace boresight::app
