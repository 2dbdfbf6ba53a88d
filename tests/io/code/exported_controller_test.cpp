#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/edited_case.hpp"
#include <boresight/control/controllers/sampled_controller.hpp>
#include <boresight/control/program/program_controller.hpp>
#include <boresight/design/studies/export_study.hpp>
#include <boresight/design/verification/nonlinear_verification.hpp>
#include <boresight/io/case/mission_of.hpp>
#include <boresight/io/code/computer_signals.hpp>
#include <boresight/io/code/exported_files.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/linear/interconnection.hpp>
#include <boresight/plant/nonlinear/nonlinear_drive.hpp>

namespace boresight::io {
namespace {

// As tuned for the 70-m antenna, rounded.
control::Controller loops() {
  return {control::LoopStructure::named("FULL+L+C"),
          {1.97, 7.48, 51.0, 0.513, 60.0, 5.84, 1.70, 10.9, 0.0108, 0.235}};
}

control::Controller state_space() {
  const auto sampled = control::sampled_controller(loops(), 0.02);
  return control::state_space_controller(
      "state space",
      plant::subsystem(sampled, {"tachometer", "encoder", "motor_torque"}, {"valve_demand"}));
}

struct Figures {
  double boresight_rms = 0.0, encoder_rms = 0.0, valve_rms = 0.0;
};

double rms(const Eigen::VectorXd& values) {
  return std::sqrt((values.array() - values.mean()).square().mean());
}

Figures figures_of(const design::SimulatedLoop& loop, const design::ReferenceTrajectory& course,
                   control::StartedController* controller) {
  design::LoopRunOptions options;
  options.controller = controller;
  const design::LoopRun run = design::run_loop(loop, course, options);
  EXPECT_EQ(run.status, design::RunStatus::complete) << run.message;
  return {rms(run.boresight_error), rms(run.encoder_error),
          rms(plant::column(run.result, "valve_command"))};
}

// Tracking in a torque that swings, then a slew of 0.1 deg, with noise, friction and orifices.
design::ReferenceTrajectory tracking_and_slew(const design::SimulatedLoop& loop,
                                              const control::CommandLimits& limits) {
  constexpr double slew_begins = 60.0, duration = 90.0;  // s
  const double gear = loop.gear_ratio;
  auto course =
      design::shaped_course({limits.rate * gear, limits.acceleration * gear}, loop.sample_time,
                            design::whole_samples(duration, loop.sample_time), 4, [&](double time) {
                              const double rate = 7e-5 * gear;
                              const double jump = time < slew_begins ? 0.0 : 0.1 * degree * gear;
                              return control::CommandSample{rate * time + jump, rate, 0.0};
                            });
  for (Eigen::Index k = 0; k < course.wind_torque.size(); ++k) {
    const double time = course.interval * static_cast<double>(k);
    course.wind_torque[k] = 5.0 + 2.0 * std::sin(0.5 * time) + std::sin(3.0 * time);
  }
  return course;
}

TEST(ExportedController, GivesTheSimulatedFigures) {
  const Case antenna = parse_case(EditedCase().text(), "case.toml");
  const design::Mission mission = mission_of(antenna);
  const CaseSignals signals = computer_signals(antenna, mission);
  for (const auto& controller : {loops(), state_space()}) {
    const auto exported = design::exported_controller(mission, controller, signals.signals);
    const auto loop = design::make_simulated_loop(
        design::tracking_problem(mission), plant::nonlinear_antenna(mission.antenna), controller);
    auto options = exported.options;
    options.signals.encoder_centre = 0.0;
    control::program::ProgramController program(controller, exported.sample_time, options);
    const auto course = tracking_and_slew(loop, options.limits);
    const Figures own = figures_of(loop, course, nullptr);
    const Figures same = figures_of(loop, course, &program);
    EXPECT_NEAR(same.boresight_rms, own.boresight_rms, 1e-9 * own.boresight_rms);
    EXPECT_NEAR(same.encoder_rms, own.encoder_rms, 1e-9 * own.encoder_rms);
    EXPECT_NEAR(same.valve_rms, own.valve_rms, 1e-9 * own.valve_rms);
  }
}

TEST(ExportedController, HasTheLimitsAndFeedforwardOfTheSimulations) {
  const Case antenna = parse_case(EditedCase().text(), "case.toml");
  const design::Mission mission = mission_of(antenna);
  const auto exported =
      design::exported_controller(mission, loops(), computer_signals(antenna, mission).signals);
  EXPECT_EQ(exported.options.command_limit, 150.0);
  EXPECT_NEAR(exported.sample_time, 0.02, 1e-15);
  EXPECT_FALSE(exported.achievable_limits) << "the supply does not hold 0.25 deg/s";
  EXPECT_LT(exported.options.limits.rate, mission.antenna.drive.slew_rate);
  EXPECT_NEAR(exported.options.feedforward.acceleration_to_motor_torque,
              plant::reflected_inertia(design::tracking_problem(mission).plant), 1e-12);
  EXPECT_NEAR(exported.options.feedforward.friction.coulomb_torque, 0.8 * 10.33, 1e-9);
}

TEST(ExportedController, IntegralGainsAreProductsOfGainAndCorner) {
  const control::Controller controller{control::LoopStructure::named("PI"),
                                       {0.8, 0.3, 40.0, 0.4, 0.05}};
  const auto rows = gain_rows(controller);
  ASSERT_EQ(rows.size(), 7U);
  EXPECT_EQ(rows[5].symbol, "Kir");
  EXPECT_DOUBLE_EQ(rows[5].value, 0.24);
  EXPECT_EQ(rows[6].symbol, "Kip");
  EXPECT_DOUBLE_EQ(rows[6].value, 0.02);
  EXPECT_TRUE(gain_rows(state_space()).empty());
}

TEST(ComputerSignals, AreDefaultsUnlessTheCaseStatesThem) {
  const Case antenna = parse_case(EditedCase().text(), "case.toml");
  const auto found = computer_signals(antenna, mission_of(antenna));
  // 0.1 mdeg of noise is that of steps of 0.35 mdeg; 2^20 of them are a turn.
  EXPECT_EQ(found.signals.encoder_counts, 1 << 20);
  EXPECT_EQ(found.signals.encoder_zero, 0.0);
  EXPECT_DOUBLE_EQ(found.signals.encoder_centre, 45.0 * degree) << "an elevation axis";
  EXPECT_EQ(found.signals.valve_command.unit, "%");
  EXPECT_DOUBLE_EQ(found.signals.valve_command.scale, 100.0 / 150.0);
  EXPECT_EQ(found.signals.motor_torque.unit, "Pa");
  ASSERT_EQ(found.descriptions.size(), 4U);
  EXPECT_FALSE(found.descriptions[0].stated);
  EXPECT_TRUE(found.descriptions[1].stated) << "the case has a tachometer";
  EXPECT_FALSE(found.descriptions[2].stated);
  EXPECT_FALSE(found.descriptions[3].stated);
}

TEST(ComputerSignals, DescribeOnlyWhatTheControllerReads) {
  const Case antenna = parse_case(EditedCase().text(), "case.toml");
  const auto found = computer_signals(antenna, mission_of(antenna), false);
  EXPECT_EQ(found.descriptions.size(), 3U);
}

TEST(ExportedFiles, KeepTextOfTheUserWithinTheirComments) {
  const Case antenna = parse_case(EditedCase().text(), "case.toml");
  const design::Mission mission = mission_of(antenna);
  const CaseSignals signals = computer_signals(antenna, mission);
  const auto exported = design::exported_controller(mission, loops(), signals.signals);
  ExportOptions options;
  options.source = "/tmp/a*/f\n.toml *) // (*";
  options.prefix = "az";
  const auto files = exported_files(exported, signals, options);
  int heads = 0;
  for (const auto& file : files) {
    EXPECT_THAT(file.name, testing::Not(testing::HasSubstr("servo"))) << file.name;
    if (file.content.find("Controller: /tmp/a* /f .toml * ) / / ( *.") != std::string::npos)
      ++heads;
  }
  EXPECT_EQ(heads, 5) << "C source and header, ST, Octave, JSON";
  options.prefix = "2nd axis";
  EXPECT_THROW(exported_files(exported, signals, options), InvalidInput);
}

TEST(ComputerSignals, FollowTheCaseInItsUnits) {
  EditedCase text;
  text.replace("[controller]\n",
               "[computer]\nvalve_voltage = \"10 V\"\ntransducer_pressure = \"200 bar\"\n"
               "transducer_voltage = \"5 V\"\nencoder_counts = 1000000\n"
               "encoder_zero = \"-5 deg\"\nencoder_centre = \"50 deg\"\n\n[controller]\n");
  const Case antenna = parse_case(text.text(), "case.toml");
  const auto found = computer_signals(antenna, mission_of(antenna));
  EXPECT_EQ(found.signals.encoder_counts, 1000000);
  EXPECT_DOUBLE_EQ(found.signals.encoder_centre, 50.0 * degree);
  EXPECT_EQ(found.signals.valve_command.unit, "V");
  EXPECT_DOUBLE_EQ(found.signals.valve_command.scale, 10.0 / 150.0);
  EXPECT_EQ(found.signals.motor_torque.unit, "V");
  // 200 bar is 2900.75 psi; the torque at the supply's 2000 psi is 315.62 N m.
  EXPECT_NEAR(5.0 / found.signals.motor_torque.scale, 315.62 * 2900.75 / 2000.0, 0.05);
  for (const auto& signal : found.descriptions) EXPECT_TRUE(signal.stated) << signal.signal;
}

}  // namespace
}  // namespace boresight::io
