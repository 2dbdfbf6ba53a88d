#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "design/verification/demo_loop.hpp"
#include <boresight/design/verification/limit_cycle_search.hpp>
#include <boresight/design/verification/limit_cycles_by_friction.hpp>

namespace boresight::design {
namespace {

NonlinearVerificationOptions short_runs(const reference::DemoLoop& demo, unsigned threads) {
  NonlinearVerificationOptions options;
  options.limit_cycle_duration = 40.0;
  options.tracking_rate = demo.mission.antenna.drive.tracking_rate;
  options.limits = {4e-3, 3e-3};
  options.threads = threads;
  return options;
}

SimulatedLoop quantised(const reference::DemoLoop& demo) {
  SimulatedLoop loop = demo.loop;
  loop.encoder_resolution = std::sqrt(12.0) * demo.problem.noise.encoder_rms;
  return loop;
}

TEST(FrictionVariations, ChangeWhatTheirNamesSay) {
  plant::MotorFriction stated;
  stated.curve = {10.0, 17.0, 0.15, 60.0, 1.5, 2.0};
  stated.bristle_stiffness = 2500.0;
  const auto variations = friction_variations(stated);
  ASSERT_EQ(variations.size(), 4U);
  const auto dry = [](const plant::MotorFriction& friction, double rate) {
    return plant::dry_friction(friction.curve, rate).value;
  };
  for (const double rate : {0.0, 0.05, 1.0, 20.0}) {
    EXPECT_NEAR(dry(variations[0].friction, rate), 0.7 * dry(stated, rate), 1e-12);
    EXPECT_NEAR(dry(variations[1].friction, rate), 1.3 * dry(stated, rate), 1e-12);
  }
  EXPECT_NEAR(dry(variations[2].friction, 0.0), 1.3 * dry(stated, 0.0), 1e-12);
  // The steepest fall of exp(-(w/ws)^2) scales with the height over ws.
  const auto steepest = [&](const plant::MotorFriction& friction) {
    double least = 0.0;
    for (double rate = 1e-3; rate < 1.0; rate += 1e-3) {
      least = std::min(least, plant::dry_friction(friction.curve, rate).derivative);
    }
    return least;
  };
  EXPECT_LT(steepest(stated), 0.0);
  EXPECT_LT(steepest(variations[2].friction), 2.0 * steepest(stated));
  EXPECT_GT(steepest(variations[3].friction), steepest(stated));
  EXPECT_EQ(variations[3].friction.bristle_stiffness, 0.3 * stated.bristle_stiffness);
  plant::MotorFriction smooth = stated;
  smooth.curve = {};
  EXPECT_TRUE(friction_variations(smooth).empty());
}

TEST(LimitCyclesByFriction, CountTheLimitCyclesOfEachFrictionAndRate) {
  const reference::DemoLoop demo;
  const SimulatedLoop loop = quantised(demo);
  const auto options = short_runs(demo, 2);
  ASSERT_NE(options.tracking_rate, 0.0);
  auto longer = options;
  longer.limit_cycle_duration *= limit_cycle_confirmation;
  const auto variations = friction_variations(loop.antenna.friction);
  const auto runs = limit_cycles_by_friction(loop, variations, options);
  ASSERT_EQ(runs.size(), 2 * variations.size());
  int found = 0;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    EXPECT_EQ(runs[i].friction, variations[i / 2].name);
    EXPECT_EQ(runs[i].rate, i % 2 == 0 ? 0.0 : options.tracking_rate);
    EXPECT_EQ(runs[i].starts, static_cast<int>(limit_cycle_starts));
    SimulatedLoop other = loop;
    other.antenna.friction = variations[i / 2].friction;
    // The controller keeps the feedforward of the stated friction.
    other.stated_friction = loop.antenna.friction.curve;
    EXPECT_EQ(feedforward_of(other).friction.coulomb_torque,
              feedforward_of(loop).friction.coulomb_torque);
    int expected = 0;
    double largest = 0.0;
    for (std::size_t start = 0; start < limit_cycle_starts; ++start) {
      auto one = limit_cycle_run(other, options, runs[i].rate, start);
      if (one.limit_cycle) one = limit_cycle_run(other, longer, runs[i].rate, start);
      expected += one.limit_cycle ? 1 : 0;
      largest = std::max(largest, one.encoder_amplitude);
    }
    EXPECT_EQ(runs[i].limit_cycles, expected);
    EXPECT_EQ(runs[i].encoder_amplitude, largest);
    found += expected;
  }
  // PI with integral action, friction and encoder steps does not come to rest.
  EXPECT_GT(found, 0);
  const auto alone = limit_cycles_by_friction(loop, variations, short_runs(demo, 1));
  for (std::size_t i = 0; i < runs.size(); ++i) {
    EXPECT_EQ(alone[i].encoder_amplitude, runs[i].encoder_amplitude);
  }
  EXPECT_TRUE(limit_cycles_by_friction(loop, {}, options).empty());
}

}  // namespace
}  // namespace boresight::design
