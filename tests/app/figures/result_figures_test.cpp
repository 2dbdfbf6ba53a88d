#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include <boresight/app/figures/benchmark_figures.hpp>
#include <boresight/app/figures/commission_figures.hpp>
#include <boresight/app/figures/figure_svg.hpp>
#include <boresight/app/figures/inertia_figures.hpp>
#include <boresight/app/figures/simulation_figures.hpp>
#include <boresight/app/figures/time_domain_figures.hpp>
#include <boresight/app/report/sky_units.hpp>

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

TEST(TimeDomainFigures, LeadFromThePredictionToTheSimulation) {
  TimeDomainSection section;
  section.law = "PI";
  auto& wind = section.result.wind;
  wind.predicted_rms = 0.5 * millidegree;
  wind.chance = 0.02 * millidegree;
  wind.sampling = -0.01 * millidegree;
  wind.influences = {
      {design::Influence::friction, design::RunStatus::complete, 0.0, 0.3 * millidegree}};
  wind.joint = 0.04 * millidegree;
  wind.beam_rms = 0.85 * millidegree;
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

TEST(BenchmarkFigures, PutTheComparedSheetBesideAndDrawNothingOfAnUnstableLoop) {
  BenchmarkReport report;
  EXPECT_TRUE(benchmark_figures(report).empty());
  report.score.stable = true;
  report.score.worst = {.frequency = 1.0, .lower = 2e-9, .upper = 2e-9};
  report.score.encoder_held_compliance = 1e-9;
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
    sheet.stage.abort.still_encoder_rms = std::numeric_limits<double>::quiet_NaN();
    sheet.stage.expected.still_encoder = {NAN, NAN, NAN, NAN, NAN};
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
