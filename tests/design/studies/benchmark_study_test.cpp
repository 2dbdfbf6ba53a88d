#include <gtest/gtest.h>

#include "design/studies/demo_mission.hpp"
#include <boresight/design/studies/benchmark_study.hpp>

namespace boresight::design {
namespace {

const control::Controller& slow_pi() {
  static const control::Controller controller{control::LoopStructure::pi_with_lag(),
                                              {0.1, 0.42, 2.6, 3.0, 0.2}};
  return controller;
}

TEST(StudyRejection, ScoresWhatTheAntennaRunsOnNow) {
  Mission mission = reference::demo_mission();
  const auto controller = controller_of(slow_pi(), "slow PI", 0.0);
  const auto members = {EnsembleMember{"nominal", linear_plant(mission.antenna)}};
  const BenchmarkStudy study = study_rejection(mission, members, controller, {});
  ASSERT_TRUE(study.score.stable);
  EXPECT_FALSE(study.present_gains);
  EXPECT_EQ(study.dead_time, mission.antenna.dead_time);
  EXPECT_EQ(study.attitudes, 0U);
  EXPECT_FALSE(study.step_course.empty());
  EXPECT_EQ(study.no_nonlinear, NoTimeDomain::none);
  ASSERT_TRUE(study.nonlinear.has_value());
  mission.present_controllers = {{"PI", slow_pi()}};
  mission.antenna.nonlinear.reset();
  const BenchmarkStudy linear = study_rejection(mission, members, controller, {});
  EXPECT_TRUE(linear.present_gains);
  EXPECT_EQ(linear.no_nonlinear, NoTimeDomain::linear_only);
  EXPECT_EQ(linear.score.abscissa, study.score.abscissa);
}

TEST(StudyRejection, SaysWhyNothingNonlinearRan) {
  const Mission mission = reference::demo_mission();
  BenchmarkedController controller = controller_of(slow_pi(), "slow PI", 0.0);
  controller.controller.reset();
  EXPECT_EQ(study_rejection(mission, {}, controller, {}).no_nonlinear, NoTimeDomain::state_space);
  control::Controller wild = slow_pi();
  wild.gains[0] = 50.0;
  const auto unstable = study_rejection(mission, {}, controller_of(wild, "wild", 0.0), {});
  EXPECT_FALSE(unstable.score.stable);
  EXPECT_EQ(unstable.no_nonlinear, NoTimeDomain::unstable);
}

TEST(StudyRejection, NoticesAnotherSampleTimeThanTheDeadTimeSays) {
  const Mission mission = reference::demo_mission();
  const double expected = mission.antenna.dead_time / 1.5;
  BenchmarkStudy study;
  study.expected_sample_time = expected;
  study.controller = controller_of(slow_pi(), "slow PI", expected);
  EXPECT_FALSE(study.samples_otherwise());
  study.controller = controller_of(slow_pi(), "slow PI", 2.0 * expected);
  EXPECT_TRUE(study.samples_otherwise());
  study.controller = controller_of(slow_pi(), "slow PI", 0.0);
  EXPECT_FALSE(study.samples_otherwise());
}

}  // namespace
}  // namespace boresight::design
