#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "app/document/on_one_line.hpp"
#include <boresight/app/document/document_text.hpp>
#include <boresight/app/match/match_conclusions.hpp>
#include <boresight/app/report/match_report.hpp>
#include <boresight/app/tune/structure_option.hpp>
#include <boresight/io/case/antenna_of.hpp>
#include <boresight/io/case/case_drive.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_simulation.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/mission_of.hpp>
#include <boresight/io/case/plant_numbers.hpp>
#include <boresight/io/case/tested_drive_of.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/antenna/antenna_change.hpp>

namespace boresight::app {
namespace {

const io::Case& big_antenna() {
  static const io::Case antenna = io::read_case(BORESIGHT_SOURCE_DIR "/cases/dss14-70m/case.toml");
  return antenna;
}

design::MatchOptions small_options(const std::vector<std::string>& structures = {"PI-0", "PI"}) {
  design::MatchOptions options;
  options.structures = structure_option(big_antenna(), structures);
  options.points = 4;
  options.starts = 2;
  options.time_runs = MatchTimeRuns::none;
  options.variants = false;
  return options;
}

MatchSection matched(const io::Case& antenna, const design::MatchOptions& options) {
  return section_of(antenna, study_matching(io::mission_of(antenna), {}, options));
}

const MatchSection& small_study() {
  static const MatchSection section = matched(big_antenna(), small_options());
  return section;
}

std::string message_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return {};
}

TEST(Match, PutsRatioOneAndAsBuiltAmongTheEvenlySpacedDisks) {
  const auto& points = small_study().points;
  ASSERT_EQ(points.size(), 5U);
  int on_grid = 0;
  for (const auto& point : points) {
    on_grid += point.on_grid ? 1 : 0;
    if (label_of(point) == "ratio 1") {
      EXPECT_NEAR(point.motor_to_load_ratio, 1.0, 1e-9);
    }
  }
  EXPECT_EQ(on_grid, 4);
  EXPECT_EQ(points.front().disks, 0.0);
  EXPECT_EQ(label_of(points.back()), "as built");
}

TEST(Match, SlewsByNewton) {
  const io::Case& antenna = big_antenna();
  const double ratio = io::gear_ratio(antenna);
  const plant::NonlinearAntenna model = make_nonlinear_antenna(antenna);
  const MatchSection& section = small_study();
  ASSERT_TRUE(section.slew_by_simulation);
  for (const auto& point : section.points) {
    // As design::achievable_limits and `evaluate` have it: half of what is left beyond the valve's
    // drop, friction and offset.
    const double rate = section.slew_rate * ratio;
    const double fraction = rate / (model.valve.stroke_limit - model.valve.overlap);
    const double available =
        (model.oil.supply_torque - model.oil.return_torque) * (1.0 - fraction * fraction);
    const double load = plant::friction_torque(io::friction_curve(antenna), rate) + 5.65;
    EXPECT_NEAR(point.acceleration * ratio * point.reflected_inertia, 0.5 * (available - load),
                1e-9 * supply_torque(antenna));
    EXPECT_NEAR(point.slew_time,
                section.slew_distance / section.slew_rate + section.slew_rate / point.acceleration,
                1e-9);
    const double driven = point.reflected_inertia - point.motor_inertia;
    EXPECT_NEAR(point.two_mass_damping, 0.5 * std::sqrt(driven / point.motor_inertia), 1e-12);
  }
}

// Slew rates that come back smaller from the motor's side than they went there.
TEST(Match, WithoutAStrokeNoRoundingTakesTheSlewRate) {
  io::Case antenna = big_antenna();
  antenna.simulation.reset();
  const double ratio = io::gear_ratio(antenna);
  double& rate = antenna.drive->slew_rate.value;
  rate *= 0.1;
  while (rate * ratio / ratio >= rate) rate = std::nextafter(rate, 1.0);
  const MatchSection section = matched(antenna, small_options({"PI-0"}));
  EXPECT_FALSE(section.slew_by_simulation);
  EXPECT_EQ(section.slew_rate, rate);
}

// Over all gear ratios the acceleration for given torque is greatest at R = 1, where half of the
// torque goes into the load.
TEST(Match, AccelerationOfTheBestRatioIsOneAtRatioOne) {
  for (const auto& point : small_study().points) {
    const double r = point.motor_to_load_ratio;
    EXPECT_LE(point.acceleration_of_best_ratio, 1.0);
    EXPECT_NEAR(point.acceleration_of_best_ratio, 2.0 / (std::sqrt(r) + 1.0 / std::sqrt(r)), 1e-12);
  }
}

// With PI in both loops the position loop is kp (s + wip)/s^2 at low frequencies.
TEST(Match, FollowsAConstantAccelerationAsThePositionGainsSay) {
  const auto& series = small_study().series.front();
  for (std::size_t i = 0; i < series.values.size(); ++i) {
    const auto& controller = series.curve.controllers[i].controller;
    constexpr double lowest = two_pi * 1e-4;
    const double gains =
        control::gain(controller, "kp") * std::hypot(lowest, control::gain(controller, "wip"));
    EXPECT_NEAR(series.values[i].acceleration_error * gains, 1.0, 0.02);
    EXPECT_GT(series.values[i].bandwidth, 0.0);
  }
}

TEST(Match, EveryControllerIsVerifiedAndMoreStructureIsNeverWorse) {
  const auto& section = small_study();
  EXPECT_TRUE(section.settled);
  for (std::size_t i = 0; i < section.points.size(); ++i) {
    const auto& plain = section.series[0].values[i];
    const auto& lagged = section.series[1].values[i];
    EXPECT_TRUE(plain.found && lagged.found);
    EXPECT_TRUE(plain.verification.passed) << plain.verification.failure;
    EXPECT_LT(lagged.boresight_rms, plain.boresight_rms * (1.0 + section.tolerance));
    EXPECT_NEAR(plain.boresight_rms,
                section.series[0].curve.controllers[i].soft_rms / io::gear_ratio(big_antenna()),
                1e-5 * plain.boresight_rms);
  }
}

TEST(Match, EvaluatesTheClassicRules) {
  const auto& rules = small_study().rules;
  ASSERT_EQ(rules.size(), 4U);
  for (const auto& rule : rules) {
    if (!rule.disks) continue;
    EXPECT_NEAR(plant::motor_to_load_ratio(
                    motor_inertia(big_antenna(), *rule.disks),
                    plant::reflected_inertia(make_plant(
                        big_antenna(), {plant::set_to("motor.flywheel_disks", *rule.disks)}))),
                rule.motor_to_load_ratio, 1e-9);
    for (const double cost : rule.cost) EXPECT_GT(cost, -1e-9);
  }
}

TEST(Match, ReportsAndConcludes) {
  const std::string text = to_text(document_of(small_study()));
  EXPECT_NE(text.find("Inertia matching"), std::string::npos);
  EXPECT_NE(text.find("ratio 1"), std::string::npos);
  const auto sentences = conclude(small_study());
  EXPECT_NE(sentences.front().find("coherence wind model, 10 m/s"), std::string::npos);
  EXPECT_NE(sentences[1].find("With PI-0 (no torque feedback) the minimum rms is"),
            std::string::npos);
}

TEST(Match, NamesInertiasThatAreAsGoodBeyondTheFlatRange) {
  MatchSection section = small_study();
  auto& series = section.series[0];
  const auto told = [&] { return conclude(section)[1]; };
  const double minimum = series.values.back().boresight_rms;
  for (auto& value : series.values) value.boresight_rms = 1.05 * minimum;
  series.best = series.values.size() - 1;
  series.values.back().boresight_rms = minimum;
  series.within_1_percent = {0.9 * section.points.back().disks, section.points.back().disks};
  EXPECT_EQ(told().find("too"), std::string::npos);
  series.values.front().boresight_rms = 1.0006 * minimum;
  EXPECT_NE(told().find("; 0 disks within 1 % too."), std::string::npos) << told();
  series.values.front().found = false;
  EXPECT_EQ(told().find("too"), std::string::npos);
}

TEST(Match, NamesTheModeOfMostOilWhereTheHydraulicModeHasLittle) {
  MatchSection section = small_study();
  for (auto& point : section.points) {
    EXPECT_GE(point.oil_mode.oil_fraction, point.hydraulic.oil_fraction);
    point.hydraulic.oil_fraction = point.oil_mode.oil_fraction = 0.6;
  }
  const auto told = [&](const std::string& sentence) {
    const std::string text = to_text(document_of(section));
    return on_one_line(text).find(sentence) != std::string::npos;
  };
  EXPECT_TRUE(told("hydr., zeta: the hydraulic mode, the lowest that moves the oil"));
  EXPECT_FALSE(told("dominant hydraulic mode"));
  const auto hides_it = [](MatchPoint& point, double frequency) {
    point.hydraulic.oil_fraction = 0.06;
    point.hydraulic.gear_fraction = 0.7;
    point.oil_mode.frequency = frequency;
    point.oil_mode.damping_ratio = 0.03;
    point.oil_mode.oil_fraction = 0.8;
  };
  hides_it(section.points.front(), 22.3);
  EXPECT_TRUE(
      told("in the oil at 1 of these inertias; the dominant hydraulic mode is at 22.3 Hz (zeta "
           "0.030) with 0.00 disks."));
  for (auto& point : section.points) hides_it(point, 22.3 - 0.5 * point.disks);
  EXPECT_TRUE(told(
      "Less than half of the hydraulic mode's elastic energy is in the oil; the dominant hydraulic "
      "mode is at 22.3 Hz (zeta 0.030) with 0.00 disks to 10.3 Hz (zeta 0.030) with 24.00 disks."));
}

TEST(Match, AnInterruptLeavesWhatWasWhole) {
  design::MatchOptions options = small_options();
  int steps = 0;
  options.progress = [&](std::string_view, std::size_t, std::size_t) { ++steps; };
  options.interrupted = [&] { return steps >= 2; };
  const auto section = matched(big_antenna(), options);
  EXPECT_TRUE(section.series[0].values[0].found);
  EXPECT_FALSE(section.series[1].curve.controllers.back().searched);
  EXPECT_FALSE(section.settled);
}

TEST(Match, SaysWhatItCannotWorkOn) {
  EXPECT_EQ(message_of([] {
              small_options({"PI", "PI"});
            }),
            "--structure: expected each structure once, found 'PI' again");
  design::MatchOptions options = small_options();
  options.points = 3;
  EXPECT_EQ(message_of([&] { matched(big_antenna(), options); }),
            "match: expected at least 4 points, found 3");
  options = small_options();
  options.max_disks = -1.0;
  EXPECT_EQ(message_of([&] { matched(big_antenna(), options); }),
            "match: expected more than 0 disks at most, found -1");
}

TEST(Match, NamesPointsRulesAndVariants) {
  EXPECT_EQ(label_of({.disks = 3.0}), "");
  EXPECT_EQ(label_of({.disks = 3.0, .unit_ratio = true, .as_built = true}), "ratio 1, as built");
  EXPECT_EQ(name_of(MatchVariant{}), "the case's plant");
  EXPECT_EQ(text_of(design::ClassicRule::no_flywheels),
            "maximum acceleration at this gear ratio: no flywheels");
}

}  // namespace
}  // namespace boresight::app
