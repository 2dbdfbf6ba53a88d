#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "design/reference_problem.hpp"
#include "reference_nonlinear_antenna.hpp"
#include <boresight/control/controllers/sampled_controller.hpp>
#include <boresight/design/verification/limit_cycle_prediction.hpp>
#include <boresight/design/verification/limit_cycle_search.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::design {
namespace {

using reference::mdeg;

control::Controller pi_controller(double rate_integral, double position_integral) {
  return {control::LoopStructure::pi_with_lag(),
          {0.1587, rate_integral, 2.6279, 10.258, position_integral}};
}

plant::DriveDetails details_with(const plant::FrictionCurve& friction) {
  auto details = reference::drive_details();
  details.line_lengths.clear();
  details.friction.curve = friction;
  return details;
}

SimulatedLoop loop_with(const plant::FrictionCurve& friction, double encoder_step,
                        const control::Controller& controller) {
  auto loop = make_simulated_loop(reference::tracking_problem(),
                                  reference::nonlinear_antenna(details_with(friction)), controller);
  loop.encoder_resolution = encoder_step * loop.gear_ratio;
  return loop;
}

constexpr std::size_t largest_start = 2;

NonlinearVerificationOptions run_options() {
  NonlinearVerificationOptions options;
  options.limits = {250.0 * mdeg, 200.0 * mdeg};
  return options;
}

LimitCycleResult simulated(const SimulatedLoop& loop) {
  return confirmed_limit_cycle_run(loop, run_options(), 0.0, largest_start);
}

const plant::FrictionCurve stribeck{10.33, 16.83, 0.15, 63.29, 1.5, 2.075};

TEST(LimitCyclePrediction, AgreesWithSimulationOnAmplitudeAndFrequency) {
  // Two integrals, with and without encoder steps.
  const plant::FrictionCurve coulomb{10.0, 10.0, 1.0, 0.0, 1.0, 0.9};
  for (const auto& [friction, step, controller] :
       {std::tuple{coulomb, 0.0, pi_controller(0.42, 0.9)},
        std::tuple{coulomb, 0.34 * mdeg, pi_controller(0.42, 0.9)},
        std::tuple{coulomb, 0.34 * mdeg, pi_controller(0.9, 0.6)},
        std::tuple{stribeck, 0.34 * mdeg, pi_controller(0.9, 0.23)}}) {
    const SimulatedLoop loop = loop_with(friction, step, controller);
    const LimitCycleResult run = simulated(loop);
    ASSERT_TRUE(run.limit_cycle);
    const auto predicted = LimitCyclePrediction(loop, 2).of(loop.controller);
    const auto cycle = largest_stable(predicted, min_limit_cycle_amplitude(loop));
    ASSERT_TRUE(cycle);
    EXPECT_NEAR(cycle->encoder_amplitude / run.encoder_amplitude, 1.0, 0.2);
    EXPECT_NEAR(cycle->frequency / run.frequency.value(), 1.0, 0.03);
    EXPECT_NEAR(cycle->boresight_amplitude / cycle->encoder_amplitude,
                run.boresight_amplitude / run.encoder_amplitude, 0.1);
  }
}

// Bristles take up part of a motion of a few encoder steps, which harmonic balance neglects.
TEST(PredictedLimitCycle, HasTheAmplitudeOfTheWholeAntennaWithBristles) {
  double worst_of_harmonic_balance = 0.0;
  for (const auto& [controller, stiffness] : {std::pair{pi_controller(0.9, 0.23), 2500.0},
                                              {pi_controller(0.9, 0.23), 600.0},
                                              {pi_controller(0.42, 0.235), 2500.0}}) {
    SimulatedLoop loop = loop_with(stribeck, 0.34 * mdeg, controller);
    loop.antenna.friction.bristle_stiffness = stiffness;
    loop.antenna.friction.bristle_damping = 5.0;
    const LimitCyclePrediction harmonic_balance(loop, 2);
    const auto predicted = predicted_limit_cycle(loop, harmonic_balance, run_options());
    const LimitCycleResult run = limit_cycle_run(loop, run_options(), 0.0, largest_start);
    ASSERT_TRUE(run.limit_cycle && predicted && predicted->confirmed);
    EXPECT_NEAR(predicted->encoder_amplitude / run.encoder_amplitude, 1.0, 0.1);
    EXPECT_NEAR(predicted->boresight_amplitude / run.boresight_amplitude, 1.0, 0.1);
    EXPECT_NEAR(predicted->frequency / run.frequency.value(), 1.0, 0.03);
    const auto one = largest_stable(harmonic_balance.of(controller), 0.0);
    ASSERT_TRUE(one);
    worst_of_harmonic_balance =
        std::max(worst_of_harmonic_balance, one->encoder_amplitude / run.encoder_amplitude);
  }
  EXPECT_GT(worst_of_harmonic_balance, 1.3);
}

TEST(PredictedLimitCycle, IsUnconfirmedWhereTheReducedAntennaComesToRest) {
  SimulatedLoop loop = loop_with(stribeck, 0.34 * mdeg, pi_controller(0.2, 0.05));
  loop.antenna.friction.bristle_stiffness = 600.0;
  loop.antenna.friction.bristle_damping = 5.0;
  ASSERT_FALSE(limit_cycle_run(loop, run_options(), 0.0, largest_start).limit_cycle);
  const LimitCyclePrediction harmonic_balance(loop, 2);
  const auto predicted = predicted_limit_cycle(loop, harmonic_balance, run_options());
  const auto one =
      largest_stable(harmonic_balance.of(loop.controller), min_limit_cycle_amplitude(loop));
  ASSERT_TRUE(predicted && one);
  EXPECT_FALSE(predicted->confirmed);
  EXPECT_EQ(predicted->encoder_amplitude, one->encoder_amplitude);
}

TEST(LimitCyclePrediction, FindsNoneWithoutDryFrictionOrWithoutIntegrals) {
  const SimulatedLoop frictionless =
      loop_with({0.0, 0.0, 1.0, 0.0, 1.0, 2.0}, 0.34 * mdeg, pi_controller(0.9, 0.23));
  const LimitCyclePrediction none(frictionless, 1);
  EXPECT_TRUE(none.of(frictionless.controller).empty());
  EXPECT_FALSE(predicted_limit_cycle(frictionless, none, run_options()));
  // A slow loop whose leaky integral gives way to friction.
  const SimulatedLoop slow = loop_with(stribeck, 0.34 * mdeg, pi_controller(0.9, 0.23));
  const control::Controller leaky{control::LoopStructure::pi_with_lag().with_position_lag(),
                                  {0.1, 10.0, 0.5, 0.2, 0.4}};
  ASSERT_EQ(leaky.structure.gains().size(), leaky.gains.size());
  const auto predicted = LimitCyclePrediction(slow, 1).of(leaky);
  EXPECT_FALSE(largest_stable(predicted, min_limit_cycle_amplitude(slow)));
}

TEST(LimitCyclePrediction, ScalesWithFrictionAndStep) {
  // Twice all torques and rates of the curve, and twice the encoder's step: twice the motion. The
  // supply's torque is not scaled, and little of it is used.
  const plant::FrictionCurve twice{20.66, 33.66, 0.30, 126.58, 3.0, 2.075};
  auto one = loop_with(stribeck, 0.34 * mdeg, pi_controller(0.9, 0.23));
  auto other = loop_with(twice, 0.68 * mdeg, pi_controller(0.9, 0.23));
  one.antenna.oil.supply_torque = other.antenna.oil.supply_torque = 1e9;
  const auto small = LimitCyclePrediction(one, 1).of(one.controller);
  const auto large = LimitCyclePrediction(other, 1).of(other.controller);
  ASSERT_EQ(small.size(), large.size());
  ASSERT_FALSE(small.empty());
  for (std::size_t i = 0; i < small.size(); ++i) {
    EXPECT_NEAR(large[i].encoder_amplitude, 2.0 * small[i].encoder_amplitude,
                1e-6 * large[i].encoder_amplitude);
    EXPECT_NEAR(large[i].frequency, small[i].frequency, 1e-6 * small[i].frequency);
    EXPECT_EQ(large[i].stable, small[i].stable);
  }
}

// The sampled loops with the ports of a state space.
control::Controller as_state_space(const control::Controller& loops, double sample_time) {
  plant::StateSpace sampled = control::sampled_controller(loops, sample_time);
  const plant::StateSpace all = sampled;
  sampled.inputs = {"tachometer", "encoder"};
  if (loops.structure.feeds_torque_back()) sampled.inputs.emplace_back("motor_torque");
  const auto count = static_cast<Eigen::Index>(sampled.inputs.size());
  const Eigen::Index output = plant::output_index(all, "valve_demand");
  sampled.b.resize(all.b.rows(), count);
  sampled.d.resize(1, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto column = plant::input_index(all, sampled.inputs[static_cast<std::size_t>(i)]);
    sampled.b.col(i) = all.b.col(column);
    sampled.d(0, i) = all.d(output, column);
  }
  sampled.c = Eigen::MatrixXd(all.c.row(output));
  sampled.outputs = {"valve_demand"};
  return control::state_space_controller("the same", sampled);
}

// Paths of tachometer, encoder and torque have the signs of the state space.
TEST(LimitCyclePrediction, IsThatOfTheSameLoopsAsAStateSpace) {
  for (const char* name : {"PI", "DPF", "PI+C"}) {
    control::Controller loops{control::LoopStructure::named(name), {0.1587, 0.9, 2.6279}};
    if (loops.structure.has(control::LoopPath::pressure)) {
      loops.gains.insert(loops.gains.end(), {0.02, 0.5});
    }
    loops.gains.insert(loops.gains.end(), {10.258, 0.23});
    if (loops.structure.has(control::LoopPath::compliance)) {
      loops.gains.insert(loops.gains.end(), {1e-3, 1.0});
    }
    ASSERT_EQ(loops.gains.size(), loops.structure.gains().size()) << name;
    const SimulatedLoop loop = loop_with(stribeck, 0.34 * mdeg, loops);
    const LimitCyclePrediction prediction(loop, 2);
    const auto one = largest_stable(prediction.of(loops), min_limit_cycle_amplitude(loop));
    const auto other = largest_stable(prediction.of(as_state_space(loops, loop.sample_time)),
                                      min_limit_cycle_amplitude(loop));
    ASSERT_TRUE(one && other) << name;
    EXPECT_NEAR(other->encoder_amplitude / one->encoder_amplitude, 1.0, 0.05) << name;
    EXPECT_NEAR(other->frequency / one->frequency, 1.0, 0.02) << name;
  }
}

TEST(LimitCyclePrediction, DoesNotDependOnThreads) {
  const SimulatedLoop loop = loop_with(stribeck, 0.34 * mdeg, pi_controller(0.9, 0.23));
  const auto one = LimitCyclePrediction(loop, 1).of(loop.controller);
  const auto two = LimitCyclePrediction(loop, 2).of(loop.controller);
  ASSERT_EQ(one.size(), two.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].encoder_amplitude, two[i].encoder_amplitude);
    EXPECT_EQ(one[i].frequency, two[i].frequency);
  }
}

TEST(LargestStable, IsTheLargestAboveAnAmplitude) {
  const std::vector<PredictedLimitCycle> predicted{
      {0.1, 1.0, 1.0, true}, {0.1, 2.0, 2.0, true}, {0.1, 3.0, 3.0, false}};
  const auto largest = largest_stable(predicted, 0.5);
  ASSERT_TRUE(largest);
  EXPECT_EQ(largest->encoder_amplitude, 2.0);
  EXPECT_FALSE(largest_stable(predicted, 2.0));
  EXPECT_FALSE(largest_stable({}, 0.0));
}

}  // namespace
}  // namespace boresight::design
