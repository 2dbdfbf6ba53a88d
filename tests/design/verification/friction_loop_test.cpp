#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "design/reference_problem.hpp"
#include "reference_nonlinear_antenna.hpp"
#include <boresight/design/verification/friction_loop.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::design {
namespace {

using reference::mdeg;

SimulatedLoop loop_with(double rate_integral, double position_integral) {
  auto details = reference::drive_details();
  details.friction.curve = {10.33, 16.83, 0.15, 63.29, 1.5, 2.075};
  details.friction.bristle_stiffness = 2500.0;
  details.friction.bristle_damping = 5.0;
  details.offset.constant = -5.65;
  return make_simulated_loop(reference::tracking_problem(), reference::nonlinear_antenna(details),
                             {control::LoopStructure::pi_with_lag(),
                              {0.1587, rate_integral, 2.6279, 10.258, position_integral}});
}

ReferenceTrajectory step_course(const SimulatedLoop& loop, double step, double duration) {
  const double gear = loop.gear_ratio;
  return shaped_course({gear * 250.0 * mdeg, gear * 200.0 * mdeg}, loop.sample_time,
                       whole_samples(duration, loop.sample_time), 1, [&](double t) {
                         return control::CommandSample{t > 0.0 ? gear * step : 0.0, 0.0, 0.0};
                       });
}

// Stuck, slipping, and moving back through the bristles.
TEST(FrictionLoop, FollowsAStepAsTheWholeAntenna) {
  for (const auto& [step, accuracy] : {std::pair{20.0 * mdeg, 0.03}, {-2.0 * mdeg, 0.06}}) {
    const SimulatedLoop loop = loop_with(0.42, 0.235);
    const ReferenceTrajectory course = step_course(loop, step, 20.0);
    const LoopRun whole = run_loop(loop, course, {.noise = false});
    const LoopRun reduced = run_friction_loop(loop, course);
    ASSERT_EQ(whole.status, RunStatus::complete);
    ASSERT_EQ(reduced.status, RunStatus::complete);
    EXPECT_LT((reduced.encoder_error - whole.encoder_error).cwiseAbs().maxCoeff(),
              accuracy * std::abs(step));
    EXPECT_LT((reduced.boresight_error - whole.boresight_error).cwiseAbs().maxCoeff(),
              accuracy * std::abs(step));
  }
}

TEST(FrictionLoop, EndsWhereItIsLost) {
  SimulatedLoop loop = loop_with(0.42, 0.235);
  // A valve that opens too little for the slew.
  loop.antenna.valve.stroke_limit = 1.0;
  const ReferenceTrajectory course = step_course(loop, 1000.0 * mdeg, 20.0);
  const LoopRun run = run_friction_loop(loop, course);
  EXPECT_EQ(run.status, RunStatus::lost);
  EXPECT_LT(run.encoder_error.size(), course.reference.size());
  EXPECT_EQ(run.encoder_error.size(), run.result.values.rows());
  EXPECT_GT(std::abs(run.encoder_error[run.encoder_error.size() - 1]), lost_error);
}

TEST(FrictionLoop, RefusesOtherIntervals) {
  const SimulatedLoop loop = loop_with(0.42, 0.235);
  ReferenceTrajectory course = step_course(loop, 2.0 * mdeg, 1.0);
  course.interval *= 0.5;
  EXPECT_THROW(run_friction_loop(loop, course), InvalidInput);
}

}  // namespace
}  // namespace boresight::design
