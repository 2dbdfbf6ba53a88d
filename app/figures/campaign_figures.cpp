#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <boresight/app/figures/campaign_figures.hpp>
#include <boresight/app/figures/figure_parts.hpp>
#include <boresight/app/figures/friction_figure.hpp>
#include <boresight/app/figures/inertia_figures.hpp>
#include <boresight/app/figures/resonance_figures.hpp>
#include <boresight/app/figures/thinned_series.hpp>
#include <boresight/io/campaign/recommended_values.hpp>

namespace boresight::app {
namespace {

constexpr const char* fit_heading = "Fit of one model to all records";

// What the records can hardly tell from the inertia and from the oil's stiffness.
std::vector<Figure> correlation_figure(const io::CampaignSection& section) {
  if (!io::recommended(section)) return {};
  const auto& fit = *section.grey_box;
  Figure figure =
      make_figure("campaign-correlation", fit_heading, "Correlated estimates",
                  fmt::format("Correlation of the combined estimates over {} samples: near +-1 the "
                              "records determine only a combination of the two quantities.",
                              fit.random_samples.size()),
                  make_axis("correlation", ""));
  FigurePanel panel;
  for (const auto& q : fit.quantities) panel.y.categories.push_back(q.name);
  for (std::size_t i = 0; i < fit.quantities.size(); ++i) {
    const auto& name = fit.quantities[i].name;
    if (name != "inertia" && name != "oil stiffness") continue;
    FigureSeries bars = make_series("with " + name, SeriesStyle::bars);
    for (std::size_t j = 0; j < fit.quantities.size(); ++j) {
      bars.x.push_back(fit.correlation(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
      bars.y.push_back(static_cast<double>(j));
    }
    panel.series.push_back(std::move(bars));
  }
  if (panel.series.empty()) return {};
  figure.panels.push_back(std::move(panel));
  return {figure};
}

// Stated numbers that the records speak of, in standard uncertainties.
std::vector<Figure> contradiction_figure(const io::CampaignSection& section) {
  if (section.contradictions.empty()) return {};
  constexpr double maximum = 20.0;
  Figure figure =
      make_figure("campaign-contradictions", "Stated numbers that the records contradict",
                  "Records against the case",
                  "Records minus stated value, over the root sum of squares of both standard "
                  "uncertainties; cut off at 20.",
                  make_axis("difference", "standard uncertainties"));
  FigurePanel panel;
  FigureSeries bars = make_series("records minus stated", SeriesStyle::bars);
  for (const auto& one : section.contradictions) {
    bars.x.push_back(std::clamp(one.normalised, -maximum, maximum));
    bars.y.push_back(static_cast<double>(panel.y.categories.size()));
    panel.y.categories.push_back(one.key);
  }
  panel.series.push_back(std::move(bars));
  for (const double limit : {-2.0, 2.0}) {
    panel.lines.push_back(vertical_line(limit, ""));
  }
  figure.panels.push_back(std::move(panel));
  return {figure};
}

std::vector<Figure> hold_out_figure(const io::CampaignSection& section) {
  if (!section.hold_out) return {};
  const auto& held = *section.hold_out;
  const auto& recorded = held.result.recorded;
  const auto& simulated = held.result.simulated;
  Figure figure = make_figure(
      "campaign-hold-out", fit_heading, fmt::format("Record {} predicted", held.record),
      fmt::format("Model fitted to the other records, driven by this record's valve command. Rms "
                  "residual: {:.0f} % of the rate's variation, {:.0f} % of the torque's.",
                  100.0 * held.result.error.rate_error, 100.0 * held.result.error.torque_error),
      make_axis("time", "s"));
  const auto panel = [&](const char* label, const char* unit, const Eigen::VectorXd& seen,
                         const Eigen::VectorXd& predicted) {
    FigurePanel one = make_panel(make_axis(label, unit));
    for (const bool measured : {true, false}) {
      const Eigen::VectorXd& values = measured ? seen : predicted;
      const Eigen::VectorXd time = Eigen::VectorXd::LinSpaced(
          values.size(), 0.0, recorded.sample_time * static_cast<double>(values.size() - 1));
      const auto curve = thinned(time, values);
      one.series.push_back(make_series(measured ? "recorded" : "predicted",
                                       measured ? SeriesStyle::line : SeriesStyle::dashed, curve.x,
                                       curve.y));
    }
    figure.panels.push_back(std::move(one));
  };
  panel("motor rate", "rad/s", recorded.rate, simulated.rate);
  panel("torque", "N.m", recorded.torque, simulated.torque);
  return {figure};
}

}  // namespace

std::vector<Figure> campaign_figures(const io::CampaignSection& section) {
  std::vector<Figure> figures;
  for (auto&& some : {inertia_figures(section), ringing_figures(section), friction_figure(section),
                      contradiction_figure(section), hold_out_figure(section),
                      correlation_figure(section), resonance_figures(section)}) {
    figures.insert(figures.end(), some.begin(), some.end());
  }
  return figures;
}

}  // namespace boresight::app
