#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/reference_problem.hpp"
#include "lag_loops.hpp"
#include "reference_nonlinear_antenna.hpp"
#include <boresight/design/verification/integrator_agreement.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/wind/wind_time_series.hpp>

namespace boresight::design {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using reference::mdeg;
using testing::HasSubstr;

// The tuned PI controller of the reference antenna with friction, backlash, limits and oil lines.
SimulatedLoop reference_loop() {
  auto details = reference::drive_details();
  details.preload_torque = 20.0;
  details.backlash = 0.1;
  auto loop =
      make_simulated_loop(reference::tracking_problem(), reference::nonlinear_antenna(details),
                          control::Controller{control::LoopStructure::pi_with_lag(),
                                              {0.1587, 0.42067, 2.6279, 10.258, 0.23531}});
  loop.encoder_resolution = 0.34 * mdeg * loop.gear_ratio;
  return loop;
}

// Tracking at 4.2 mdeg/s in wind of 10 m/s.
ReferenceTrajectory windy_course(const SimulatedLoop& loop, double duration) {
  const auto wind = plant::synthesise_wind_torque(
      reference::wind_site(), plant::WindModel::coherence, 10.0, duration, loop.sample_time, 1);
  const double rate = 4.2 * mdeg * loop.gear_ratio;
  ReferenceTrajectory course;
  course.interval = loop.sample_time;
  course.wind_torque = (wind.uniform + wind.gradient) / loop.gear_ratio;
  const Index steps = course.wind_torque.size();
  course.reference =
      VectorXd::LinSpaced(steps, 0.0, rate * course.interval * static_cast<double>(steps - 1));
  course.reference_rate = VectorXd::Constant(steps, rate);
  course.reference_acceleration = VectorXd::Zero(steps);
  return course;
}

IntegratorAgreementOptions settling_for(double settling) {
  IntegratorAgreementOptions options;
  options.settling = settling;
  return options;
}

// Of a linear antenna the collocation's exponentials are the closed form.
TEST(IntegratorAgreement, CvodesFollowsTheClosedFormOfTheLinearLoop) {
  const auto loop = reference_loop();
  const auto course = windy_course(loop, 20.0);
  LoopRunOptions options;
  const VectorXd exact = run_linear_loop(loop, course, 1, options).boresight_error;
  options.integrator = plant::Integrator::cvodes;
  const VectorXd found = run_linear_loop(loop, course, 1, options).boresight_error;
  EXPECT_LT((found - exact).norm(), 1e-4 * exact.norm());
  EXPECT_NE(found, exact) << "the same integrator twice";
}

TEST(IntegratorAgreement, HoldsWithFrictionBacklashLimitsAndQuantisation) {
  auto loop = reference_loop();
  const auto agreement = integrator_agreement(loop, windy_course(loop, 25.0), settling_for(5.0));
  ASSERT_EQ(agreement.status, RunStatus::complete) << agreement.message;
  EXPECT_LT(agreement.ratio(), 1e-5);
  EXPECT_TRUE(agree(agreement));
  EXPECT_FALSE(agreement.ratio_without_quantisation);
  EXPECT_NEAR(agreement.collocation_rms, agreement.cvodes_rms, agreement.difference_rms);
  EXPECT_GT(agreement.cvodes_rms, 0.1 * mdeg);
  EXPECT_NEAR(agreement.duration, 20.0, 2.0 * loop.sample_time);
  EXPECT_GT(agreement.collocation_steps, 1000);
  EXPECT_GT(agreement.cvodes_steps, agreement.collocation_steps);
}

// Stick-slip: the antenna stands and breaks away again and again.
TEST(IntegratorAgreement, HoldsThroughStiction) {
  const auto loop = reference_loop();
  auto course = windy_course(loop, 40.0);
  course.reference.setZero();
  course.reference_rate.setZero();
  // Which sample breaks away first depends on small errors: both integrators by tighter tolerances.
  auto options = settling_for(10.0);
  options.relative_tolerance = 1e-8;
  options.absolute_tolerance = 1e-10;
  options.cvodes_relative_tolerance = options.cvodes_absolute_tolerance = 1e-9;
  const auto agreement = integrator_agreement(loop, course, options);
  ASSERT_EQ(agreement.status, RunStatus::complete) << agreement.message;
  EXPECT_LT(agreement.ratio(), 1e-5);
}

TEST(IntegratorAgreement, FallsShortByLooseTolerances) {
  const auto loop = reference_loop();
  const auto course = windy_course(loop, 15.0);
  auto options = settling_for(5.0);
  const double tight = integrator_agreement(loop, course, options).ratio();
  options.cvodes_relative_tolerance = options.cvodes_absolute_tolerance = 1e-3;
  const auto loose = integrator_agreement(loop, course, options);
  EXPECT_GT(loose.ratio(), 100.0 * tight);
  EXPECT_FALSE(agree(loose));
  // Encoder steps are not why.
  ASSERT_TRUE(loose.ratio_without_quantisation);
  EXPECT_GT(*loose.ratio_without_quantisation, integrator_agreement_limit);
  EXPECT_EQ(loose.cvodes_relative_tolerance, 1e-3);
}

// The encoder's difference from sample to sample, fed back, makes a jolt of the valve command of
// each of its steps: where the two runs round a sample to different codes they part.
TEST(IntegratorAgreement, TakesNoDifferenceByEncoderStepsForOneOfIntegration) {
  plant::StateSpace states = *reference::lag_loops_as_state_space().structure.state_space();
  const double rate_gain = 0.4 / states.sample_time;
  const Index n = states.a.rows();
  states.states.emplace_back("last encoder");
  states.a.conservativeResizeLike(Eigen::MatrixXd::Zero(n + 1, n + 1));
  states.b.conservativeResizeLike(Eigen::MatrixXd::Zero(n + 1, 2));
  states.b(n, 1) = 1.0;
  states.c.conservativeResizeLike(Eigen::MatrixXd::Zero(1, n + 1));
  states.c(0, n) = rate_gain;
  states.d(0, 1) -= rate_gain;
  SimulatedLoop loop = reference_loop();
  loop.controller = control::state_space_controller("encoder rate", states);
  loop.encoder_resolution = 3.4 * mdeg * loop.gear_ratio;
  auto options = settling_for(5.0);
  options.relative_tolerance = 1e-3;
  options.absolute_tolerance = 1e-5;
  const auto course = windy_course(loop, 25.0);
  const auto stepped = integrator_agreement(loop, course, options);
  EXPECT_GT(stepped.ratio(), 10.0 * integrator_agreement_limit);
  ASSERT_TRUE(stepped.ratio_without_quantisation);
  EXPECT_LT(*stepped.ratio_without_quantisation, 0.3 * integrator_agreement_limit);
  EXPECT_TRUE(agree(stepped));
  loop.encoder_resolution = 0.0;
  EXPECT_LT(integrator_agreement(loop, course, options).ratio(), 0.3 * integrator_agreement_limit);
}

TEST(IntegratorAgreement, SameBitsAgain) {
  const auto loop = reference_loop();
  const auto course = windy_course(loop, 4.0);
  const auto run = [&] {
    const auto agreement = integrator_agreement(loop, course, settling_for(1.0));
    return std::vector<double>{agreement.collocation_rms, agreement.cvodes_rms,
                               agreement.difference_rms,
                               static_cast<double>(agreement.cvodes_steps)};
  };
  EXPECT_EQ(run(), run());
}

TEST(IntegratorAgreement, RunsWithoutAUsableEndAreStatedResults) {
  auto loop = reference_loop();
  const auto course = windy_course(loop, 2.0);
  // A tachometer of a microsecond is too stiff for CVODES as it is used here, not for collocation.
  auto stiff = loop;
  stiff.antenna.tachometer_corner = 1e7;
  const auto failed = integrator_agreement(stiff, course, settling_for(1.0));
  EXPECT_EQ(failed.status, RunStatus::failed);
  EXPECT_THAT(failed.message, HasSubstr("OdeIntegrator: no way from"));
  EXPECT_GT(failed.collocation_rms, 0.0);
  EXPECT_TRUE(std::isnan(failed.ratio()));
  EXPECT_FALSE(agree(failed));
  // Nothing to compare where the first run is lost already.
  loop.controller.gains[4] = 5.0;  // the position integral: unstable
  const auto lost = integrator_agreement(loop, windy_course(loop, 60.0), settling_for(1.0));
  EXPECT_EQ(lost.status, RunStatus::lost);
  EXPECT_EQ(lost.cvodes_steps, 0);
  EXPECT_FALSE(agree(lost));
}

TEST(IntegratorAgreement, RefusesASettlingTimeBeyondTheCourse) {
  const auto loop = reference_loop();
  const auto course = windy_course(loop, 2.0);
  for (const double settling : {-1.0, 2.5, std::nan("")}) {
    EXPECT_THROW(integrator_agreement(loop, course, settling_for(settling)), InvalidInput);
  }
}

}  // namespace
}  // namespace boresight::design
