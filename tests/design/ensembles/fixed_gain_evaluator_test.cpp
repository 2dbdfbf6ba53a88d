#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/reference_problem.hpp"
#include "lag_loops.hpp"
#include "refused_call.hpp"
#include <boresight/control/controllers/sampled_controller.hpp>
#include <boresight/control/loops/closed_loop.hpp>
#include <boresight/design/ensembles/fixed_gain_evaluator.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/vector_clones.hpp>
#include <boresight/plant/linear/interconnection.hpp>

namespace boresight {
namespace {

using design::FixedGainEvaluator;
using design::FixedGainValues;

// A plant that the reference antenna may be, every number of it another.
plant::AntennaPlant uncertain_antenna(reference::RandomNumbers& random) {
  auto structure = reference::structure();
  const double scale = random.uniform(0.9, 1.1);
  structure.locked_rotor_frequency *= scale;
  for (auto& mode : structure.modes) mode.frequency *= scale;
  structure.antenna_inertia *= random.uniform(0.9, 1.1);
  auto plant = reference::antenna();
  plant.structure = plant::make_structure(structure);
  plant.drive.oil_stiffness *= random.uniform(0.8, 1.33);
  plant.drive.leakage_rate *= random.uniform(0.3, 1.0);
  plant.drive.viscous_friction = random.uniform(0.0, 12.0);
  plant.drive.motor_inertia *= random.uniform(0.9, 1.1);
  return plant;
}

void expect_same(const FixedGainValues& one, const FixedGainValues& other) {
  EXPECT_EQ(one.wind_variance, other.wind_variance);
  EXPECT_EQ(one.climate_variance, other.climate_variance);
  EXPECT_EQ(one.noise_variance, other.noise_variance);
  EXPECT_EQ(one.effort_variance, other.effort_variance);
  EXPECT_EQ(one.sensitivity_peaks, other.sensitivity_peaks);
  EXPECT_EQ(one.stable, other.stable);
}

// A controller of every block there is, without regard to how good it is.
control::Controller full_controller() {
  control::Controller controller{control::LoopStructure::named("FULL+N+C"), {}};
  for (const auto& gain : controller.structure.gains()) {
    controller.gains.push_back(std::sqrt(gain.lower * gain.upper));
  }
  return controller;
}

control::Controller state_space_controller() {
  const control::Controller loops = reference::lag_loops();
  return control::state_space_controller(
      "sampled", plant::subsystem(control::sampled_controller(loops, 0.02),
                                  {"tachometer", "encoder"}, {"valve_demand"}));
}

TEST(FixedGainEvaluator, HasTheSameBitsInRegistersOfEveryWidth) {
  const auto problem = reference::tracking_problem();
  design::Constraints goals;
  goals.gust_demand = 100.0;
  reference::RandomNumbers random(6);
  for (int i = 0; i < 10; ++i) {
    const auto plant = uncertain_antenna(random);
    const auto values = [&](std::size_t lanes) {
      const numerics::NarrowRegisters narrow(lanes);
      return FixedGainEvaluator(problem, full_controller(), goals).evaluate(plant);
    };
    expect_same(values(4), values(2));
    expect_same(values(8), values(2));
  }
}

TEST(FixedGainEvaluator, AgreesWithTheTunersEvaluator) {
  auto problem = reference::tracking_problem();
  problem.noise.torque_rms = 0.5;
  const design::WindTable wind(problem);
  design::Constraints goals;
  goals.gust_demand = 100.0;
  for (const auto& controller :
       {reference::cautious_gains(), full_controller(), state_space_controller()}) {
    FixedGainEvaluator held(problem, controller, goals);
    reference::RandomNumbers random(5);
    for (int i = 0; i < 60; ++i) {
      const auto plant = i < 40 ? uncertain_antenna(random) : reference::random_antenna(random);
      auto one = problem;
      one.plant = plant;
      const auto found = held.evaluate(plant);
      auto evaluator = design::make_adaptive_evaluator(one, wind);
      evaluator.look_at_gusts(true);
      const auto expected = evaluator.evaluate(controller, false);
      ASSERT_EQ(found.stable, expected.stable()) << i;
      if (!found.stable) continue;
      const auto expect_near = [&](double value, double truth, double tolerance) {
        EXPECT_NEAR(value / truth, 1.0, tolerance)
            << controller.structure.name() << ", plant " << i;
      };
      expect_near(found.wind_variance + found.noise_variance, expected.boresight_variance(), 2e-5);
      expect_near(found.effort_variance, expected.effort_variance, 2e-4);
      expect_near(found.wind_demand_variance, expected.wind_demand_variance, 2e-4);
      expect_near(found.wind_torque_variance, expected.wind_torque_variance, 2e-4);
      for (std::size_t b = 0; b < 3; ++b) {
        expect_near(found.sensitivity_peaks.at(b),
                    expected.highest_peak(control::loop_breaks.at(b)), 1e-4);
      }
    }
  }
}

TEST(FixedGainEvaluator, AgreesWithLyapunovEquationsAndEigenvalues) {
  auto problem = reference::tracking_problem();
  // As the state space has it: all frequencies, and noise white throughout.
  problem.rms_band = {1e-4, 200.0};
  const auto filter = design::fit_wind_filter(problem);
  const control::Controller controller = reference::cautious_gains();
  FixedGainEvaluator held(problem, controller, {});
  reference::RandomNumbers random(8);
  int stable = 0;
  for (int i = 0; i < 25; ++i) {
    const auto plant = uncertain_antenna(random);
    const auto found = held.evaluate(plant);
    const auto verdict =
        control::stability(plant, controller, problem.delay, design::analysis_grid(problem));
    ASSERT_EQ(found.stable, verdict.stable()) << i;
    EXPECT_EQ(held.confirm(plant).closed_loop_abscissa, verdict.closed_loop_abscissa);
    EXPECT_NEAR(held.confirm(plant).dead_time_residue, verdict.dead_time_residue,
                0.05 * verdict.dead_time_residue);
    if (!found.stable) continue;
    ++stable;
    const auto exact =
        control::lyapunov_rms(plant, controller, problem.delay, filter, problem.noise);
    EXPECT_NEAR(std::sqrt(found.wind_variance) / exact.wind, 1.0, 5e-3) << i;
  }
  EXPECT_GT(stable, 10);
}

TEST(FixedGainEvaluator, CallsForTheEigenvaluesNearTheAxis) {
  const auto problem = reference::tracking_problem();
  auto controller = reference::cautious_gains();
  FixedGainEvaluator calm(problem, controller, {});
  const auto values = calm.evaluate(problem.plant);
  EXPECT_TRUE(values.stable);
  EXPECT_FALSE(calm.near_the_axis(values));
  // The rate loop's gain up to where it no longer holds.
  bool near_but_stable = false, unstable = false;
  for (int k = 0; k < 400 && !unstable; ++k) {
    controller.gains[0] *= 1.02;
    FixedGainEvaluator held(problem, controller, {});
    const auto found = held.evaluate(problem.plant);
    unstable = !found.stable;
    EXPECT_EQ(held.confirm(problem.plant).stable(), found.stable) << k;
    EXPECT_TRUE(found.stable || held.near_the_axis(found));
    near_but_stable = near_but_stable || (found.stable && held.near_the_axis(found));
  }
  EXPECT_TRUE(unstable);
  EXPECT_TRUE(near_but_stable);
}

TEST(FixedGainEvaluator, DoesNotRememberThePlantBefore) {
  const auto problem = reference::tracking_problem();
  FixedGainEvaluator used(problem, reference::cautious_gains(), {});
  const FixedGainEvaluator fresh = used;
  reference::RandomNumbers random(2);
  for (int i = 0; i < 30; ++i) used.evaluate(reference::random_antenna(random));
  for (int i = 0; i < 10; ++i) {
    const auto plant = uncertain_antenna(random);
    FixedGainEvaluator copy = fresh;
    expect_same(used.evaluate(plant), copy.evaluate(plant));
    used.confirm(reference::random_antenna(random));
    expect_same(used.evaluate(plant), copy.evaluate(plant));
  }
}

TEST(FixedGainEvaluator, WeightsTheClimatesWinds) {
  auto problem = reference::tracking_problem();
  auto strong = problem.wind;
  strong.mean_speed = 15.0;
  problem.climate = {{problem.wind, 0.75}, {strong, 0.25}};
  auto windy = reference::tracking_problem();
  windy.wind = strong;
  const auto controller = reference::cautious_gains();
  const auto both = FixedGainEvaluator(problem, controller, {}).evaluate(problem.plant);
  const auto at_15 = FixedGainEvaluator(windy, controller, {}).evaluate(problem.plant);
  EXPECT_EQ(at_15.climate_variance, 0.0);
  EXPECT_NEAR(both.climate_variance / (0.75 * both.wind_variance + 0.25 * at_15.wind_variance), 1.0,
              1e-5);
  EXPECT_GT(at_15.wind_variance, 3.0 * both.wind_variance);
}

TEST(FixedGainEvaluator, RefusesWhatItCannotEvaluate) {
  const auto problem = reference::tracking_problem();
  const auto controller = reference::cautious_gains();
  EXPECT_THAT(
      reference::Call([&] { FixedGainEvaluator(problem, controller, {}, {.tolerance = 0.0}); }),
      testing::ThrowsMessage<InvalidInput>(
          "FixedGainEvaluator: expected a positive tolerance and peak, found 0 and 4"));
  EXPECT_THROW(FixedGainEvaluator(problem, {controller.structure, {1.0}}, {}), InvalidInput);
  FixedGainEvaluator held(problem, controller, {});
  auto broken = problem.plant;
  broken.drive.oil_stiffness = std::nan("");
  EXPECT_THAT(reference::Call([&] { held.evaluate(broken); }),
              testing::ThrowsMessage<NumericalFailure>(
                  "FixedGainEvaluator: the plant's response is not finite"));
}

}  // namespace
}  // namespace boresight
