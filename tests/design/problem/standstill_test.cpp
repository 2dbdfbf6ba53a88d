#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "design/studies/demo_mission.hpp"
#include <boresight/design/problem/standstill.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/plant/antenna/antenna_plant.hpp>

namespace boresight::design {
namespace {

plant::Antenna antenna_with_encoder_noise(double factor) {
  plant::Antenna antenna = plant::demo_antenna();
  antenna.sensors.encoder_noise *= factor;
  return antenna;
}

TEST(StandstillFriction, IsThatOfHalfAnEncoderStep) {
  const plant::Antenna antenna = plant::demo_antenna();
  const auto slopes = standstill_friction(antenna);
  ASSERT_EQ(slopes.size(), 3U);
  const auto mode = plant::hydraulic_mode(plant::plant_modes(linear_plant(antenna)));
  // A uniform error of +-h/2 has an rms of h/sqrt(12).
  const double half_step = std::sqrt(3.0) * gear_ratio(antenna) * antenna.sensors.encoder_noise;
  const double rate = half_step * two_pi * mode.frequency / 6.0;
  EXPECT_NEAR(slopes[2], plant::equivalent_friction(antenna.friction_curve, rate),
              1e-12 * slopes[2]);
  EXPECT_NEAR(slopes[1], slopes[2] / 3.0, 1e-12 * slopes[2]);
  EXPECT_NEAR(slopes[0], slopes[2] / 6.0, 1e-12 * slopes[2]);
}

TEST(StandstillAmplitudes, AreThoseInWhichFrictionAmountsToEachSlope) {
  const plant::Antenna antenna = plant::demo_antenna();
  const auto slopes = standstill_friction(antenna);
  const auto amplitudes = standstill_amplitudes(antenna);
  ASSERT_EQ(amplitudes.size(), slopes.size());
  const double frequency =
      two_pi / 6.0 * plant::hydraulic_mode(plant::plant_modes(linear_plant(antenna))).frequency;
  for (std::size_t i = 0; i < slopes.size(); ++i) {
    EXPECT_NEAR(plant::equivalent_friction(antenna.friction_curve, amplitudes[i] * frequency),
                slopes[i], 1e-9 * slopes[i]);
  }
  EXPECT_NEAR(amplitudes[2], std::sqrt(3.0) * gear_ratio(antenna) * antenna.sensors.encoder_noise,
              1e-9 * amplitudes[2]);
  EXPECT_GT(amplitudes[0], 6.0 * amplitudes[2]);
}

// A sine of amplitude A is read as a square wave of +-q/2, whose fundamental is 2 q/pi.
TEST(EncoderEdges, AreDescribingFunctionsOfAQuarterOfAStep) {
  const plant::Antenna antenna = plant::demo_antenna();
  const auto edges = encoder_edges(antenna);
  ASSERT_EQ(edges.size(), 4U);
  const double step = std::sqrt(12.0) * gear_ratio(antenna) * antenna.sensors.encoder_noise;
  const double mode =
      two_pi * plant::hydraulic_mode(plant::plant_modes(linear_plant(antenna))).frequency;
  constexpr int samples = 100000;
  double fundamental = 0.0;
  for (int i = 0; i < samples; ++i) {
    const double phase = two_pi * (i + 0.5) / samples;
    const double angle = 0.25 * step * std::sin(phase);
    const double read = step * std::floor(angle / step) + 0.5 * step;
    fundamental += 2.0 / samples * read * std::sin(phase);
  }
  double last = HUGE_VAL;
  for (const Standstill::Edge& edge : edges) {
    EXPECT_NEAR(edge.encoder_gain * 0.25 * step, fundamental, 1e-6 * fundamental);
    EXPECT_LT(edge.friction, last);
    last = edge.friction;
  }
  // The slowest and the fastest dissipate as friction does at the rate of that motion.
  for (const auto& [edge, part] : {std::pair(edges.front(), 0.27), std::pair(edges.back(), 1.35)}) {
    EXPECT_NEAR(edge.friction,
                plant::equivalent_friction(antenna.friction_curve, 0.25 * step * part * mode),
                1e-12 * edge.friction);
  }
  EXPECT_TRUE(encoder_edges(antenna_with_encoder_noise(0.0)).empty());
}

// A finer encoder needs more gain to free the motor by one step.
TEST(BreakawayStiffness, IsTheBreakawayTorquePerEncoderStep) {
  plant::Antenna antenna = plant::demo_antenna();
  const double step = std::sqrt(12.0) * gear_ratio(antenna) * antenna.sensors.encoder_noise;
  ASSERT_GE(antenna.friction_curve.breakaway_torque, antenna.friction_curve.coulomb_torque);
  EXPECT_NEAR(breakaway_stiffness(antenna).value() * step, antenna.friction_curve.breakaway_torque,
              1e-12);
  EXPECT_NEAR(breakaway_stiffness(antenna_with_encoder_noise(0.5)).value(),
              2.0 * breakaway_stiffness(antenna).value(),
              1e-12 * breakaway_stiffness(antenna).value());
  // Without stiction friction holds by its Coulomb torque.
  antenna.friction_curve.breakaway_torque = 0.0;
  EXPECT_NEAR(breakaway_stiffness(antenna).value() * step, antenna.friction_curve.coulomb_torque,
              1e-12);
  EXPECT_FALSE(breakaway_stiffness(antenna_with_encoder_noise(0.0)).has_value());
}

TEST(StandstillFriction, FallsWithTheEncoderStep) {
  // A coarser encoder hides limit cycles of larger amplitude, in which friction damps less.
  const double own = standstill_friction(antenna_with_encoder_noise(1.0)).back();
  EXPECT_LT(standstill_friction(antenna_with_encoder_noise(4.0)).back(), own);
  EXPECT_GT(standstill_friction(antenna_with_encoder_noise(0.25)).back(), own);
}

TEST(StandstillFriction, IsAbsentWithoutEncoderStepsOrDryFriction) {
  EXPECT_TRUE(standstill_friction(antenna_with_encoder_noise(0.0)).empty());
  plant::Antenna antenna = plant::demo_antenna();
  antenna.friction_curve = {};
  antenna.friction_curve.viscous_friction = antenna.drive.viscous_friction;
  EXPECT_TRUE(standstill_friction(antenna).empty());
}

TEST(StandstillFriction, GoesIntoTheConstraintsOfAMissionThatAsks) {
  Mission mission = reference::demo_mission();
  EXPECT_FALSE(constraints(mission).standstill.has_value());
  mission.stated_constraints.standstill = Standstill{2.5, {}};
  const auto goals = constraints(mission);
  ASSERT_TRUE(goals.standstill.has_value());
  EXPECT_EQ(goals.standstill->sensitivity_peak, 2.5);
  EXPECT_EQ(goals.standstill->friction, standstill_friction(mission.antenna));
  ASSERT_FALSE(goals.standstill->edges.empty());
  EXPECT_EQ(goals.standstill->edges.front().friction,
            encoder_edges(mission.antenna).front().friction);
  EXPECT_EQ(goals.standstill->breakaway_stiffness, breakaway_stiffness(mission.antenna));
}

}  // namespace
}  // namespace boresight::design
