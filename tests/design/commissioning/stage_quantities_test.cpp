#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/commissioning/planned_stages.hpp"
#include <boresight/design/commissioning/stage_quantities.hpp>

namespace boresight::design {
namespace {

using testing::ElementsAre;

const CommissioningStage& first_stage() {
  return reference::planned_stages().plan.stages.front();
}

TEST(StageQuantities, AreThoseOfTheLoopThatIsClosed) {
  using enum StageQuantity;
  const auto& stages = reference::planned_stages().plan.stages;
  EXPECT_THAT(measured_quantities(stages.front()),
              ElementsAre(rise_time, overshoot, settling_time, valve_per_rate, calm_valve,
                          calm_tachometer));
  ASSERT_EQ(stages.back().kind, StageKind::feedforward);
  EXPECT_THAT(measured_quantities(stages.back()),
              ElementsAre(move_error, valve_per_rate, calm_valve, calm_encoder));
  CommissioningStage unstable = stages.front();
  unstable.expected.stable = 0;
  EXPECT_TRUE(measured_quantities(unstable).empty());
}

TEST(StageQuantities, AreReadFromObservationAndExpectationAlike) {
  using enum StageQuantity;
  StageObservation seen;
  seen.rise_time = 1.0;
  seen.overshoot = 2.0;
  seen.settling_time = 3.0;
  seen.calm = {4.0, 5.0, 6.0, 7.0};
  seen.move_error = 8.0;
  seen.valve_per_rate = 9.0;
  EXPECT_EQ(value_of(rise_time, seen), 1.0);
  EXPECT_EQ(value_of(overshoot, seen), 2.0);
  EXPECT_EQ(value_of(settling_time, seen), 3.0);
  EXPECT_EQ(value_of(calm_encoder, seen), 4.0);
  EXPECT_EQ(value_of(calm_tachometer, seen), 5.0);
  EXPECT_EQ(value_of(calm_valve, seen), 7.0);
  EXPECT_EQ(value_of(move_error, seen), 8.0);
  EXPECT_EQ(value_of(valve_per_rate, seen), 9.0);
  StageExpectation expected;
  expected.calm_valve.nominal = 7.0;
  expected.move_error.nominal = 8.0;
  EXPECT_EQ(expected_of(calm_valve, expected).nominal, 7.0);
  EXPECT_EQ(expected_of(move_error, expected).nominal, 8.0);
}

// Above the bracket but not beyond the limit the cause is to be found; beyond it, back.
TEST(StageVerdict, GoesFromPassingToAbort) {
  using enum StageQuantity;
  CommissioningStage stage = first_stage();
  stage.expected.overshoot = {0.1, 0.1, 0.1, 0.08, 0.12};
  stage.abort.overshoot = 0.2;
  const auto verdict = [&](double value, double uncertainty) {
    return verdict_on(overshoot, value, uncertainty, stage, 1.2);
  };
  EXPECT_EQ(verdict(0.1, 0.0), StageVerdict::passes);
  EXPECT_EQ(verdict(0.139, 0.0), StageVerdict::passes);
  EXPECT_EQ(verdict(0.141, 0.0), StageVerdict::outside);
  EXPECT_EQ(verdict(0.059, 0.0), StageVerdict::outside);
  EXPECT_EQ(verdict(0.201, 0.0), StageVerdict::abort);
  // Two standard uncertainties count for the stage.
  EXPECT_EQ(verdict(0.159, 0.01), StageVerdict::passes);
  EXPECT_EQ(verdict(0.219, 0.01), StageVerdict::outside);
  EXPECT_EQ(verdict(0.221, 0.01), StageVerdict::abort);
  EXPECT_EQ(verdict(std::numeric_limits<double>::quiet_NaN(), 0.0), StageVerdict::abort);
}

TEST(StageVerdict, AllowsAnRmsWhatTheSensorsNoiseMayBe) {
  using enum StageQuantity;
  CommissioningStage stage = first_stage();
  stage.expected.calm_tachometer = {1.0, 1.0, 1.0, 0.9, 1.1};
  EXPECT_EQ(verdict_on(calm_tachometer, 1.31, 0.0, stage, 1.2), StageVerdict::passes);
  EXPECT_EQ(verdict_on(calm_tachometer, 1.33, 0.0, stage, 1.2), StageVerdict::outside);
  EXPECT_EQ(verdict_on(calm_tachometer, 0.76, 0.0, stage, 1.2), StageVerdict::passes);
  EXPECT_EQ(verdict_on(calm_tachometer, 0.74, 0.0, stage, 1.2), StageVerdict::outside);
  EXPECT_FALSE(abort_limit(calm_tachometer, stage).has_value());
}

TEST(EvaluatedStage, NamesTheWorstQuantity) {
  using enum StageQuantity;
  const auto& planned = reference::planned_stages();
  const TrackingProblem problem = tracking_problem(planned.mission);
  StageObserver observer(problem, problem.plant, WindTable(problem), planned.move);
  StageObservation seen = observer.observe(first_stage().controller);
  EXPECT_EQ(evaluated(seen, first_stage(), 1.2).verdict, StageVerdict::passes);
  seen.rise_time *= 3.0;
  EXPECT_EQ(evaluated(seen, first_stage(), 1.2).verdict, StageVerdict::outside);
  EXPECT_EQ(evaluated(seen, first_stage(), 1.2).worst, rise_time);
  seen.calm.valve_command *= 10.0;
  EXPECT_EQ(evaluated(seen, first_stage(), 1.2).verdict, StageVerdict::abort);
  EXPECT_EQ(evaluated(seen, first_stage(), 1.2).worst, calm_valve);
  seen.stable = false;
  EXPECT_FALSE(evaluated(seen, first_stage(), 1.2).stable);
}

}  // namespace
}  // namespace boresight::design
