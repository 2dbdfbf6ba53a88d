#include <gtest/gtest.h>

#include "io/edited_case.hpp"
#include <boresight/app/simulate/time_domain.hpp>
#include <boresight/io/case/case_simulation.hpp>
#include <boresight/io/case/mission_of.hpp>

namespace boresight::app {
namespace {

// The gains in force are compared by the same records of wind as the recommended ones.
TEST(TimeDomain, SimulatesTheMissionsOwnGainsInAllRecords) {
  design::Mission mission = mission_of(io::read_case(case_path("dss14-70m")));
  const control::Controller controller{control::LoopStructure::pi_with_lag(),
                                       {0.2, 0.8, 6.0, 0.2, 0.02}};
  mission.present_controllers = {{"PI", controller}};
  const auto study = verify_in_time_domain(mission, tracking_problem(mission), controller, "PI", 1,
                                           2, design::FurtherRuns::none);
  ASSERT_TRUE(study && study->present && study->rms);
  ASSERT_TRUE(study->present->simulated_rms);
  EXPECT_NEAR(*study->present->simulated_rms, study->rms->rms.value, 1e-12 * study->rms->rms.value);
}

TEST(TimeDomain, NoneOfACaseThatSaysNothingOfItsDrive) {
  io::Case antenna = io::read_case(case_path("dss14-70m"));
  antenna.simulation.reset();
  const control::Controller controller{control::LoopStructure::pi_with_lag(),
                                       {0.2, 0.8, 6.0, 0.2, 0.02}};
  const design::Mission mission = mission_of(antenna);
  EXPECT_FALSE(verify_in_time_domain(mission, tracking_problem(mission), controller, "PI", 1, 1,
                                     design::FurtherRuns::none));
}

}  // namespace
}  // namespace boresight::app
