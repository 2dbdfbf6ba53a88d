#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include <boresight/app/figures/figure_parts.hpp>
#include <boresight/app/figures/thinned_series.hpp>
#include <boresight/app/figures/trace_figures.hpp>
#include <boresight/app/report/present_gains.hpp>
#include <boresight/app/report/sky_units.hpp>

namespace boresight::app {
namespace {

using design::ErrorTrace;

constexpr double shown_wind = 120.0;  // s

Eigen::VectorXd times(const ErrorTrace& trace, Eigen::Index count) {
  return Eigen::VectorXd::LinSpaced(count, 0.0, trace.interval * static_cast<double>(count - 1));
}

// The first `count` errors in mdeg against time.
FigureSeries error_series(std::string name, SeriesStyle style, const ErrorTrace& trace,
                          const Eigen::VectorXd& errors, Eigen::Index count) {
  auto curve = thinned(times(trace, count), errors.head(count) / millidegree);
  return make_series(std::move(name), style, std::move(curve.x), std::move(curve.y));
}

FigureSeries error_series(std::string name, SeriesStyle style, const ErrorTrace& trace,
                          const Eigen::VectorXd& errors) {
  return error_series(std::move(name), style, trace, errors, errors.size());
}

double rms_of(const Eigen::VectorXd& errors) {
  return std::sqrt(errors.squaredNorm() / static_cast<double>(errors.size())) / millidegree;
}

FigurePanel error_panel(std::string what) {
  return make_panel(make_axis(std::move(what), "mdeg"));
}

// What the present gains make of the same record.
std::string present_sentence(const TimeDomainSection& section) {
  if (!section.present) return {};
  const auto& present = *section.present;
  const std::string label = present.retuned
                                ? present_label(present.structure, present.retuned)
                                : fmt::format("the present gains ({})", present.structure);
  if (present.in_wind.boresight.size() == 0) {
    return fmt::format(" With {} the run did not complete.", label);
  }
  return fmt::format(" With {}: {:.3f} mdeg rms in the same record.", label,
                     rms_of(present.in_wind.boresight));
}

Figure wind_figure(const TimeDomainSection& section, const std::string& heading) {
  const ErrorTrace& trace = section.result.wind.trace;
  const auto count = [](const ErrorTrace& one) {
    return std::min(one.boresight.size(),
                    static_cast<Eigen::Index>(std::llround(shown_wind / one.interval)));
  };
  FigurePanel whole = error_panel("boresight error");
  if (section.present && section.present->in_wind.boresight.size() > 0) {
    const ErrorTrace& before = section.present->in_wind;
    whole.series.push_back(
        error_series(present_label(section.present->structure, section.present->retuned),
                     SeriesStyle::dashed, before, before.boresight, count(before)));
  }
  whole.series.push_back(
      error_series(section.controller, SeriesStyle::line, trace, trace.boresight, count(trace)));
  FigurePanel parts = error_panel("parts of the error, " + section.controller);
  parts.series.push_back(
      error_series("encoder error", SeriesStyle::line, trace, trace.encoder, count(trace)));
  const Eigen::VectorXd beyond = trace.boresight - trace.encoder;
  parts.series.push_back(
      error_series("flexure beyond the encoder", SeriesStyle::dashed, trace, beyond, count(trace)));
  Figure figure = make_figure(
      "time-domain-wind", heading, "Boresight error in wind against time",
      fmt::format("Nonlinear antenna, one record of wind of {:.3g} m/s, about the mean. Whole "
                  "record: {:.3f} mdeg rms, encoder error {:.3f}, flexure beyond the encoder "
                  "{:.3f}; the parts are correlated, and their sum is the boresight error.{}",
                  section.wind_speed, rms_of(trace.boresight), rms_of(trace.encoder),
                  rms_of(beyond), present_sentence(section)),
      make_axis("time", "s"));
  figure.panels.push_back(std::move(whole));
  figure.panels.push_back(std::move(parts));
  return figure;
}

std::string seen(const design::LimitCycleResult& run) {
  const std::string rate = run.rate == 0.0
                               ? std::string("At rest")
                               : fmt::format("At {:.3g} mdeg/s", run.rate / millidegree);
  if (!run.limit_cycle) return fmt::format("{}: no limit cycle.", rate);
  const std::string frequency =
      run.frequency ? fmt::format(" at {:.3g} Hz", *run.frequency) : std::string();
  return fmt::format("{}: limit cycle of {:.3f} mdeg amplitude in boresight{}.", rate,
                     run.boresight_amplitude / millidegree, frequency);
}

std::vector<Figure> limit_cycle_figure(const TimeDomainSection& section,
                                       const std::string& heading) {
  Figure figure = make_figure(
      "time-domain-limit-cycle", heading, "Limit cycle against time",
      fmt::format("Nonlinear antenna, {}, without wind and sensor noise: the end of the run of the "
                  "largest limit cycle, or of the largest error where there is none; a straight "
                  "line is removed.",
                  section.controller),
      make_axis("time", "s"));
  for (const auto& run : section.result.limit_cycles) {
    if (run.status != design::RunStatus::complete || run.trace.boresight.size() == 0) continue;
    FigurePanel panel = error_panel(run.rate == 0.0 ? "error at rest" : "error when tracking");
    panel.series.push_back(
        error_series("boresight", SeriesStyle::line, run.trace, run.trace.boresight));
    panel.series.push_back(
        error_series("encoder", SeriesStyle::dashed, run.trace, run.trace.encoder));
    figure.panels.push_back(std::move(panel));
    figure.caption += " " + seen(run);
  }
  if (figure.panels.empty()) return {};
  return {std::move(figure)};
}

std::vector<Figure> reversal_figure(const TimeDomainSection& section, const std::string& heading) {
  const auto& reversal = section.result.reversal;
  if (!reversal || reversal->trace.boresight.size() == 0) return {};
  Figure figure = make_figure(
      "time-domain-reversal", heading, "Velocity reversals against time",
      fmt::format("Nonlinear antenna, {}, without wind and sensor noise; the rate changes between "
                  "+{:.3g} and \u2212{:.3g} mdeg/s at the vertical lines. Peak error {:.3f} mdeg "
                  "at the encoder, {:.3f} mdeg in boresight about its mean.",
                  section.controller, section.options.tracking_rate / millidegree,
                  section.options.tracking_rate / millidegree,
                  reversal->encoder_error / millidegree, reversal->boresight_error / millidegree),
      make_axis("time", "s"));
  FigurePanel boresight = error_panel("boresight error");
  FigurePanel encoder = error_panel("encoder error");
  const ErrorTrace& without = reversal->trace_without_friction;
  const auto draw = [&](const Eigen::VectorXd& errors, const Eigen::VectorXd& frictionless,
                        FigurePanel& panel) {
    panel.series.push_back(
        error_series("with friction", SeriesStyle::line, reversal->trace, errors));
    if (frictionless.size() > 0) {
      panel.series.push_back(
          error_series("without friction", SeriesStyle::dashed, without, frictionless));
    }
    const double end = reversal->trace.interval * static_cast<double>(errors.size() - 1);
    const int turns = static_cast<int>(std::lround(end / reversal->leg));
    for (int turn = 0; turn < turns; ++turn) {
      panel.lines.push_back(vertical_line(reversal->leg * turn, ""));
    }
    figure.panels.push_back(std::move(panel));
  };
  draw(reversal->trace.boresight, without.boresight, boresight);
  draw(reversal->trace.encoder, without.encoder, encoder);
  return {std::move(figure)};
}

}  // namespace

std::vector<Figure> trace_figures(const TimeDomainSection& section, const std::string& heading) {
  std::vector<Figure> figures;
  if (section.result.wind.trace.boresight.size() > 0) {
    figures.push_back(wind_figure(section, heading));
  }
  std::ranges::move(limit_cycle_figure(section, heading), std::back_inserter(figures));
  std::ranges::move(reversal_figure(section, heading), std::back_inserter(figures));
  return figures;
}

}  // namespace boresight::app
