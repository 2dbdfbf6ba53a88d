#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/commissioning/planned_stages.hpp"
#include <boresight/design/commissioning/plant_update.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/antenna/antenna_change.hpp>

namespace boresight::design {
namespace {

constexpr std::size_t plants = 60;

// The fastest rate loop, before the position loop is closed.
std::size_t stage() {
  const auto& stages = reference::fast_stages().plan.stages;
  std::size_t last = 0;
  while (stages[last + 1].controller.position_open) ++last;
  return last;
}

// What an antenna shows in a stage, each quantity to 1 %.
MeasuredStage shown_by(const plant::AntennaPlant& plant, const SignalFactors& factors = {}) {
  const auto& planned = reference::fast_stages();
  const TrackingProblem problem = tracking_problem(planned.mission);
  StageObserver observer(problem, plant, WindTable(problem), planned.move, factors);
  const auto& of_plan = planned.plan.stages[stage()];
  const StageObservation seen = observer.observe(of_plan.controller);
  MeasuredStage measured{stage(), {}};
  for (const StageQuantity quantity : measured_quantities(of_plan)) {
    const double value = value_of(quantity, seen);
    measured.measurement.quantities.push_back({quantity, value, 0.01 * value, 4});
  }
  return measured;
}

PlantUpdate update_by(const MeasuredStage& measured, unsigned threads = 1) {
  const auto& planned = reference::fast_stages();
  TrialOptions options;
  options.threads = threads;
  return updated_plants(planned.mission, planned.distribution, planned.plan, planned.move,
                        {measured}, usual_faults(4.0, false), plants, options);
}

TEST(UpdatedPlants, HoldTheTruthAndNarrow) {
  const auto& planned = reference::fast_stages();
  int held = 0;
  int inputs = 0;
  int narrower = 0;
  constexpr int truths = 5;
  for (std::uint64_t truth = 0; truth < truths; ++truth) {
    const PlantSample sample = planned.distribution.draw(99, truth);
    const auto update = update_by(
        shown_by(plant::linear_plant(plant::changed(planned.mission.antenna, changes_of(sample)))));
    EXPECT_TRUE(update.explained);
    EXPECT_TRUE(update.faults.empty());
    EXPECT_GE(update.effective, 20.0);
    EXPECT_LE(update.effective, static_cast<double>(update.plants));
    for (const InputUpdate& input : update.inputs) {
      const double value = sample[input.input];
      held += value >= input.after.lower && value <= input.after.upper ? 1 : 0;
      ++inputs;
    }
    const InputUpdate& first = update.inputs.front();
    narrower +=
        first.after.upper - first.after.lower < 0.95 * (first.before.upper - first.before.lower)
            ? 1
            : 0;
  }
  // Of ten 95 % intervals, three misses have a probability of 1 %.
  EXPECT_GE(held, inputs - 2);
  EXPECT_GE(narrower, truths - 1);
}

TEST(UpdatedPlants, NameTheFaultThatExplainsTheRecord) {
  const TrackingProblem problem = tracking_problem(reference::fast_stages().mission);
  const auto update = update_by(shown_by(problem.plant, {.valve = 0.5}));
  EXPECT_FALSE(update.explained);
  ASSERT_FALSE(update.faults.empty());
  EXPECT_EQ(update.faults.front().fault, "valve gain halved");
  EXPECT_NEAR(update.faults.front().mismatch, 0.0, 1e-9);
  EXPECT_TRUE(std::ranges::is_sorted(update.faults, {}, &FaultFit::mismatch));
}

TEST(UpdatedPlants, AreTheSameForAnyNumberOfThreads) {
  const TrackingProblem problem = tracking_problem(reference::fast_stages().mission);
  const auto measured = shown_by(problem.plant);
  const auto one = update_by(measured, 1);
  const auto two = update_by(measured, 2);
  EXPECT_EQ(one.effective, two.effective);
  EXPECT_EQ(one.final_rms_after.mean, two.final_rms_after.mean);
  EXPECT_LE(one.final_rms_after.lower, one.final_rms_after.mean);
  EXPECT_GE(one.final_rms_after.upper, one.final_rms_after.mean);
}

TEST(UpdatedPlants, RefuseWhatTheyCannotWeigh) {
  const auto& planned = reference::fast_stages();
  const auto update = [&](const std::vector<MeasuredStage>& records, std::size_t count) {
    return updated_plants(planned.mission, planned.distribution, planned.plan, planned.move,
                          records, {}, count, {});
  };
  EXPECT_THROW(update({}, plants), InvalidInput);
  MeasuredStage measured{stage(), {}};
  EXPECT_THROW(update({measured}, plants), InvalidInput);
  measured.measurement.quantities = {{StageQuantity::rise_time, 1.0, 0.1, 1}};
  EXPECT_THROW(update({measured}, 5), InvalidInput);
  measured.stage = 99;
  EXPECT_THROW(update({measured}, plants), InvalidInput);
}

// What the model leaves out is the same for every record of a stage.
TEST(CombinedRecords, HaveTheMeanOfWhatSeveralMeasured) {
  using enum StageQuantity;
  const std::vector<MeasuredStage> records{
      {2,
       {.quantities = {{rise_time, 1.0, 0.3, 2}, {overshoot, 0.1, 0.01, 2}},
        .step_size = 0.0,
        .remarks = {}}},
      {0, {.quantities = {{calm_valve, 5.0, 0.1, 0}}, .step_size = 0.0, .remarks = {}}},
      {2, {.quantities = {{rise_time, 2.0, 0.4, 3}}, .step_size = 0.0, .remarks = {}}}};
  const auto both = combined(records);
  ASSERT_EQ(both.size(), 2U);
  EXPECT_EQ(both[0].stage, 2U);
  ASSERT_EQ(both[0].measurement.quantities.size(), 2U);
  const MeasuredQuantity& rise = both[0].measurement.quantities[0];
  EXPECT_EQ(rise.quantity, rise_time);
  EXPECT_DOUBLE_EQ(rise.value, 1.5);
  EXPECT_DOUBLE_EQ(rise.uncertainty, 0.25);
  EXPECT_EQ(rise.steps, 5U);
  EXPECT_DOUBLE_EQ(both[0].measurement.quantities[1].value, 0.1);
}

TEST(ComparisonDeviation, AddsWhatTheModelLeavesOut) {
  EXPECT_DOUBLE_EQ(comparison_deviation({StageQuantity::rise_time, 2.0, 0.08, 1}, {}), 0.1);
  EXPECT_DOUBLE_EQ(comparison_deviation({StageQuantity::overshoot, 0.5, 0.0, 1}, {}),
                   overshoot_resolution);
  EXPECT_DOUBLE_EQ(comparison_deviation({StageQuantity::calm_valve, 2.0, 0.0, 0}, {}), 0.2);
}

}  // namespace
}  // namespace boresight::design
