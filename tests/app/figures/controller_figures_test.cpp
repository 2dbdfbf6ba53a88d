#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "design/reference_problem.hpp"
#include <boresight/app/figures/controller_figures.hpp>
#include <boresight/app/figures/figure_svg.hpp>
#include <boresight/control/loops/closed_loop.hpp>
#include <boresight/design/ensembles/plant_ensemble.hpp>
#include <boresight/design/tuning/design_study.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::app {
namespace {

struct DrawnCase {
  DrawnController drawn;
  design::EnsembleResult evaluated;
};

DrawnCase drawn_case() {
  design::TrackingProblem problem = reference::tracking_problem();
  problem.points_per_decade = 100;
  const auto controller = reference::cautious_gains();
  const auto assessed = design::assess(problem, controller, {});
  std::vector<design::EnsembleMember> members{{"nominal", problem.plant}, {"soft", problem.plant}};
  members[1].plant.drive.oil_stiffness *= 0.8;
  DrawnCase result;
  result.evaluated = design::evaluate(problem, members, controller, {}, 1);
  result.drawn.id = "controller";
  result.drawn.section = "Tuned loops";
  result.drawn.name = "PI with lag";
  result.drawn.problem = problem;
  result.drawn.controller = controller;
  result.drawn.margins = assessed.margins;
  result.drawn.noise_variance = assessed.tuning.evaluation.noise_variance;
  result.drawn.curves =
      design::ensemble_curves(problem, members, controller, result.evaluated, 15.0, 1);
  return result;
}

const Figure& figure_of(const std::vector<Figure>& figures, const std::string& id) {
  const auto found = std::ranges::find(figures, id, &Figure::id);
  EXPECT_NE(found, figures.end()) << id;
  return *found;
}

TEST(ControllerFigures, CanBeDrawnWithAndWithoutAnEnsemble) {
  DrawnController drawn = drawn_case().drawn;
  const auto with = controller_figures(drawn);
  drawn.curves.reset();
  const auto without = controller_figures(drawn);
  EXPECT_EQ(with.size(), without.size() + 3);
  for (const auto& figure : with) EXPECT_NO_THROW(to_svg(figure)) << figure.id;
}

TEST(ControllerFigures, MarkTheSmallestMarginsOfEachBreakOnTheBodePlot) {
  const DrawnController drawn = drawn_case().drawn;
  const auto figures = controller_figures(drawn);
  const Figure& bode = figure_of(figures, "controller-open-loop");
  const auto& gain = bode.panels[0].marks;
  const auto& phase = bode.panels[1].marks;
  for (const auto& margins : drawn.margins) {
    // At the gain crossover of the smallest phase margin the phase is that far from -180 degrees.
    EXPECT_TRUE(std::ranges::any_of(phase, [&](const FigureMark& mark) {
      const double turns = (mark.y + 180.0) / 360.0;
      return std::abs(std::abs(360.0 * (turns - std::round(turns))) - margins.phase_margin_deg) <
             0.5;
    }));
    if (std::isfinite(margins.increasing_gain_margin)) {
      const double decibels = -20.0 * std::log10(margins.increasing_gain_margin);
      EXPECT_TRUE(std::ranges::any_of(
          gain, [&](const FigureMark& mark) { return std::abs(mark.y - decibels) < 1e-9; }));
    }
    const double hertz = margins.sensitivity.frequency / two_pi;
    EXPECT_TRUE(std::ranges::any_of(gain, [&](const FigureMark& mark) { return mark.x == hertz; }));
  }
}

TEST(ControllerFigures, NicholsCurvesKeepOutOfTheRegionOfTheirPeak) {
  DrawnController drawn = drawn_case().drawn;
  for (std::size_t b = 0; b < 3; ++b) {
    drawn.goals.sensitivity_peak.at(b) = drawn.margins.at(b).sensitivity.magnitude;
  }
  const auto figures = controller_figures(drawn);
  const Figure& nichols = figure_of(figures, "controller-nichols");
  const auto sensitivity = [](double phase, double decibels) {
    return 1.0 /
           std::abs(1.0 + std::polar(std::pow(10.0, decibels / 20.0), phase * two_pi / 360.0));
  };
  const auto& series = nichols.panels.front().series;
  ASSERT_GE(series.size(), 4U);
  for (std::size_t b = 0; b < 3; ++b) {
    double highest = 0.0;
    for (std::size_t i = 0; i < series[b].x.size(); ++i) {
      if (std::isnan(series[b].x[i])) continue;
      EXPECT_LE(series[b].x[i], 0.0);
      EXPECT_GE(series[b].x[i], -360.0);
      highest = std::max(highest, sensitivity(series[b].x[i], series[b].y[i]));
    }
    EXPECT_NEAR(highest, drawn.goals.sensitivity_peak.at(b), 0.02 * highest);
  }
  // Every point of a contour has the allowed |S|.
  const auto& contour = series[3];
  for (std::size_t i = 0; i < contour.x.size(); ++i) {
    if (std::isnan(contour.x[i])) continue;
    EXPECT_NEAR(sensitivity(contour.x[i], contour.y[i]), drawn.goals.sensitivity_peak[0], 1e-9);
  }
}

TEST(ControllerFigures, ShowNominalWorstAndRangeOfTheSensitivityWithItsLimit) {
  const DrawnCase one = drawn_case();
  const auto figures = controller_figures(one.drawn);
  const Figure& figure = figure_of(figures, "controller-ensemble-sensitivity");
  ASSERT_EQ(figure.panels.size(), 3U);
  for (std::size_t b = 0; b < 3; ++b) {
    const auto& panel = figure.panels[b];
    ASSERT_EQ(panel.series.size(), 2U);
    EXPECT_FALSE(panel.series[0].y_upper.empty());
    EXPECT_EQ(std::ranges::max(panel.series[0].y_upper),
              one.drawn.curves->sensitivity.at(b).upper.maxCoeff());
    ASSERT_EQ(panel.lines.size(), 1U);
    EXPECT_EQ(panel.lines.front().at, one.drawn.goals.sensitivity_peak.at(b));
  }
}

TEST(ControllerFigures, RmsAgainstWindHasTheRangeOfTheFirstController) {
  const DrawnCase one = drawn_case();
  const DrawnController& drawn = one.drawn;
  const auto figure = rms_against_wind("rms", "Tuned loops", drawn.problem,
                                       {{"PI with lag", drawn.controller, drawn.noise_variance},
                                        {"again", drawn.controller, drawn.noise_variance}},
                                       {}, drawn.curves);
  const auto& series = figure.panels.front().series;
  ASSERT_EQ(series.size(), 2U);
  EXPECT_TRUE(series[1].y_lower.empty());
  ASSERT_EQ(series[0].x.size(), series[1].x.size());
  for (std::size_t i = 0; i < series[0].x.size(); ++i) {
    EXPECT_NEAR(series[0].x[i], series[1].x[i], 1e-9);
    EXPECT_NEAR(series[0].y[i], series[1].y[i], 2e-3 * series[1].y[i]);
    EXPECT_LE(series[0].y_lower[i], series[0].y[i]);
    EXPECT_GE(series[0].y_upper[i], series[0].y[i]);
  }
}

}  // namespace
}  // namespace boresight::app
