#include <string>
#include <utility>

#include <fmt/format.h>

#include <boresight/app/figures/ensemble_figures.hpp>
#include <boresight/app/figures/figure_parts.hpp>
#include <boresight/app/figures/frequency_curves.hpp>

namespace boresight::app {
namespace {

FigureSeries banded(const std::string& range, std::vector<double> x,
                    const design::EnsembleBand& band) {
  FigureSeries series =
      make_series("nominal, " + range, SeriesStyle::line, std::move(x), numbers(band.nominal));
  series.y_lower = numbers(band.lower);
  series.y_upper = numbers(band.upper);
  return series;
}

// "Band: range over 30 perturbed models, gains fixed."
std::string band_sentence(const design::EnsembleCurves& curves) {
  return fmt::format("Band: {}, gains fixed. ", range_name(curves));
}

Figure sensitivity_over_ensemble(const DrawnController& drawn,
                                 const design::EnsembleCurves& curves) {
  Figure figure = controller_figure(drawn, "ensemble-sensitivity", "Sensitivity over the ensemble");
  const auto shown = shown_breaks(drawn);
  figure.caption = fmt::format(
      "Magnitude of 1/(1 + L) with the loop broken {}. Dashed: the member of the highest Ms at "
      "that break. {}{}",
      shown.size() == curves.sensitivity.size()
          ? "in the rate loop (position loop open), at the valve command and in the position loop"
          : "at the valve command",
      band_sentence(curves), controller_conditions(drawn));
  const std::vector<double> hertz = in_hertz(curves.frequency);
  figure.x.lowest = hertz.front();
  for (const std::size_t b : shown) {
    FigurePanel panel;
    panel.y = {.label = "|S|, " + break_name(b), .scale = AxisScale::logarithmic, .lowest = 0.05};
    panel.series.push_back(banded(range_name(curves), hertz, curves.sensitivity.at(b)));
    const auto& worst = curves.worst.at(b);
    if (!worst.member.empty()) {
      panel.series.push_back(
          make_series("worst member", SeriesStyle::dashed, hertz, numbers(worst.sensitivity)));
      Eigen::Index at = 0;
      worst.sensitivity.maxCoeff(&at);
      panel.marks.push_back({hertz[static_cast<std::size_t>(at)], worst.sensitivity[at],
                             fmt::format("{:.2f}: {}", worst.peak, worst.member)});
    }
    const double goal = drawn.goals.sensitivity_peak.at(b);
    panel.lines.push_back(horizontal_line(goal, fmt::format("at most {:g}", goal)));
    figure.panels.push_back(std::move(panel));
  }
  return figure;
}

Figure step_figure(const DrawnController& drawn, const design::EnsembleCurves& curves,
                   const design::StepOverEnsemble& step, const char* id, const char* title,
                   const std::string& what) {
  Figure figure = controller_figure(drawn, id, title);
  figure.caption = what + " after a unit step of the command, continuous, without command " +
                   "preprocessor and feedforward. " + band_sentence(curves) +
                   controller_conditions(drawn);
  figure.x = make_axis("time", "s");
  FigurePanel panel = make_panel(make_axis("response per step", ""));
  panel.series.push_back(banded(range_name(curves), numbers(step.time), step.response));
  Eigen::Index at = 0;
  const double largest = step.response.nominal.maxCoeff(&at);
  if (const double overshoot = step.overshoot(); overshoot > 0.0) {
    panel.marks.push_back(
        {step.time[at], largest, fmt::format("overshoot {:.0f} %", 100.0 * overshoot)});
  }
  panel.lines.push_back(horizontal_line(1.0, "command"));
  figure.panels.push_back(std::move(panel));
  return figure;
}

}  // namespace

std::string range_name(const design::EnsembleCurves& curves) {
  if (curves.stable == curves.members) {
    return fmt::format("range over {} perturbed models", curves.members);
  }
  return fmt::format("range over the {} stable of {} perturbed models", curves.stable,
                     curves.members);
}

std::vector<Figure> ensemble_figures(const DrawnController& drawn) {
  if (!drawn.curves) return {};
  const design::EnsembleCurves& curves = *drawn.curves;
  std::vector<Figure> figures{sensitivity_over_ensemble(drawn, curves)};
  if (curves.rate_step.time.size() > 0) {
    figures.push_back(step_figure(drawn, curves, curves.rate_step, "rate-step",
                                  "Step response of the rate loop",
                                  "Tachometer, position loop open,"));
  }
  figures.push_back(step_figure(drawn, curves, curves.position_step, "position-step",
                                "Step response of the position loop", "Encoder"));
  return figures;
}

}  // namespace boresight::app
