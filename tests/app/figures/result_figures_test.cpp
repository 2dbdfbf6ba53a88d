#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include <boresight/app/figures/benchmark_figures.hpp>
#include <boresight/app/figures/commission_figures.hpp>
#include <boresight/app/figures/error_budget_figures.hpp>
#include <boresight/app/figures/figure_svg.hpp>
#include <boresight/app/figures/inertia_figures.hpp>
#include <boresight/app/figures/simulation_figures.hpp>
#include <boresight/app/figures/time_domain_figures.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::app {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

void expect_drawable(const std::vector<Figure>& figures) {
  for (const auto& figure : figures) {
    EXPECT_NO_THROW(to_svg(figure)) << figure.id;
    EXPECT_FALSE(figure.section.empty() || figure.title.empty() || figure.caption.empty())
        << figure.id;
  }
}

identification::InertiaMethod method(const std::string& name, double inertia, double ratio,
                                     double ratio_upper) {
  identification::InertiaMethod one;
  one.name = name;
  one.reflected_inertia.value = inertia;
  one.reflected_inertia.lower = 0.9 * inertia;
  one.reflected_inertia.upper = 1.1 * inertia;
  one.motor_to_load_ratio.value = ratio;
  one.motor_to_load_ratio.lower = 0.5 * ratio;
  one.motor_to_load_ratio.upper = ratio_upper;
  return one;
}

TEST(InertiaFigures, ShowPrintedValuesInSiAndOpenIntervalsToTheEdge) {
  IdentificationSection section;
  section.inertia.methods = {method("masses", 1.8, 2.0, 2.4), method("peak", 1.45, 4.6, infinity)};
  section.printed = {{"", ""}, {"1.0695 lbf.ft.s2", "4.63"}};
  const auto figures = inertia_figures(section);
  ASSERT_EQ(figures.size(), 2U);
  expect_drawable(figures);
  const auto& inertia = figures[0].panels.front();
  EXPECT_EQ(inertia.y.categories, (std::vector<std::string>{"masses", "peak"}));
  ASSERT_EQ(inertia.series.size(), 2U);
  EXPECT_EQ(inertia.series[1].name, "as stated");
  EXPECT_NEAR(inertia.series[1].x.front(), 1.0695 * pound_foot_second_squared, 1e-6);
  EXPECT_EQ(inertia.series[1].y.front(), 1.0);
  const auto& ratio = figures[1].panels.front().series.front();
  EXPECT_EQ(ratio.x_upper[0], 2.4);
  EXPECT_TRUE(std::isfinite(ratio.x_upper[1]));
  EXPECT_GT(ratio.x_upper[1], *figures[1].x.highest);
  EXPECT_GT(*figures[1].x.highest, 4.63);
}

TEST(InertiaFigures, OutlierDoesNotSqueezeTheOthersAndKeepsItsValue) {
  IdentificationSection section;
  section.inertia.methods = {method("masses", 1.8, 2.0, 2.4), method("steps", 1.7, 1.9, 2.3),
                             method("peak", 180.0, 0.5, 40.0)};
  section.printed = {{"", ""}, {"", ""}, {"", ""}};
  const auto figures = inertia_figures(section);
  ASSERT_EQ(figures.size(), 2U);
  expect_drawable(figures);
  const auto& inertia = figures[0];
  EXPECT_LT(*inertia.x.highest, 3.6);
  EXPECT_GT(*inertia.x.highest, 1.98);
  EXPECT_LT(*inertia.x.lowest, 1.53);
  EXPECT_EQ(inertia.panels.front().series.front().x[2], 180.0);
  EXPECT_EQ(figures[1].panels.front().series.front().x_upper[2], 40.0);
  EXPECT_LT(*figures[1].x.highest, 5.0);
  EXPECT_GT(*figures[1].x.highest, 2.4);
}

TEST(InertiaFigures, DrawNoCombinedValueOfMethodsThatContradictOneAnother) {
  IdentificationSection section;
  section.inertia.methods = {method("masses", 1.8, 2.0, 2.4), method("peak", 1.45, 4.6, infinity)};
  section.printed = {{"", ""}, {"", ""}};
  section.combined.emplace();
  section.combined->value = 1.6;
  section.combined->lower = 1.5;
  section.combined->upper = 1.7;
  section.combined->degrees_of_freedom = 1;
  section.combined->heterogeneity = 0.5;
  EXPECT_EQ(inertia_figures(section)[0].panels.front().y.categories.size(), 3U);
  section.combined->heterogeneity = 50.0;
  ASSERT_TRUE(section.combined->contradictory());
  const auto figures = inertia_figures(section);
  EXPECT_EQ(figures[0].panels.front().y.categories, (std::vector<std::string>{"masses", "peak"}));
  EXPECT_EQ(figures[1].panels.front().y.categories, (std::vector<std::string>{"masses", "peak"}));
}

TEST(InertiaFigures, MarkAValueThatIsOffScaleAtTheEdge) {
  IdentificationSection section;
  section.inertia.methods = {method("masses", 1.8, 2.0, 2.4), method("peak", 1.45, 4.6, infinity),
                             method("astray", 30.0, 2.0, 2.4)};
  section.printed.resize(3);
  const auto figures = inertia_figures(section);
  const auto& panel = figures[0].panels.front();
  ASSERT_EQ(panel.marks.size(), 1U);
  EXPECT_EQ(panel.marks.front().y, 2.0);
  EXPECT_LT(panel.marks.front().x, 10.0);
}

TEST(UncertaintyFigures, ShowTheContributionsOfEachMethodThatHasSome) {
  IdentificationSection section;
  section.inertia.methods = {method("masses", 1.8, 2.0, 2.4), method("peak", 1.45, 4.6, infinity)};
  EXPECT_TRUE(uncertainty_figures(section).empty());
  auto& inertia = section.inertia.methods[1].reflected_inertia;
  inertia.standard_uncertainty = 0.1;
  inertia.contributions = {{"oil volume", 0.64}, {"frequency", 0.36}};
  const auto figures = uncertainty_figures(section);
  ASSERT_EQ(figures.size(), 1U);
  expect_drawable(figures);
  ASSERT_EQ(figures.front().panels.size(), 1U);
  const auto& panel = figures.front().panels.front();
  EXPECT_EQ(panel.y.categories, (std::vector<std::string>{"oil volume", "frequency"}));
  EXPECT_EQ(panel.series.front().x, (std::vector<double>{64.0, 36.0}));
  EXPECT_EQ(panel.series.front().labels, (std::vector<std::string>{"0.08 kg.m2", "0.06 kg.m2"}));
}

TEST(ErrorBudgetFigure, HasTheTotalBesideItsPartsAndTheBudgetsAsLines) {
  design::ErrorBudget errors;
  errors.wind = 0.3 * millidegree;
  errors.noise = 0.4 * millidegree;
  errors.total = 0.5 * millidegree;
  errors.static_error = 1.2 * millidegree;
  design::PointingBudget budget;
  budget.band = "Ka";
  budget.name = "0.1 dB mean loss";
  budget.rms = 0.527 * millidegree;
  const Figure figure =
      error_budget_figure("error-budget", "heading", "PI, 10 m/s.", errors, {budget});
  expect_drawable({figure});
  const auto& panel = figure.panels.front();
  ASSERT_EQ(panel.series.size(), 3U);
  double squares = 0.0;
  for (const double part : panel.series[0].x) squares += part * part;
  EXPECT_NEAR(panel.series[1].x.front(), std::sqrt(squares), 1e-12);
  EXPECT_NEAR(panel.series[2].x.front(), 1.2, 1e-12);
  ASSERT_EQ(panel.lines.size(), 1U);
  EXPECT_NEAR(panel.lines.front().at, 0.527, 1e-12);
}

TEST(TimeDomainFigures, LeadFromThePredictionToTheSimulation) {
  TimeDomainSection section;
  section.controller = "PI";
  auto& wind = section.result.wind;
  wind.predicted_rms = 0.5 * millidegree;
  wind.realisation_error = 0.02 * millidegree;
  wind.sampling = -0.01 * millidegree;
  wind.influences = {
      {design::Influence::friction, design::RunStatus::complete, 0.0, 0.3 * millidegree}};
  wind.interaction = 0.04 * millidegree;
  wind.boresight_rms = 0.85 * millidegree;
  const auto figures = time_domain_figures(section, "heading");
  ASSERT_EQ(figures.size(), 1U);
  expect_drawable(figures);
  EXPECT_EQ(figures.front().section, "heading");
  const auto& totals = figures.front().panels.front().series[0];
  const auto& steps = figures.front().panels.front().series[1];
  ASSERT_EQ(totals.x.size(), 2U);
  ASSERT_EQ(steps.x.size(), 4U);
  // Each begins where the one before ends, and the last ends at the simulated rms.
  double reached = totals.x.front();
  for (std::size_t i = 0; i < steps.x.size(); ++i) {
    const bool up = steps.x[i] == steps.x_upper[i];
    EXPECT_NEAR(up ? steps.x_lower[i] : steps.x_upper[i], reached, 1e-9);
    reached = steps.x[i];
  }
  EXPECT_NEAR(reached, totals.x.back(), 1e-9);
  section.result.wind.status = design::RunStatus::lost;
  EXPECT_TRUE(time_domain_figures(section, "heading").empty());
}

design::ErrorTrace swinging(double amplitude, double encoder_fraction) {
  constexpr Eigen::Index samples = 5001;  // 100 s
  design::ErrorTrace trace;
  trace.interval = 0.02;
  trace.boresight = amplitude * Eigen::VectorXd::LinSpaced(samples, 0.0, 60.0).array().sin();
  trace.encoder = encoder_fraction * trace.boresight;
  return trace;
}

double largest(const std::vector<double>& values) {
  double found = 0.0;
  for (const double value : values) found = std::max(found, std::abs(value));
  return found;
}

TEST(TraceFigures, PartsOfTheErrorInWindSumToTheBoresightError) {
  TimeDomainSection section;
  section.controller = "PI";
  section.result.wind.status = design::RunStatus::lost;
  section.result.wind.trace = swinging(millidegree, 0.25);
  section.present = {"PI-0", swinging(2.0 * millidegree, 0.5)};
  const auto figures = time_domain_figures(section, "heading");
  ASSERT_EQ(figures.size(), 1U);
  expect_drawable(figures);
  const auto& panels = figures.front().panels;
  ASSERT_EQ(panels.size(), 2U);
  ASSERT_EQ(panels[0].series.size(), 2U);
  EXPECT_NEAR(largest(panels[0].series[0].y), 2.0, 1e-3);  // before
  EXPECT_NEAR(largest(panels[0].series[1].y), 1.0, 1e-3);
  ASSERT_EQ(panels[1].series.size(), 2U);
  EXPECT_NEAR(largest(panels[1].series[0].y), 0.25, 1e-3);
  EXPECT_NEAR(largest(panels[1].series[1].y), 0.75, 1e-3);
  section.present->in_wind = {};
  EXPECT_EQ(time_domain_figures(section, "heading").front().panels[0].series.size(), 1U);
}

TEST(TraceFigures, ShowLimitCyclesAndReversalsOfRunsThatCompleted) {
  TimeDomainSection section;
  section.controller = "PI";
  section.result.wind.status = design::RunStatus::lost;
  design::LimitCycleResult rest, tracking;
  rest.limit_cycle = true;
  rest.trace = swinging(0.3 * millidegree, 0.9);
  tracking.rate = 4.0 * millidegree;
  tracking.status = design::RunStatus::lost;
  section.result.limit_cycles = {rest, tracking};
  design::ReversalResult reversal;
  reversal.leg = 20.0;
  reversal.trace = swinging(2.0 * millidegree, 0.9);
  section.result.reversal = reversal;
  const auto figures = time_domain_figures(section, "heading");
  ASSERT_EQ(figures.size(), 2U);
  expect_drawable(figures);
  EXPECT_EQ(figures[0].id, "time-domain-limit-cycle");
  ASSERT_EQ(figures[0].panels.size(), 1U);
  EXPECT_NEAR(largest(figures[0].panels.front().series.front().y), 0.3, 1e-3);
  EXPECT_EQ(figures[1].id, "time-domain-reversal");
  for (const auto& panel : figures[1].panels) {
    EXPECT_EQ(panel.series.size(), 1U);  // none without friction
    ASSERT_EQ(panel.lines.size(), 5U);   // 100 s of legs of 20 s
    EXPECT_EQ(panel.lines.back().at, 80.0);
  }
}

TEST(BenchmarkFigures, PutTheComparedSheetBesideAndDrawNothingOfAnUnstableLoop) {
  BenchmarkReport report;
  EXPECT_TRUE(benchmark_figures(report).empty());
  report.score.stable = true;
  report.score.worst = {.frequency = 1.0, .lower = 2e-9, .upper = 2e-9};
  report.score.flexure_compliance = 1e-9;
  report.score.compliance = {{0.1, 1e-9}, {1.0, 2e-9}};
  report.score.winds = {
      {"", 0.1, plant::WindModel::coherence, 5.0, 1.0, 1e-6, 1.1e-6},
      {"", 0.1, plant::WindModel::coherence, 10.0, 4.0, 4e-6, 4.1e-6},
      {"yaw 0 deg, elevation 10 deg", 0.1, plant::WindModel::coherence, 5.0, 1.0, 1e-6, 1.2e-6},
      {"yaw 45 deg, elevation 10 deg", 0.1, plant::WindModel::coherence, 5.0, 1.0, 1e-6, 1.3e-6},
      {"yaw 0 deg, elevation 30 deg", 0.1, plant::WindModel::coherence, 5.0, 1.0, 1e-6, 1.4e-6}};
  report.compared_sheet = ComparedSheet{{0.1, 1.0}, {3.0, 4.0}, {5.0, 10.0}, {0.1, 0.4}};
  const auto figures = benchmark_figures(report);
  ASSERT_EQ(figures.size(), 3U);
  expect_drawable(figures);
  EXPECT_EQ(figures[0].id, "compliance");
  EXPECT_EQ(figures[0].panels.front().series[1].y, (std::vector<double>{3.0, 4.0}));
  EXPECT_EQ(figures[1].panels.front().series.size(), 2U);
  EXPECT_EQ(figures[1].panels.front().series[0].x, (std::vector<double>{5.0, 10.0}));
  EXPECT_EQ(figures[2].panels.size(), 2U);  // elevations
  EXPECT_EQ(figures[2].panels[0].series.size(), 2U);
  EXPECT_EQ(figures[2].panels[1].series.size(), 1U);
}

TEST(SimulationFigures, MakeTorqueOfTheMeanPressureDifference) {
  DriveTestSection record;
  record.test = "fast-ramp";
  record.sample_time = 0.01;
  const Eigen::VectorXd time = Eigen::VectorXd::LinSpaced(3, 0.0, 0.02);
  const Eigen::VectorXd one = Eigen::VectorXd::Ones(3);
  record.channels = {{"time", "s", 3, time},          {"p1_in", "MPa", 3, 8.0 * one},
                     {"p1_out", "MPa", 3, 4.0 * one}, {"p2_in", "MPa", 3, 7.0 * one},
                     {"p2_out", "MPa", 3, 5.0 * one}, {"tach", "V", 3, time}};
  const Figure figure = drive_test_figure(record, 2e-5);
  expect_drawable({figure});
  ASSERT_EQ(figure.panels.size(), 3U);  // no valve command
  EXPECT_EQ(figure.panels[2].y.unit, "N.m");
  // 2e-5 N m per Pa of every motor's difference, whose mean is 3 MPa.
  EXPECT_NEAR(figure.panels[2].series.front().y.front(), 60.0, 1e-9);
}

TEST(CommissionFigures, TakeGainsOverTheirFinalValueAndLeaveOutWhatIsNotThere) {
  CommissionReport report;
  report.structure = "PI";
  for (const double value : {0.5, 2.0}) {
    StageSheet sheet;
    sheet.gains = {{"kr", "rate gain", "", value, true}};
    sheet.stage.expected.peak = {1.5, 1.4, 1.7, 1.3, 1.8};
    sheet.stage.abort.calm_encoder_rms = std::numeric_limits<double>::quiet_NaN();
    sheet.stage.expected.calm_encoder = {NAN, NAN, NAN, NAN, NAN};
    report.sheets.push_back(sheet);
  }
  const auto figures = commission_figures(report);
  ASSERT_EQ(figures.size(), 3U);
  expect_drawable(figures);
  EXPECT_EQ(figures[1].id, "commission-gains");
  EXPECT_EQ(figures[1].panels.front().series.front().y, (std::vector<double>{0.25, 1.0}));
  EXPECT_EQ(figures[0].section, "Commissioning plan for PI");
  for (const auto& panel : figures[2].panels) {
    EXPECT_NE(panel.y.label, "encoder rms, still air");
  }
}

}  // namespace
}  // namespace boresight::app
