#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/limit_cycle_loop.hpp"
#include "design/reference_problem.hpp"
#include "lag_loops.hpp"
#include "reference_nonlinear_antenna.hpp"
#include "refused_call.hpp"
#include <boresight/control/controllers/sampled_controller.hpp>
#include <boresight/design/problem/drive_capability.hpp>
#include <boresight/design/verification/nonlinear_verification.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/linear/interconnection.hpp>
#include <boresight/plant/nonlinear/operating_point.hpp>

namespace boresight::design {
namespace {

using reference::mdeg;
using testing::DoubleNear;
using testing::HasSubstr;

// The tuned PI controller of the reference antenna.
control::Controller tuned_controller() {
  return {control::LoopStructure::pi_with_lag(), {0.1587, 0.42067, 2.6279, 10.258, 0.23531}};
}

SimulatedLoop reference_loop(const control::Controller& controller = tuned_controller()) {
  auto details = reference::drive_details();
  details.line_lengths.clear();
  details.preload_torque = 20.0;
  details.backlash = 0.1;
  details.offset.constant = -5.65;
  auto loop = make_simulated_loop(reference::tracking_problem(),
                                  reference::nonlinear_antenna(details), controller);
  loop.encoder_resolution = 0.34 * mdeg * loop.gear_ratio;
  return loop;
}

NonlinearVerificationOptions options() {
  NonlinearVerificationOptions options;
  options.wind_duration = 60.0;
  options.tracking_rate = 4.1667 * mdeg;
  options.limit_cycle_duration = 60.0;
  options.slew_distance = 1000.0 * mdeg;
  options.limits = {250.0 * mdeg, 200.0 * mdeg};
  options.settled_error = 1.0 * mdeg;
  return options;
}

// Nothing but the friction of a loop with a limit cycle, without orifice, gear and noise.
SimulatedLoop loop_with_coulomb_friction(const TrackingProblem& problem,
                                         const control::Controller& controller, double coulomb) {
  auto details = reference::drive_details();
  details.line_lengths.clear();
  details.supply_pressure *= 10.0;
  details.friction = {
      {coulomb, coulomb, 1.0, 0.0, 1.0, problem.plant.drive.viscous_friction}, 0.0, 0.0, 0.01};
  return make_simulated_loop(problem, reference::nonlinear_antenna(details), controller);
}

TEST(NonlinearVerification, CoulombFrictionAndIntegralActionLimitCycleAsTheDescribingFunctionSays) {
  const auto problem = reference::tracking_problem();
  for (const double corner : {1.15, 1.2}) {
    for (const double coulomb : {5.0, 10.0}) {
      const control::Controller controller{control::LoopStructure::pi_with_lag(),
                                           {0.1587, 0.42067, 2.6279, 10.258, corner}};
      const auto predicted = reference::predicted_cycle(problem, controller, coulomb, 0.1, 0.4);
      auto wanted = options();
      wanted.explain = false;
      wanted.wind_duration = 1.0;
      wanted.settling = 150.0;
      wanted.tracking_rate = wanted.slew_distance = 0.0;
      wanted.limit_cycle_duration = 120.0;
      const auto result =
          verify_in_time(problem, loop_with_coulomb_friction(problem, controller, coulomb), wanted);
      ASSERT_EQ(result.limit_cycles.size(), 1U);
      const auto& limit_cycles = result.limit_cycles.front();
      EXPECT_TRUE(limit_cycles.limit_cycle) << corner;
      EXPECT_EQ(limit_cycles.starts, limit_cycle_starts);
      EXPECT_EQ(limit_cycles.starts_with_limit_cycle, limit_cycle_starts)
          << "the limit cycle attracts all starts";
      EXPECT_FALSE(limit_cycles.some_only());
      EXPECT_NEAR(limit_cycles.persistence, 1.0, 0.1);
      EXPECT_NEAR(limit_cycles.encoder_amplitude * problem.gear_ratio / predicted.encoder_amplitude,
                  1.0, 0.10)
          << corner << " " << coulomb;
      EXPECT_NEAR(limit_cycles.frequency.value_or(0.0) / predicted.frequency, 1.0, 0.02)
          << corner << " " << coulomb;
    }
  }
}

TEST(NonlinearVerification, NoLimitCycleWithoutFriction) {
  const auto problem = reference::tracking_problem();
  auto loop = loop_with_coulomb_friction(problem, tuned_controller(), 0.0);
  auto wanted = options();
  wanted.explain = false;
  wanted.wind_duration = 1.0;
  const auto result = verify_in_time(problem, loop, wanted);
  for (const auto& limit_cycles : result.limit_cycles) {
    EXPECT_EQ(limit_cycles.status, RunStatus::complete);
    EXPECT_FALSE(limit_cycles.limit_cycle) << limit_cycles.encoder_amplitude / mdeg;
    EXPECT_EQ(limit_cycles.starts_with_limit_cycle, 0);
    EXPECT_LT(limit_cycles.encoder_amplitude, 1e-3 * mdeg);
  }
  ASSERT_TRUE(result.reversal);
  // A step of the rate by 2 x 4.17 mdeg/s rings at the hydraulic resonance of 0.85 Hz.
  EXPECT_LT(result.reversal->encoder_error, 2.0 * 4.1667 * mdeg / (two_pi * 0.85) * 1.2);
  // Without feedforward it is the run without friction: the feedforward of viscous friction is not
  // the same with a friction curve and without one.
  loop.feedforward = false;
  const auto without = verify_in_time(problem, loop, wanted).reversal;
  ASSERT_TRUE(without);
  EXPECT_NEAR(without->encoder_error, without->encoder_error_without_friction, 1e-3 * mdeg);
}

TEST(NonlinearVerification, EveryDifferenceFromThePredictionHasAName) {
  const auto loop = reference_loop();
  const auto problem = reference::tracking_problem();
  const auto result = verify_in_time(problem, loop, options());
  const WindResult& wind = result.wind;
  ASSERT_EQ(wind.status, RunStatus::complete) << wind.message;
  double sum = wind.predicted_rms + wind.realisation_error + wind.sampling + wind.interaction;
  ASSERT_EQ(wind.influences.size(), 5U);
  for (const auto& influence : wind.influences) {
    sum += influence.difference;
    EXPECT_DOUBLE_EQ(influence.difference, wind.boresight_rms - influence.boresight_rms_without);
  }
  EXPECT_NEAR(sum, wind.boresight_rms, 1e-12 * wind.boresight_rms);
  // Within the scatter of a minute of wind.
  EXPECT_NEAR(wind.linear_rms / wind.predicted_rms, 1.0, 0.15);
  EXPECT_LT(std::abs(wind.sampling), 0.03 * wind.linear_rms);
  // On this antenna friction is the largest.
  for (const auto& influence : wind.influences) {
    EXPECT_LE(influence.difference, wind.influences.front().difference);
  }
  EXPECT_EQ(wind.influences.front().influence, Influence::friction);
  EXPECT_GT(wind.influences.front().difference, 0.02 * wind.boresight_rms);
  ASSERT_EQ(result.limit_cycles.size(), 2U);
  EXPECT_TRUE(result.limit_cycles[0].limit_cycle);
  EXPECT_FALSE(result.limit_cycles[1].limit_cycle);
  // The valve moves the motor at least at the limit cycle's rate.
  const LimitCycleResult& rest = result.limit_cycles[0];
  ASSERT_TRUE(rest.frequency);
  const double rate = two_pi * *rest.frequency * rest.encoder_amplitude * loop.gear_ratio;
  EXPECT_GT(rest.valve_command_rms, 0.5 * rate);
  EXPECT_LT(rest.valve_command_rms, loop.antenna.valve.stroke_limit);
  ASSERT_TRUE(result.reversal);
  EXPECT_LT(result.reversal->encoder_error, 2.0 * result.reversal->encoder_error_without_friction);
  EXPECT_GT(result.reversal->encoder_error, 0.1 * result.reversal->encoder_error_without_friction);
  EXPECT_GT(result.reversal->boresight_error_without_friction_feedforward,
            1.5 * result.reversal->boresight_error);
  EXPECT_GT(result.reversal->boresight_error_without_friction_feedforward,
            2.0 * result.reversal->encoder_error_without_friction);
  ASSERT_TRUE(result.slew);
  EXPECT_FALSE(result.slew->achievable_limits);
  EXPECT_TRUE(result.slew->settling_time.has_value());
  EXPECT_LT(result.slew->limits.rate, 250.0 * mdeg);
  EXPECT_NEAR(result.slew->command_time, control::min_move_time(result.slew->limits, 1000.0 * mdeg),
              0.07);
}

// Of controllers that are compared only the chosen one is explained, later.
TEST(NonlinearVerification, ExplainsARunThatIsKnownAsOneThatIsNot) {
  const auto loop = reference_loop();
  const auto problem = reference::tracking_problem();
  auto wanted = options();
  wanted.wind_duration = 5.0;
  wanted.limit_cycle_duration = 10.0;
  wanted.slew_distance = 0.0;
  const auto whole = verify_in_time(problem, loop, wanted);
  wanted.explain = false;
  auto known = verify_in_time(problem, loop, wanted);
  ASSERT_TRUE(whole.reversal && known.reversal);
  EXPECT_TRUE(std::isnan(known.reversal->boresight_error_without_friction_feedforward));
  EXPECT_TRUE(known.wind.influences.empty());
  wanted.explain = true;
  explain_in_wind(problem, loop, wanted, known);
  EXPECT_EQ(known.reversal->boresight_error_without_friction_feedforward,
            whole.reversal->boresight_error_without_friction_feedforward);
  ASSERT_EQ(known.wind.influences.size(), whole.wind.influences.size());
  EXPECT_EQ(known.wind.influences.front().difference, whole.wind.influences.front().difference);
}

TEST(NonlinearVerification, TracesHaveTheirResultsRmsAmplitudeAndPeak) {
  const auto loop = reference_loop();
  const auto problem = reference::tracking_problem();
  auto wanted = options();
  wanted.explain = false;
  wanted.slew_distance = 0.0;
  const auto result = verify_in_time(problem, loop, wanted);
  ASSERT_EQ(result.wind.status, RunStatus::complete) << result.wind.message;
  const ErrorTrace& wind = result.wind.trace;
  ASSERT_EQ(wind.boresight.size(), 3000);  // 60 s
  const auto rms = [](const Eigen::VectorXd& errors) {
    return std::sqrt(errors.squaredNorm() / static_cast<double>(errors.size()));
  };
  EXPECT_NEAR(rms(wind.boresight) / result.wind.boresight_rms, 1.0, 1e-12);
  EXPECT_NEAR(rms(wind.encoder) / result.wind.encoder_rms, 1.0, 1e-12);
  const ErrorTrace alone = error_in_wind(problem, loop, wanted);
  EXPECT_EQ(alone.boresight, wind.boresight);
  EXPECT_EQ(alone.encoder, wind.encoder);
  for (const auto& limit_cycles : result.limit_cycles) {
    const Eigen::VectorXd& encoder = limit_cycles.trace.encoder;
    ASSERT_GT(encoder.size(), 0);
    EXPECT_LE(static_cast<double>(encoder.size() - 1) * limit_cycles.trace.interval,
              longest_limit_cycle_trace);
    const double amplitude = 0.5 * (encoder.maxCoeff() - encoder.minCoeff());
    EXPECT_LE(amplitude, limit_cycles.encoder_amplitude * (1.0 + 1e-12));
    EXPECT_GE(amplitude, 0.5 * limit_cycles.encoder_amplitude);
  }
  ASSERT_TRUE(result.reversal);
  EXPECT_EQ(result.reversal->trace.encoder.cwiseAbs().maxCoeff(), result.reversal->encoder_error);
  EXPECT_EQ(result.reversal->trace.boresight.cwiseAbs().maxCoeff(),
            result.reversal->boresight_error);
  EXPECT_EQ(result.reversal->trace_without_friction.encoder.cwiseAbs().maxCoeff(),
            result.reversal->encoder_error_without_friction);
}

TEST(NonlinearVerification, ASlewThatLimitCyclesThroughItsBoundHasNotSettled) {
  const auto problem = reference::tracking_problem();
  // Limit-cycles by some 7 mdeg at rest.
  const control::Controller controller{control::LoopStructure::pi_with_lag(),
                                       {0.1587, 0.42067, 2.6279, 10.258, 1.2}};
  const auto loop = loop_with_coulomb_friction(problem, controller, 10.0);
  auto wanted = options();
  wanted.explain = false;
  wanted.wind_duration = 1.0;
  wanted.settling = 5.0;
  const auto settling = [&](double bound) {
    wanted.settled_error = bound;
    const auto result = verify_in_time(problem, loop, wanted);
    return result.slew ? result.slew->settling_time : std::nullopt;
  };
  // A bound that the swing passes through twice a period: the last seconds may lie within.
  for (const double bound : {0.5 * mdeg, 2.0 * mdeg, 6.0 * mdeg}) {
    EXPECT_FALSE(settling(bound).has_value()) << bound / mdeg;
  }
  EXPECT_TRUE(settling(60.0 * mdeg).has_value());
}

TEST(NonlinearVerification, SecondIntegratorRepeatsTheFirstRunInWind) {
  auto wanted = options();
  wanted.explain = false;
  wanted.wind_duration = wanted.limit_cycle_duration = 10.0;
  wanted.settling = 2.0;
  const auto problem = reference::tracking_problem();
  EXPECT_FALSE(verify_in_time(problem, reference_loop(), wanted).integrators);
  wanted.second_integrator = true;
  const auto result = verify_in_time(problem, reference_loop(), wanted);
  ASSERT_TRUE(result.integrators);
  EXPECT_TRUE(agree(*result.integrators));
  EXPECT_DOUBLE_EQ(result.integrators->collocation_rms, result.wind.boresight_rms);
  EXPECT_NEAR(result.integrators->duration, 10.0, 1e-9);
}

TEST(NonlinearVerification, SameBytesWhateverTheThreads) {
  const auto loop = reference_loop();
  const auto problem = reference::tracking_problem();
  auto wanted = options();
  wanted.wind_duration = wanted.limit_cycle_duration = 10.0;
  wanted.settling = 2.0;
  wanted.reversal_leg = 3.0;
  wanted.seeds = {1, 7};
  wanted.second_integrator = true;
  const auto numbers = [&](unsigned threads) {
    wanted.threads = threads;
    const auto result = verify_in_time(problem, loop, wanted);
    std::vector<double> all{result.wind.boresight_rms,
                            result.wind.encoder_rms,
                            result.wind.linear_rms,
                            result.wind.continuous_rms,
                            result.wind.interaction,
                            result.limit_cycles.at(0).encoder_amplitude,
                            result.limit_cycles.at(1).boresight_amplitude};
    for (const auto& influence : result.wind.influences) {
      all.push_back(influence.boresight_rms_without);
    }
    if (result.reversal) all.push_back(result.reversal->encoder_error);
    if (result.slew) all.push_back(result.slew->largest_error);
    if (result.integrators) all.push_back(result.integrators->difference_rms);
    return all;
  };
  const auto one = numbers(1);
  EXPECT_EQ(one, numbers(3));
  EXPECT_EQ(one.size(), 15U);
  wanted.seeds = {2, 8};
  EXPECT_NE(one, numbers(1)) << "seeds sample nothing";
}

TEST(NonlinearVerification, RunsWithoutAUsableEndAreStatedResults) {
  auto problem = reference::tracking_problem();
  auto controller = tuned_controller();
  controller.gains[4] = 5.0;  // the position integral: unstable
  auto wanted = options();
  wanted.wind_duration = wanted.limit_cycle_duration = wanted.reversal_leg = 3.0;
  wanted.settling = 40.0;
  const auto unstable = verify_in_time(problem, reference_loop(controller), wanted);
  EXPECT_EQ(unstable.wind.status, RunStatus::lost);
  EXPECT_THAT(unstable.wind.message, HasSubstr("the encoder is more than 0.00175 rad off after"));
  EXPECT_TRUE(std::isnan(unstable.wind.boresight_rms));

  // A supply that cannot hold the tracking rate, and no wind to help it.
  problem.wind.mean_speed = 0.5;
  auto loop = reference_loop();
  loop.antenna.oil.supply_torque = 5.0;
  wanted.explain = false;
  const auto weak = verify_in_time(problem, loop, wanted);
  EXPECT_EQ(weak.wind.status, RunStatus::failed);
  EXPECT_THAT(weak.wind.message, HasSubstr("no steady motion to start from at 2.09 rad/s"));
  ASSERT_EQ(weak.limit_cycles.size(), 2U);
  EXPECT_EQ(weak.limit_cycles[1].status, RunStatus::failed);
  ASSERT_TRUE(weak.slew);
  EXPECT_FALSE(weak.slew->achievable_limits);
}

TEST(NonlinearVerification, SamplingIsNoInfluenceOnAStateSpace) {
  const control::Controller loops = reference::lag_loops();
  auto loop = reference_loop();
  auto wanted = options();
  wanted.explain = true;
  loop.controller = loops;
  const auto expected = verify_in_time(reference::tracking_problem(), loop, wanted).wind;
  loop.controller = control::state_space_controller(
      "sampled", plant::subsystem(control::sampled_controller(loops, loop.sample_time),
                                  {"tachometer", "encoder"}, {"valve_demand"}));
  const auto found = verify_in_time(reference::tracking_problem(), loop, wanted).wind;
  EXPECT_EQ(found.sampling, 0.0);
  EXPECT_NE(expected.sampling, 0.0);
  EXPECT_NEAR(found.linear_rms / expected.linear_rms, 1.0, 1e-6);
  EXPECT_NEAR(found.predicted_rms / expected.predicted_rms, 1.0, 1e-3);
  EXPECT_EQ(found.influences.size(), expected.influences.size());
}

TEST(NonlinearVerification, AllowsALimitCycleUpToAnAmplitude) {
  std::vector<LimitCycleResult> result;
  EXPECT_EQ(limit_cycle_amplitude(result), 0.0);
  EXPECT_TRUE(is_limit_cycle_free(result, 1e-6));
  LimitCycleResult rest, moving;
  rest.boresight_amplitude = 1.0;  // of what is no limit cycle does not count
  moving.limit_cycle = true;
  moving.boresight_amplitude = 1e-5;
  result = {rest, moving};
  EXPECT_EQ(limit_cycle_amplitude(result), 1e-5);
  EXPECT_TRUE(is_limit_cycle_free(result, 1.001e-5));
  EXPECT_FALSE(is_limit_cycle_free(result, 0.999e-5));
  result[0].status = RunStatus::failed;
  EXPECT_FALSE(is_limit_cycle_free(result, 1.0));
}

TEST(NonlinearVerification, RefusesOptionsOutOfRange) {
  const auto message = [](const auto& change) -> std::string {
    auto wanted = options();
    change(wanted);
    try {
      verify_in_time(reference::tracking_problem(), reference_loop(), wanted);
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_THAT(message([](auto& o) { o.seeds.clear(); }), HasSubstr("at least one seed"));
  EXPECT_THAT(message([](auto& o) { o.wind_duration = 0.5; }),
              HasSubstr("wind_duration of at least 1 s, found 0.5"));
  EXPECT_THAT(message([](auto& o) { o.settling = -1.0; }), HasSubstr("settling time"));
  EXPECT_THAT(message([](auto& o) { o.limit_cycle_duration = 0.0; }),
              HasSubstr("limit_cycle_duration"));
  EXPECT_THAT(message([](auto& o) { o.reversal_leg = 0.0; }), HasSubstr("reversal_leg"));
  EXPECT_THAT(message([](auto& o) { o.settling_watched = 0.0; }), HasSubstr("settling_watched"));
  EXPECT_THAT(message([](auto& o) { o.tracking_rate = 1.0; }),
              HasSubstr("within the command's rate limit, found 1"));
  EXPECT_THAT(message([](auto& o) { o.slew_distance = NAN; }), HasSubstr("finite slew_distance"));
  EXPECT_THAT(message([](auto& o) { o.settled_error = 0.0; }),
              HasSubstr("settled_error above 0 for a slew, found 0"));
}

TEST(DriveCapability, TheSupplyHoldsWhatItSaysAndNoMore) {
  const auto antenna = reference_loop().antenna;
  const double far = 140.0;  // rad/s of motor
  const double rate = attainable_rate(antenna, far);
  ASSERT_GT(rate, 0.0);
  ASSERT_LT(rate, far);
  EXPECT_NO_THROW(plant::trim(antenna, {-0.999 * rate, 0.0, {}}));
  EXPECT_THROW(plant::trim(antenna, {-1.001 * rate, 0.0, {}}), NumericalFailure);
  EXPECT_EQ(attainable_rate(antenna, 0.1 * rate), 0.1 * rate);
  const auto kept = achievable_limits(antenna, 1.5, {far, 1e6});
  EXPECT_DOUBLE_EQ(kept.rate, 0.8 * rate);
  EXPECT_LT(kept.acceleration, 0.5 * 316.0 / 1.5);
  EXPECT_GT(kept.acceleration, 0.0);
  const auto easy = achievable_limits(antenna, 1.5, {1.0, 1.0});
  EXPECT_EQ(easy.rate, 1.0);
  EXPECT_EQ(easy.acceleration, 1.0);
}

}  // namespace
}  // namespace boresight::design
