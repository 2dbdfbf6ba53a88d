#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include <fmt/format.h>

#include <boresight/app/figures/commission_figures.hpp>
#include <boresight/app/figures/figure_id.hpp>
#include <boresight/app/figures/figure_parts.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::app {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr const char* plan_heading = "Commissioning plan for ";
constexpr const char* stages_heading = "Stages (* changed from the previous stage)";

FigureAxis stage_axis(const CommissionReport& report) {
  FigureAxis axis = make_axis("stage", "");
  for (std::size_t i = 0; i < report.sheets.size(); ++i) {
    axis.categories.push_back(fmt::format("{}", i + 1));
  }
  return axis;
}

// Which stages are which: beside the figures, whose axis has numbers only.
std::string stage_names(const CommissionReport& report) {
  std::string names;
  std::size_t from = 0;
  for (std::size_t i = 1; i <= report.sheets.size(); ++i) {
    const auto kind = report.sheets[from].stage.kind;
    if (i < report.sheets.size() && report.sheets[i].stage.kind == kind) continue;
    names += fmt::format(
        "{}{}: {}", names.empty() ? "" : ", ",
        i - from == 1 ? fmt::format("{}", from + 1) : fmt::format("{} to {}", from + 1, i),
        to_string(kind));
    from = i;
  }
  return names;
}

Figure gains(const CommissionReport& report) {
  Figure figure = make_figure(
      "commission-gains", stages_heading, "Gains over the stages",
      fmt::format("Each active gain over its final value. Stages {}.", stage_names(report)),
      stage_axis(report));
  FigurePanel panel =
      make_panel(make_axis("gain over its final value", "", AxisScale::logarithmic));
  const auto& last = report.sheets.back().gains;
  for (const auto& final_gain : last) {
    if (!(final_gain.value > 0.0)) continue;
    FigureSeries series = make_series(fmt::format("{} {}", final_gain.symbol, final_gain.name),
                                      SeriesStyle::line_and_points);
    for (std::size_t i = 0; i < report.sheets.size(); ++i) {
      const auto& gains = report.sheets[i].gains;
      const auto found = std::ranges::find(gains, final_gain.symbol, &StageGain::symbol);
      series.x.push_back(static_cast<double>(i));
      series.y.push_back(
          found == gains.end() || !(found->value > 0.0) ? none : found->value / final_gain.value);
    }
    panel.series.push_back(std::move(series));
  }
  if (!panel.series.empty()) figure.panels.push_back(std::move(panel));
  return figure;
}

using BandOf = std::function<const design::PlantBand&(const design::StageExpectation&)>;
using LimitOf = std::function<double(const design::AbortLimits&)>;

// A quantity on the case's own plant with its band over the plants, and where to give up.
FigurePanel expected_panel(const CommissionReport& report, const FigureAxis& axis, double scale,
                           const BandOf& band_of, const LimitOf& limit_of) {
  FigureSeries expected =
      make_series("expected, band over the plants", SeriesStyle::line_and_points);
  FigureSeries limit = make_series("abort limit", SeriesStyle::dashed);
  bool limited = false;
  for (std::size_t i = 0; i < report.sheets.size(); ++i) {
    const auto& stage = report.sheets[i].stage;
    const auto& band = band_of(stage.expected);
    const auto x = static_cast<double>(i);
    const auto finite = [](double value) { return std::isfinite(value) ? value : none; };
    expected.x.push_back(x);
    expected.y.push_back(finite(band.nominal * scale));
    expected.y_lower.push_back(finite(band.lower * scale));
    expected.y_upper.push_back(finite(band.upper * scale));
    limit.x.push_back(x);
    limit.y.push_back(limit_of ? finite(limit_of(stage.abort) * scale) : none);
    limited = limited || std::isfinite(limit.y.back());
  }
  FigurePanel panel = make_panel(axis, {std::move(expected)});
  if (limited) panel.series.push_back(std::move(limit));
  return panel;
}

bool has_points(const FigurePanel& panel) {
  return std::ranges::any_of(panel.series, [](const FigureSeries& series) {
    return std::ranges::any_of(series.y, [](double value) { return std::isfinite(value); });
  });
}

Figure responses(const CommissionReport& report) {
  using design::AbortLimits;
  using design::StageExpectation;
  const double sky = 1.0 / (report.gear_ratio * millidegree);
  Figure figure =
      make_figure("commission-responses", stages_heading, "Expected response at each stage",
                  fmt::format("Nominal plant, with {:g} % prediction interval ({} plants, {}). "
                              "Beyond the abort limit go back to the previous stage. Stages {}.",
                              100.0 * report.options.confidence, report.ensemble_size,
                              report.ensemble_source, stage_names(report)),
                  stage_axis(report));
  figure.panels.push_back(expected_panel(
      report, make_axis("overshoot of a step", "%"), 100.0,
      [](const StageExpectation& e) -> const design::PlantBand& { return e.overshoot; },
      [](const AbortLimits& abort) { return abort.overshoot; }));
  figure.panels.push_back(expected_panel(
      report, make_axis("rise time", "s"), 1.0,
      [](const StageExpectation& e) -> const design::PlantBand& { return e.rise_time; }, {}));
  figure.panels.push_back(expected_panel(
      report, make_axis("valve rms, still air", "rad/s"), 1.0,
      [](const StageExpectation& e) -> const design::PlantBand& { return e.calm_valve; },
      [](const AbortLimits& abort) { return abort.calm_valve_rms; }));
  figure.panels.push_back(expected_panel(
      report, make_axis("encoder rms, still air", "mdeg"), sky,
      [](const StageExpectation& e) -> const design::PlantBand& { return e.calm_encoder; },
      [](const AbortLimits& abort) { return abort.calm_encoder_rms; }));
  figure.panels.push_back(expected_panel(
      report, make_axis(fmt::format("boresight rms, {:.3g} m/s", report.wind_speed), "mdeg"), sky,
      [](const StageExpectation& e) -> const design::PlantBand& { return e.boresight_rms; }, {}));
  std::erase_if(figure.panels, [](const FigurePanel& panel) { return !has_points(panel); });
  return figure;
}

Figure margins(const CommissionReport& report) {
  Figure figure = make_figure(
      "commission-margins", plan_heading + report.structure, "Margins by stage",
      fmt::format(
          "Largest Ms of the closed loops, with its band over the plants, and the loop-gain factor "
          "that brings the worst plant to the abort limit of Ms. Stages {}.",
          stage_names(report)),
      stage_axis(report));
  FigurePanel peak = expected_panel(
      report, make_axis("Ms", ""), 1.0,
      [](const design::StageExpectation& e) -> const design::PlantBand& { return e.peak; }, {});
  FigureSeries largest = make_series("worst plant", SeriesStyle::points);
  FigureSeries reserve =
      make_series("gain reserve of the worst plant", SeriesStyle::line_and_points);
  for (std::size_t i = 0; i < report.sheets.size(); ++i) {
    const auto& stage = report.sheets[i].stage;
    const auto x = static_cast<double>(i);
    largest.x.push_back(x);
    largest.y.push_back(stage.expected.peak.largest);
    reserve.x.push_back(x);
    reserve.y.push_back(std::isfinite(stage.abort.gain_reserve) ? stage.abort.gain_reserve : none);
    reserve.labels.push_back(stage.abort.worst_plant);
  }
  peak.series.push_back(std::move(largest));
  peak.lines.push_back(horizontal_line(report.options.sensitivity_limit, "limit at each stage"));
  peak.lines.push_back(horizontal_line(report.options.abort_peak, "abort"));
  figure.panels.push_back(std::move(peak));
  FigurePanel factor = make_panel(make_axis("gain reserve", ""), {std::move(reserve)});
  if (has_points(factor)) figure.panels.push_back(std::move(factor));
  return figure;
}

std::vector<Figure> comparisons(const CommissionReport& report) {
  std::vector<Figure> figures;
  for (const auto& channel : report.comparisons) {
    const auto& compared = channel.comparison;
    if (!channel.not_compared.empty() || compared.frequency.size() < 2) continue;
    Figure figure = make_figure(
        figure_id(fmt::format("compared {}", to_string(channel.quantity))),
        fmt::format("Before and after: '{}' and '{}'", report.before, report.after),
        fmt::format("Before and after: {}", to_string(channel.quantity)),
        "Spectral densities of the two records and the ratio of their rms by band with 95 % "
        "intervals, for stationary records under the same disturbance.",
        make_axis("frequency", "Hz", AxisScale::logarithmic));
    FigurePanel density = make_panel(make_axis(
        "density", fmt::format("({})2/Hz", unit_of(channel.quantity)), AxisScale::logarithmic));
    density.series = {
        make_series("before", SeriesStyle::line, compared.frequency, compared.density_before),
        make_series("after", SeriesStyle::dashed, compared.frequency, compared.density_after)};
    FigureSeries ratios = make_series("after/before", SeriesStyle::points);
    for (const auto& band : compared.bands) {
      ratios.x.push_back(std::sqrt(band.lowest * band.highest));
      ratios.y.push_back(band.ratio);
      ratios.x_lower.push_back(band.lowest);
      ratios.x_upper.push_back(band.highest);
      ratios.y_lower.push_back(band.lower);
      ratios.y_upper.push_back(band.upper);
    }
    FigurePanel ratio = make_panel(make_axis("ratio of rms", ""), {std::move(ratios)});
    ratio.lines.push_back(horizontal_line(1.0, ""));
    figure.panels = {std::move(density), std::move(ratio)};
    figures.push_back(std::move(figure));
  }
  return figures;
}

}  // namespace

std::optional<Figure> stage_bode_figure(const CommissionReport& report, std::size_t stage,
                                        const std::string& section) {
  const StageSheet& sheet = report.sheets[stage];
  const design::StageBode& bode = sheet.stage.bode;
  if (bode.frequency.empty()) return std::nullopt;
  Figure figure = make_figure(
      fmt::format("commission-bode-{}", stage + 1), section,
      fmt::format("Expected Bode plot, stage {}", stage + 1),
      fmt::format("{} over its command, closed loop: nominal plant with {:g} % prediction interval "
                  "over the plants, linear, without feedforward.",
                  sheet.stage.controller.position_open ? "Tachometer" : "Encoder",
                  100.0 * report.options.confidence),
      make_axis("frequency", "Hz", AxisScale::logarithmic));
  const auto panel = [&](FigureAxis axis, const std::vector<design::PlantBand>& bands,
                         const auto& in_unit) {
    FigureSeries series = make_series("expected, band over the plants", SeriesStyle::line);
    for (std::size_t k = 0; k < bands.size(); ++k) {
      series.x.push_back(bode.frequency[k] / two_pi);
      series.y.push_back(in_unit(bands[k].nominal));
      series.y_lower.push_back(in_unit(bands[k].lower));
      series.y_upper.push_back(in_unit(bands[k].upper));
    }
    return make_panel(std::move(axis), {std::move(series)});
  };
  figure.panels.push_back(panel(make_axis("gain", "dB"), bode.gain,
                                [](double gain) { return 20.0 * std::log10(gain); }));
  figure.panels.push_back(
      panel(make_axis("phase", "deg"), bode.phase, [](double phase) { return phase / degree; }));
  return figure;
}

std::vector<Figure> commission_figures(const CommissionReport& report) {
  std::vector<Figure> figures;
  if (!report.sheets.empty()) figures = {margins(report), gains(report), responses(report)};
  std::erase_if(figures, [](const Figure& figure) { return figure.panels.empty(); });
  for (std::size_t i = 0; i < report.sheets.size(); ++i) {
    if (auto figure = stage_bode_figure(report, i, stages_heading)) {
      figures.push_back(*std::move(figure));
    }
  }
  for (auto& figure : comparisons(report)) figures.push_back(std::move(figure));
  return figures;
}

}  // namespace boresight::app
