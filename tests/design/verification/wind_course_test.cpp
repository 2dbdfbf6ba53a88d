#include <gtest/gtest.h>

#include "design/studies/demo_mission.hpp"
#include <boresight/design/verification/wind_course.hpp>
#include <boresight/plant/nonlinear/nonlinear_drive.hpp>
#include <boresight/plant/wind/wind_time_series.hpp>

namespace boresight::design {
namespace {

using Eigen::VectorXd;

// A series of a seed is that of plant::synthesise_wind_torque, at the motor, in every wind model.
TEST(WindCourses, AreTheSynthesisedTorqueOfTheirSeedWithTheMean) {
  Mission mission = reference::demo_mission();
  for (const auto model : {plant::WindModel::coherence, plant::WindModel::uniform}) {
    mission.wind.model = model;
    const TrackingProblem problem = tracking_problem(mission);
    const SimulatedLoop loop =
        make_simulated_loop(problem, plant::nonlinear_antenna(mission.antenna),
                            control::Controller{control::LoopStructure::pi_with_lag(),
                                                {0.1587, 0.42067, 2.6279, 10.258, 0.23531}});
    constexpr double rate = 2.0, duration = 20.0;
    const WindCourses courses(problem, loop, rate, duration);
    const ReferenceTrajectory course = courses.course(7);
    ASSERT_EQ(course.wind_torque.size(), courses.samples());
    EXPECT_NEAR(static_cast<double>(courses.samples() - 1) * course.interval, duration, 1e-9);
    const auto& wind = problem.wind;
    const auto parts = plant::synthesise_wind_torque(
        wind.site, model, wind.mean_speed,
        loop.sample_time * static_cast<double>(courses.samples()), loop.sample_time, 7);
    const VectorXd expected =
        (parts.uniform + parts.gradient).head(courses.samples()) / problem.gear_ratio;
    EXPECT_LT((courses.gusts(7) - expected).cwiseAbs().maxCoeff(),
              1e-12 * expected.cwiseAbs().maxCoeff());
    const double mean = plant::mean_wind_torque(wind.site, wind.mean_speed) / problem.gear_ratio;
    EXPECT_LT((course.wind_torque - courses.gusts(7)).cwiseAbs().maxCoeff() / mean, 1.0 + 1e-12);
    EXPECT_NEAR(course.wind_torque[5] - courses.gusts(7)[5], mean, 1e-12 * mean);
    EXPECT_NE(courses.gusts(8), courses.gusts(7));
    EXPECT_NEAR(course.reference[course.reference.size() - 1], rate * duration, 1e-9);
  }
}

TEST(SteadyCourse, MovesAtItsRate) {
  const ReferenceTrajectory course = steady_course(0.5, 3.0, VectorXd::LinSpaced(5, 0.0, 1.0));
  EXPECT_EQ(course.reference, VectorXd::LinSpaced(5, 0.0, 6.0));
  EXPECT_EQ(course.reference_rate, VectorXd::Constant(5, 3.0));
  EXPECT_EQ(course.reference_acceleration, VectorXd::Zero(5));
  EXPECT_EQ(course.wind_torque[4], 1.0);
}

}  // namespace
}  // namespace boresight::design
