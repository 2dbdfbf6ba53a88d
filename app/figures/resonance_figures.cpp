#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include <boresight/app/figures/figure_id.hpp>
#include <boresight/app/figures/figure_parts.hpp>
#include <boresight/app/figures/resonance_figures.hpp>
#include <boresight/app/figures/thinned_series.hpp>
#include <boresight/app/report/sky_units.hpp>

namespace boresight::app {
namespace {

using identification::LineSide;

constexpr std::size_t labelled_peaks = 8;

std::string heading_of(const io::CampaignSection& section) {
  return section.resonance && !section.resonance->notes.empty()
             ? "What the resonance alone shows"
             : "Inertia at the motor shaft, by method (95 % intervals)";
}

FigureSeries curve(const std::string& name, SeriesStyle style, const Eigen::VectorXd& x,
                   const Eigen::VectorXd& y, double scale = 1.0) {
  const auto points = thinned(x, y * scale);
  return make_series(name, style, points.x, points.y);
}

std::string port_name(const identification::RingingPlot& plot) {
  return fmt::format("motor {}, {}", plot.motor + 1,
                     plot.side == LineSide::inlet ? "inlet" : "outlet");
}

// The part of a spectrum about the lines.
std::pair<Eigen::Index, Eigen::Index> about_lines(const identification::SloshResult& result,
                                                  const Eigen::VectorXd& frequency) {
  double lowest = std::numeric_limits<double>::infinity(), highest = 0.0;
  for (const auto& line : result.lines) {
    lowest = std::min(lowest, line.frequency.value);
    highest = std::max(highest, line.frequency.value);
  }
  Eigen::Index first = 0, count = 0;
  while (first < frequency.size() && frequency(first) < 0.6 * lowest) ++first;
  while (first + count < frequency.size() && frequency(first + count) < 1.4 * highest) ++count;
  return {first, count};
}

// A panel a port; the outlets ring as the inlets do and are left to the spectra.
Figure ring_times(const io::SloshTest& test, double sample_time) {
  Figure figure;
  figure.id = figure_id(fmt::format("ringing {}", test.record));
  figure.title = fmt::format("Oil lines ringing ({})", test.record);
  figure.caption =
      "Port pressures after the strongest event, with the damped cosine fitted to each; slow part "
      "and cross-talk of other lines removed.";
  figure.x = make_axis("time from the start of the window", "s");
  constexpr std::size_t max_panels = 4;
  for (const auto& plot : test.result.plots) {
    if (plot.side != LineSide::inlet || figure.panels.size() == max_panels) continue;
    const Eigen::VectorXd time = Eigen::VectorXd::LinSpaced(
        plot.pressure.size(), 0.0, sample_time * static_cast<double>(plot.pressure.size() - 1));
    figure.panels.push_back(
        make_panel(make_axis(port_name(plot), "MPa"),
                   {curve("recorded", SeriesStyle::line, time, plot.pressure, 1.0 / megapascal),
                    curve("fitted", SeriesStyle::dashed, time, plot.fitted, 1.0 / megapascal)}));
  }
  return figure;
}

Figure ring_spectra(const io::SloshTest& test) {
  Figure figure;
  figure.id = figure_id(fmt::format("ringing spectra {}", test.record));
  figure.title = fmt::format("Frequencies of the oil lines ({})", test.record);
  figure.caption =
      "Amplitude spectra of the port pressures after the strongest event, with the lines' first "
      "half-wave modes fitted over all events.";
  figure.x = make_axis("frequency", "Hz");
  for (const LineSide side : {LineSide::inlet, LineSide::outlet}) {
    FigurePanel panel = make_panel(
        make_axis(side == LineSide::inlet ? "inlet pressure" : "outlet pressure", "MPa"));
    for (const auto& plot : test.result.plots) {
      if (plot.side != side) continue;
      const auto [first, count] = about_lines(test.result, plot.frequency);
      if (count == 0) continue;
      panel.series.push_back(curve(fmt::format("motor {}", plot.motor + 1), SeriesStyle::line,
                                   plot.frequency.segment(first, count),
                                   plot.amplitude.segment(first, count), 1.0 / megapascal));
      for (const auto& line : test.result.lines) {
        if (line.motor != plot.motor || line.side != side) continue;
        Eigen::Index nearest = 0;
        (plot.frequency.array() - line.frequency.value).abs().minCoeff(&nearest);
        panel.marks.push_back({line.frequency.value, plot.amplitude(nearest) / megapascal,
                               fmt::format("{}: {:.2f} Hz", line.motor + 1, line.frequency.value)});
      }
    }
    if (!panel.series.empty()) figure.panels.push_back(std::move(panel));
  }
  return figure;
}

Figure spectrum_figure(const identification::TorqueSpectrum& spectrum, double expected) {
  Figure figure;
  figure.id = figure_id(fmt::format("torque spectrum {}", spectrum.record));
  figure.title = fmt::format("Torque spectrum ({})", spectrum.record);
  figure.caption = fmt::format(
      "Amplitude spectrum of the torque of all motors (Hann window){}. Peaks on a harmonic of the "
      "excitation are labelled: they are no evidence of a resonance.{}",
      spectrum.period ? fmt::format(", period of the excitation {:.4g} s", *spectrum.period) : "",
      spectrum.on_harmonic ? " The peak selected by the paper's procedure lies on one." : "");
  figure.x = make_axis("frequency", "Hz");
  double end = 2.0 * expected;
  for (const auto& peak : spectrum.peaks) end = std::max(end, 1.2 * peak.frequency);
  Eigen::Index first = 0, last = 0;
  while (first < spectrum.frequency.size() && spectrum.frequency(first) <= 0.0) ++first;
  while (last < spectrum.frequency.size() && spectrum.frequency(last) <= end) ++last;
  if (last - first < 2) return figure;
  FigurePanel panel = make_panel(make_axis("torque amplitude", "N.m", AxisScale::logarithmic));
  panel.series.push_back(curve("torque", SeriesStyle::line,
                               spectrum.frequency.segment(first, last - first),
                               spectrum.amplitude.segment(first, last - first)));
  FigureSeries harmonics = make_series("peaks on harmonics", SeriesStyle::points);
  FigureSeries others = make_series("other peaks", SeriesStyle::points);
  for (std::size_t i = 0; i < spectrum.peaks.size(); ++i) {
    const auto& peak = spectrum.peaks[i];
    FigureSeries& series = peak.harmonic > 0 ? harmonics : others;
    series.x.push_back(peak.frequency);
    series.y.push_back(peak.height);
    // The highest are named; a name at every one would hide the curve.
    std::string label;
    if (i < labelled_peaks) {
      label = peak.harmonic > 0 ? fmt::format("harmonic {}", peak.harmonic)
                                : fmt::format("{:.3g} Hz", peak.frequency);
    }
    series.labels.push_back(std::move(label));
  }
  for (auto* series : {&harmonics, &others}) {
    if (!series->x.empty()) panel.series.push_back(std::move(*series));
  }
  if (expected > 0.0) {
    panel.lines.push_back(vertical_line(expected, "expected, rigid"));
  }
  if (spectrum.chosen) {
    panel.lines.push_back(vertical_line(spectrum.chosen->frequency, "selected as the mode"));
  }
  figure.panels.push_back(std::move(panel));
  return figure;
}

Figure step_ring_figure(const identification::StepRings& rings) {
  Figure figure;
  figure.id = "step-ring";
  figure.title = "Ring after a valve step";
  figure.caption = fmt::format(
      "Torque and rate without trend after the first of {} steps, antenna moving, with the mode "
      "fitted to both. Pooled over the steps: {:.4g} Hz ({:.4g} .. {:.4g}), damping ratio {:.3g}.",
      rings.rings.size(), rings.frequency.value, rings.frequency.lower, rings.frequency.upper,
      rings.damping_ratio.value);
  figure.x = make_axis("time from the start of the window", "s");
  if (rings.plot_signals.cols() != 2 || rings.plot_fitted.cols() != 2) return figure;
  for (const Eigen::Index column : {0, 1}) {
    figure.panels.push_back(make_panel(
        column == 0 ? make_axis("torque", "N.m") : make_axis("motor rate", "rad/s"),
        {curve("recorded", SeriesStyle::line, rings.plot_time, rings.plot_signals.col(column)),
         curve("fitted", SeriesStyle::dashed, rings.plot_time, rings.plot_fitted.col(column))}));
  }
  return figure;
}

Figure response_figure(const identification::DriveResponse& response) {
  Figure figure;
  figure.id = figure_id(fmt::format("torque over rate {}", response.record));
  figure.title = fmt::format("Torque over rate ({})", response.record);
  figure.caption =
      "Mechanical impedance at the motor shaft, independent of the hydraulics: measured, and "
      "fitted with inertia, structural modes and friction slope.";
  figure.x = make_axis("frequency", "Hz", AxisScale::logarithmic);
  const auto phase = [](const Eigen::VectorXcd& values) {
    return (values.array().arg() * (180.0 / std::numbers::pi)).matrix().eval();
  };
  const auto panel = [&](const FigureAxis& axis, const Eigen::VectorXd& measured,
                         const Eigen::VectorXd& fitted) {
    figure.panels.push_back(
        make_panel(axis, {curve("measured", SeriesStyle::points, response.frequency, measured),
                          curve("fitted", SeriesStyle::line, response.frequency, fitted)}));
  };
  if (response.frequency.size() == 0) return figure;
  const Eigen::VectorXcd measured = response.measured, fitted = response.fitted;
  panel(make_axis("|torque/rate|", "N.m.s/rad", AxisScale::logarithmic), measured.cwiseAbs(),
        fitted.cwiseAbs());
  panel(make_axis("phase", "deg"), phase(measured), phase(fitted));
  return figure;
}

}  // namespace

std::vector<Figure> ringing_figures(const io::CampaignSection& section) {
  std::vector<Figure> figures;
  for (const auto& test : section.slosh) {
    double sample_time = 0.0;
    for (const auto& record : section.notes.records) {
      if (record.name == test.record) sample_time = record.sample_time;
    }
    for (Figure figure : {ring_times(test, sample_time), ring_spectra(test)}) {
      if (figure.panels.empty()) continue;
      figure.section = fmt::format("Oil lines and bulk modulus ({})", test.record);
      figures.push_back(std::move(figure));
    }
  }
  return figures;
}

std::vector<Figure> resonance_figures(const io::CampaignSection& section) {
  std::vector<Figure> figures;
  if (!section.resonance) return figures;
  const auto& resonance = *section.resonance;
  for (const auto& spectrum : resonance.spectra) {
    figures.push_back(spectrum_figure(spectrum, resonance.expected_frequency));
  }
  if (resonance.rings) figures.push_back(step_ring_figure(*resonance.rings));
  for (const auto& response : resonance.responses) figures.push_back(response_figure(response));
  std::erase_if(figures, [](const Figure& figure) { return figure.panels.empty(); });
  for (auto& figure : figures) figure.section = heading_of(section);
  return figures;
}

}  // namespace boresight::app
