#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/reference_problem.hpp"
#include "lag_loops.hpp"
#include "reference_nonlinear_antenna.hpp"
#include <boresight/control/controllers/sampled_controller.hpp>
#include <boresight/design/verification/simulated_loop.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/linear/interconnection.hpp>
#include <boresight/plant/nonlinear/operating_point.hpp>
#include <boresight/plant/wind/wind_time_series.hpp>

namespace boresight::design {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using reference::mdeg;
using testing::HasSubstr;

const std::vector<Influence> everything(std::begin(influences), std::end(influences));

control::Controller tuned_controller() {
  return {control::LoopStructure::pi_with_lag(), {0.1587, 0.42067, 2.6279, 10.258, 0.23531}};
}

control::Controller pressure_controller() {
  return {control::LoopStructure::pressure_feedback(),
          {0.1587, 0.42067, 2.6279, 0.01, 3.0, 8.0, 0.2}};
}

SimulatedLoop reference_loop(const control::Controller& controller = tuned_controller()) {
  auto details = reference::drive_details();
  details.line_lengths.clear();
  details.preload_torque = 20.0;
  details.backlash = 0.1;
  auto loop = make_simulated_loop(reference::tracking_problem(),
                                  reference::nonlinear_antenna(details), controller);
  loop.encoder_resolution = 0.34 * mdeg * loop.gear_ratio;
  return loop;
}

double rms(const VectorXd& values) {
  return std::sqrt((values.array() - values.mean()).square().mean());
}

// Wind about its mean on a loop that stands still or moves steadily.
ReferenceTrajectory windy_course(const SimulatedLoop& loop, double duration, double rate,
                                 double fraction) {
  const auto wind = plant::synthesise_wind_torque(
      reference::wind_site(), plant::WindModel::coherence, 10.0, duration, loop.sample_time, 1);
  ReferenceTrajectory course;
  course.interval = loop.sample_time;
  course.wind_torque = fraction * (wind.uniform + wind.gradient) / loop.gear_ratio;
  const Index samples = course.wind_torque.size();
  course.reference =
      VectorXd::LinSpaced(samples, 0.0, rate * loop.sample_time * static_cast<double>(samples - 1));
  course.reference_rate = VectorXd::Constant(samples, rate);
  course.reference_acceleration = VectorXd::Zero(samples);
  return course;
}

TEST(SimulatedLoop, WithEverythingOffItIsTheLinearLoopSampleForSample) {
  for (const auto& controller : {tuned_controller(), pressure_controller()}) {
    const auto loop = reference_loop(controller);
    const auto course = windy_course(loop, 60.0, 2.0, 1.0);
    LoopRunOptions options;
    options.without = everything;
    const LoopRun nonlinear = run_loop(loop, course, options);
    const LoopRun linear = run_linear_loop(loop, course);
    ASSERT_EQ(nonlinear.status, RunStatus::complete) << nonlinear.message;
    ASSERT_EQ(linear.status, RunStatus::complete) << linear.message;
    // The start's command under way has died out, the controller's constants do not matter.
    const Index settled = 1000, rest = linear.boresight_error.size() - settled;
    const VectorXd expected = linear.boresight_error.tail(rest);
    const VectorXd found = nonlinear.boresight_error.tail(rest);
    const VectorXd difference =
        (found.array() - found.mean()) - (expected.array() - expected.mean());
    EXPECT_LT(rms(difference), 2e-3 * rms(expected)) << controller.structure.name();
    EXPECT_GT(rms(expected), 0.3 * mdeg);
    // Noise is in both: without, they are others.
    LoopRunOptions quiet;
    quiet.noise = false;
    const LoopRun silent = run_linear_loop(loop, course, 1, quiet);
    EXPECT_GT(rms(silent.boresight_error - linear.boresight_error), 0.005 * mdeg);
  }
}

TEST(SimulatedLoop, SmallMotionOverTheOrificeIsLinearToo) {
  const auto loop = reference_loop();
  LoopRunOptions options;
  options.noise = false;
  options.without = {Influence::friction, Influence::quantisation};
  const auto difference = [&](double fraction) {
    const auto course = windy_course(loop, 40.0, 0.0, fraction);
    const LoopRun nonlinear = run_loop(loop, course, options);
    const LoopRun linear = run_linear_loop(loop, course, 1, options);
    return rms((nonlinear.boresight_error - linear.boresight_error).tail(1000)) /
           rms(linear.boresight_error.tail(1000));
  };
  EXPECT_LT(difference(0.01), 3e-3);
  EXPECT_GT(difference(1.0), 3.0 * difference(0.01)) << "the orifice is not in it";
}

TEST(SimulatedLoop, NoiseIsThatOfTheExactCovariance) {
  auto loop = reference_loop(pressure_controller());
  loop.noise = {0.5 * mdeg * loop.gear_ratio, 0.1, 25.0, 0.5};
  const double duration = 400.0;
  auto course = windy_course(loop, duration, 0.0, 0.0);
  const LoopRun run = run_linear_loop(loop, course);
  ASSERT_EQ(run.status, RunStatus::complete);
  control::SampledLoopNoise noise;
  noise.measurement_variance = {{"encoder", std::pow(loop.noise.encoder_rms, 2)},
                                {"tachometer", std::pow(loop.noise.tachometer_rms, 2)},
                                {"motor_torque", std::pow(loop.noise.torque_rms, 2)}};
  const auto exact =
      control::sampled_loop_rms(control::sampled_loop(plant::to_state_space(loop.linear),
                                                      pressure_controller(), loop.sample_time),
                                noise, {"beam"});
  // 400 s of a signal some 1 Hz wide: 4 % of scatter.
  EXPECT_NEAR(rms(run.boresight_error) * loop.gear_ratio / exact.at_samples[0], 1.0, 0.12);
}

// Without integrals; on the nonlinear antenna in motion, quantisation and all.
TEST(SimulatedLoop, RunsAStateSpaceAsTheLoopsThatItIsOf) {
  const control::Controller loops = reference::lag_loops();
  const auto loop = reference_loop(loops);
  auto same = loop;
  same.controller = control::state_space_controller(
      "sampled", plant::subsystem(control::sampled_controller(loops, loop.sample_time),
                                  {"tachometer", "encoder"}, {"valve_demand"}));
  const auto course = windy_course(loop, 30.0, 2.0, 1.0);
  const LoopRun expected = run_loop(loop, course), found = run_loop(same, course);
  ASSERT_EQ(expected.status, RunStatus::complete) << expected.message;
  ASSERT_EQ(found.status, RunStatus::complete) << found.message;
  EXPECT_LT((found.boresight_error - expected.boresight_error).cwiseAbs().maxCoeff(),
            1e-4 * rms(expected.boresight_error));
  const LoopRun linear = run_linear_loop(same, course);
  EXPECT_LT((linear.boresight_error - run_linear_loop(loop, course).boresight_error)
                .cwiseAbs()
                .maxCoeff(),
            1e-6 * rms(linear.boresight_error));
  EXPECT_THROW(run_linear_loop(same, course, 2), InvalidInput);
}

TEST(SimulatedLoop, FinerSamplingTendsToTheContinuousLoop) {
  const auto loop = reference_loop();
  const auto course = windy_course(loop, 40.0, 0.0, 1.0);
  LoopRunOptions options;
  options.noise = false;
  const auto error = [&](int finer) {
    return run_linear_loop(loop, course, finer, options).boresight_error;
  };
  const VectorXd limit = error(64);
  const double coarse = rms(error(4) - limit), fine = rms(error(8) - limit);
  EXPECT_LT(coarse, 0.02 * rms(limit));
  EXPECT_LT(fine, 0.6 * coarse);
}

// A ramp from rest under a position loop with next to no integral action.
TEST(SimulatedLoop, FeedforwardTakesAwayTheErrorOfARamp) {
  control::Controller controller{control::LoopStructure::pi_with_lag(), {0.2, 0.8, 6.0, 0.2, 1e-4}};
  auto loop = reference_loop(controller);
  const double rate = 2.0;  // rad/s of motor
  const auto course = shaped_course({100.0, 50.0}, loop.sample_time, 4000, 1, [&](double t) {
    return control::CommandSample{rate * t, t > 0.0 ? rate : 0.0, 0.0};
  });
  LoopRunOptions options;
  options.noise = false;
  options.without = everything;
  const auto lag = [&](bool feedforward) {
    loop.feedforward = feedforward;
    const LoopRun run = run_loop(loop, course, options);
    return -run.encoder_error.tail(1)[0] * loop.gear_ratio;
  };
  // The integral takes off 1e-4 of it a second.
  EXPECT_NEAR(lag(false), rate / 0.2 * std::exp(-1e-4 * 80.0), 0.01 * rate / 0.2);
  EXPECT_NEAR(lag(true), 0.0, 1e-3 * rate / 0.2);
}

TEST(SimulatedLoop, FeedforwardFollowsAnAcceleratingCommandWithASmallPartOfTheError) {
  auto loop = reference_loop();
  const double top = 50.0;
  const auto course = shaped_course({top, 5.0}, loop.sample_time, 2000, 1, [](double t) {
    return control::CommandSample{t > 0.0 ? 1000.0 : 0.0, 0.0, 0.0};
  });
  LoopRunOptions options;
  options.noise = false;
  options.without = everything;
  const auto largest = [&](bool feedforward) {
    loop.feedforward = feedforward;
    return run_loop(loop, course, options).encoder_error.cwiseAbs().maxCoeff();
  };
  const double without = largest(false);
  EXPECT_LT(largest(true), 0.2 * without);
  EXPECT_GT(without * loop.gear_ratio, 0.5) << "rad of motor: nothing to remove";
}

// A slow triangle with friction.
TEST(SimulatedLoop, FrictionFeedforwardReducesTheErrorOfAReversal) {
  auto loop = reference_loop();
  const double rate = 2.0, leg = 20.0;
  const auto course = shaped_course({100.0, 50.0}, loop.sample_time, 4000, 1, [&](double t) {
    const double phase = std::fmod(t, 2.0 * leg);
    return phase < leg ? control::CommandSample{rate * phase, rate, 0.0}
                       : control::CommandSample{rate * (2.0 * leg - phase), -rate, 0.0};
  });
  const auto largest = [&](double fraction, std::vector<Influence> without) {
    loop.friction_feedforward = fraction;
    return run_loop(loop, course, {.without = std::move(without), .noise = false})
        .encoder_error.tail(3000)
        .cwiseAbs()
        .maxCoeff();
  };
  const double without = largest(0.0, {});
  EXPECT_LT(largest(0.8, {}), 0.6 * without);
  EXPECT_GT(largest(0.4, {}), largest(0.8, {}));
  // Without friction there is none to feed forward.
  EXPECT_EQ(largest(0.8, {Influence::friction}), largest(0.0, {Influence::friction}));
}

// The command that holds a steady motion, by Newton's method on the nonlinear antenna, and the one
// fed forward. At the highest rate the load leaves a third of the supply for the flow.
TEST(SimulatedLoop, FeedforwardIsTheCommandOfASteadyMotionUnderLoad) {
  auto loop = reference_loop();
  loop.friction_feedforward = 1.0;
  loop.antenna.offset = {};
  loop.antenna.oil.null_leakage = 0.0;
  // Whatever friction the linear plant has, as at another rate.
  loop.linear.drive.viscous_friction = 12.0;
  control::AntennaController controller(loop.controller, loop.sample_time,
                                        {.feedforward = feedforward_of(loop)});
  for (const double rate : {2.0, 20.0, 50.0, -50.0}) {
    VectorXd measured(5), command(1);
    measured << rate, 0.0, 0.0, rate, 0.0;
    controller.restart();
    controller.update(0.0, measured, command);  // compresses the oil by the friction torque
    controller.update(0.0, measured, command);
    const double held = plant::trim(loop.antenna, {rate, 0.0, VectorXd::Zero(1)}).input[0];
    EXPECT_NEAR(command[0], held, 0.05 * std::abs(held)) << rate;
    if (std::abs(rate) > 30.0) {
      EXPECT_GT(std::abs(held), 1.3 * std::abs(rate));
    }
  }
}

// Rounding to steps is the encoder's noise: nothing is added to it.
TEST(SimulatedLoop, CountsTheEncodersNoiseOnce) {
  auto loop = reference_loop();
  loop.noise = {1e-3, 0.0, 25.0, 0.0};
  const auto course = windy_course(loop, 10.0, 2.0, 1.0);
  const auto error = [&](double resolution, bool noise) -> VectorXd {
    loop.encoder_resolution = resolution;
    return run_loop(loop, course, {.noise = noise}).encoder_error;
  };
  const double whole = std::sqrt(12.0) * loop.noise.encoder_rms * (1.0 + 1e-12);
  EXPECT_EQ(error(whole, true), error(whole, false));
  // Steps q have the variance q^2/12: with smaller ones some noise is left.
  const double smaller = 0.99 * whole;
  EXPECT_NE(error(smaller, true), error(smaller, false));
  EXPECT_NE(error(0.0, true), error(0.0, false));
}

TEST(SimulatedLoop, AntiWindupBoundsTheOvershootAfterSaturation) {
  auto loop = reference_loop();
  loop.feedforward = false;
  loop.antenna.valve.stroke_limit = 20.0;  // rad/s: a step of 200 rad takes ten seconds
  LoopRunOptions options;
  options.noise = false;
  options.without = {Influence::friction, Influence::quantisation, Influence::orifice,
                     Influence::gear};
  // A step that nothing shapes.
  const double step = 200.0;
  ReferenceTrajectory course = windy_course(loop, 80.0, 0.0, 0.0);
  course.reference.tail(course.reference.size() - 50).setConstant(step);
  const auto overshoot = [&](bool anti_windup) {
    loop.anti_windup = anti_windup;
    return run_loop(loop, course, options).encoder_error.maxCoeff() * loop.gear_ratio / step;
  };
  const double with = overshoot(true), without = overshoot(false);
  EXPECT_LT(with, 0.35);
  EXPECT_GT(without, 2.0 * with);
}

TEST(SimulatedLoop, StartsInTheMotionItIsToHold) {
  auto bending_law = pressure_controller();
  bending_law.structure = bending_law.structure.with_compliance_compensation();
  bending_law.gains.insert(bending_law.gains.end(), {1e-3, 1.0});
  for (const auto& controller : {tuned_controller(), pressure_controller(), bending_law}) {
    const auto loop = reference_loop(controller);
    const auto course = windy_course(loop, 20.0, 2.0, 0.0);
    LoopRunOptions options;
    options.noise = false;
    options.without = {Influence::quantisation};
    const LoopRun run = run_loop(loop, course, options);
    ASSERT_EQ(run.status, RunStatus::complete) << run.message;
    // The command of some 4 rad/s is missing for the first sample time, and no more than that.
    const VectorXd moved = run.encoder_error.array() - run.encoder_error[0];
    EXPECT_LT(moved.cwiseAbs().maxCoeff() * loop.gear_ratio, 3.0 * 4.0 * loop.sample_time)
        << controller.structure.name();
    EXPECT_LT(std::abs(moved.tail(1)[0]), 0.02 * mdeg) << controller.structure.name();
    // Compliance compensation holds the encoder ahead by the flexure under the torque less
    // friction.
    const double torque = plant::column(run.result, "motor_torque")[0] -
                          plant::friction_torque(feedforward_of(loop).friction, 2.0);
    EXPECT_NEAR(run.encoder_error[0] * loop.gear_ratio,
                controller.structure == bending_law.structure ? 1e-3 * torque : 0.0, 1e-9);
  }
}

TEST(SimulatedLoop, ShapedCourseIsThePreprocessorsMotionBetweenTheSamplesToo) {
  const control::CommandLimits limits{0.25, 0.2};
  const auto target = [](double t) {
    return control::CommandSample{t > 0.0 ? 0.5 : 0.0, 0.0, 0.0};
  };
  const auto fine = shaped_course(limits, 0.02, 300, 4, target);
  const auto coarse = shaped_course(limits, 0.02, 300, 1, target);
  ASSERT_EQ(fine.reference.size(), 1201);
  EXPECT_DOUBLE_EQ(fine.interval, 0.005);
  for (Index k = 0; k <= 300; ++k) EXPECT_DOUBLE_EQ(fine.reference[4 * k], coarse.reference[k]);
  EXPECT_EQ(fine.reference[1200], 0.5);
  for (Index k = 0; k < 1200; ++k) {
    EXPECT_NEAR(fine.reference[k + 1] - fine.reference[k],
                0.5 * fine.interval * (fine.reference_rate[k] + fine.reference_rate[k + 1]), 1e-13);
    EXPECT_NEAR(fine.reference_rate[k + 1] - fine.reference_rate[k],
                fine.interval * fine.reference_acceleration[k], 1e-13);
  }
}

TEST(SimulatedLoop, SaysWhatItHasToSwitchOff) {
  auto loop = reference_loop();
  for (const Influence influence : influences) {
    EXPECT_TRUE(has(loop, influence)) << to_string(influence);
  }
  loop.encoder_resolution = 0.0;
  loop.antenna.gear.backlash = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(has(loop, Influence::quantisation));
  EXPECT_FALSE(has(loop, Influence::gear));
  EXPECT_TRUE(has(loop, Influence::friction));
}

TEST(SimulatedLoop, RefusesWhatDoesNotFit) {
  const auto message = [](const auto& work) -> std::string {
    try {
      work();
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "accepted";
  };
  auto loop = reference_loop();
  auto course = windy_course(loop, 1.0, 0.0, 1.0);
  course.reference_rate.conservativeResize(10);
  EXPECT_THAT(message([&] { run_loop(loop, course); }),
              HasSubstr("references and wind torque of one length of at least 2"));
  course = windy_course(loop, 1.0, 0.0, 1.0);
  EXPECT_THAT(message([&] { run_linear_loop(loop, course, 0); }),
              HasSubstr("at least 1 times as fine, found 0"));
  course.interval = 0.0;
  EXPECT_THAT(message([&] { run_loop(loop, course); }), HasSubstr("interval above 0"));
  EXPECT_THAT(message([&] {
                shaped_course({1.0, 1.0}, 0.02, 0, 1, {});
              }),
              HasSubstr("at least 1 sample of at least 1 step, found 0 of 1"));
}

}  // namespace
}  // namespace boresight::design
