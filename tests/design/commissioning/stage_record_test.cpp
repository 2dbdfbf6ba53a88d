#include <cmath>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/commissioning/planned_stages.hpp"
#include <boresight/control/loops/command_loop.hpp>
#include <boresight/design/commissioning/stage_record.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/linear/time_response.hpp>

namespace boresight::design {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using testing::HasSubstr;

constexpr double sample_time = 0.02;

const CommissioningStage& stage_with(bool position_open) {
  const auto& stages = reference::planned_stages().plan.stages;
  for (const auto& stage : stages) {
    if (stage.controller.position_open == position_open && stage.kind != StageKind::feedforward) {
      return stage;
    }
  }
  throw NumericalFailure("no such stage");
}

StageObservation observed(const CommissioningStage& stage) {
  const auto& planned = reference::planned_stages();
  const TrackingProblem problem = tracking_problem(planned.mission);
  return StageObserver(problem, problem.plant, WindTable(problem), planned.move)
      .observe(stage.controller);
}

// A square wave of the command on a steady motion, and the linear antenna's answer with noise.
identification::ServoRecord square_wave(const CommissioningStage& stage, double noise, int halves) {
  const TrackingProblem problem = tracking_problem(reference::planned_stages().mission);
  const plant::StateSpace system = plant::to_state_space(problem.plant);
  const bool open = stage.controller.position_open;
  const auto loop =
      open ? control::rate_command_loop(system, stage.controller.controller, problem.delay)
           : control::position_command_loop(system, stage.controller.controller, problem.delay);
  const auto half = static_cast<Index>(60.0 / (stage.expected.crossover.nominal * sample_time));
  const Index samples = half * (halves + 1);
  constexpr double size = 3.0;
  constexpr double rate = 0.01;  // of the motion below a position step, per second
  Eigen::MatrixXd input = Eigen::MatrixXd::Zero(samples, static_cast<Index>(loop.inputs.size()));
  for (Index k = 0; k < samples; ++k) {
    const double motion = open ? rate : rate * sample_time * static_cast<double>(k);
    input(k, 0) = motion + ((k / half) % 2 == 1 ? size : 0.0);
  }
  plant::LinearSimulation simulation(loop, sample_time);
  VectorXd response = simulation.simulate(input).col(0);
  std::mt19937 numbers(7);
  std::normal_distribution<double> normal(0.0, noise * size);
  for (double& value : response) value += normal(numbers);
  identification::ServoRecord record;
  record.name = "square wave";
  record.sample_time = sample_time;
  (open ? record.rate_command : record.position_command) = identification::Signal{input.col(0), {}};
  (open ? record.motor_rate : record.encoder) = identification::Signal{response, {}};
  return record;
}

const MeasuredQuantity& quantity_of(const StageMeasurement& measurement, StageQuantity quantity) {
  for (const auto& one : measurement.quantities) {
    if (one.quantity == quantity) return one;
  }
  throw NumericalFailure("not measured");
}

TEST(MeasureStage, ReadsWhatTheObserverPredicts) {
  for (const bool open : {true, false}) {
    const CommissioningStage& stage = stage_with(open);
    const StageObservation expected = observed(stage);
    const auto measured = measure_stage(square_wave(stage, 0.0, 4), stage, 1.0);
    EXPECT_NEAR(quantity_of(measured, StageQuantity::rise_time).value, expected.rise_time,
                0.02 * expected.rise_time + sample_time);
    EXPECT_NEAR(quantity_of(measured, StageQuantity::overshoot).value, expected.overshoot, 0.01);
    EXPECT_NEAR(quantity_of(measured, StageQuantity::settling_time).value, expected.settling_time,
                0.05 * expected.settling_time);
    EXPECT_NEAR(measured.step_size, 3.0, 0.05);
  }
}

// The truth lies within four standard uncertainties, which noise makes what they are.
TEST(MeasureStage, StatesWhatNoiseLeavesUncertain) {
  const CommissioningStage& stage = stage_with(false);
  const StageObservation expected = observed(stage);
  for (const int halves : {1, 6}) {
    const auto measured = measure_stage(square_wave(stage, 0.02, halves), stage, 1.0);
    const auto& rise = quantity_of(measured, StageQuantity::rise_time);
    const auto& overshoot = quantity_of(measured, StageQuantity::overshoot);
    EXPECT_EQ(rise.steps, static_cast<std::size_t>(halves));
    EXPECT_NEAR(rise.value, expected.rise_time, 4.0 * rise.uncertainty + 0.02 * expected.rise_time);
    EXPECT_NEAR(overshoot.value, expected.overshoot, 4.0 * overshoot.uncertainty + 0.02);
    EXPECT_GT(overshoot.uncertainty, 0.0);
    EXPECT_EQ(worst_verdict(evaluated(measured, stage, 1.2)), StageVerdict::passes);
  }
}

// On another time base a step is split over two samples.
TEST(MeasureStage, ReadsStepsThatInterpolationHasSplit) {
  const CommissioningStage& stage = stage_with(false);
  const StageObservation expected = observed(stage);
  for (const double part : {0.3, 0.6, 0.9}) {
    auto record = square_wave(stage, 0.0, 4);
    for (auto* signal : {&*record.position_command, &*record.encoder}) {
      const VectorXd before = signal->values;
      const Index n = before.size();
      signal->values.tail(n - 1) = part * before.tail(n - 1) + (1.0 - part) * before.head(n - 1);
    }
    const auto measured = measure_stage(record, stage, 1.0);
    EXPECT_EQ(quantity_of(measured, StageQuantity::rise_time).steps, 4U);
    EXPECT_NEAR(quantity_of(measured, StageQuantity::overshoot).value, expected.overshoot, 0.01);
    EXPECT_NEAR(measured.step_size, 3.0, 0.05);
  }
}

TEST(MeasureStage, LeavesOutStepsWithSamplesThatAreNotValid) {
  const CommissioningStage& stage = stage_with(true);
  const StageObservation expected = observed(stage);
  auto record = square_wave(stage, 0.0, 4);
  const Index n = record.motor_rate->values.size();
  // A gap in the second step's rise, bridged by a straight line.
  const Index gap = 2 * n / 5;
  record.motor_rate->valid.assign(static_cast<std::size_t>(n), true);
  for (Index k = gap; k < gap + 50; ++k) {
    record.motor_rate->valid[static_cast<std::size_t>(k)] = false;
    record.motor_rate->values[k] = 0.0;
  }
  const auto measured = measure_stage(record, stage, 1.0);
  EXPECT_EQ(quantity_of(measured, StageQuantity::rise_time).steps, 3U);
  EXPECT_NEAR(quantity_of(measured, StageQuantity::rise_time).value, expected.rise_time,
              0.02 * expected.rise_time + sample_time);
  EXPECT_THAT(measured.remarks, testing::Contains(HasSubstr("1 of 4 steps are left out")));
}

// A valve of another gain takes another command for the same rate.
TEST(MeasureStage, ReadsTheValveCommandThatARateTakes) {
  const CommissioningStage& stage = stage_with(true);
  auto record = square_wave(stage, 0.005, 4);
  record.valve_command =
      identification::Signal{0.875 * record.motor_rate->values.array() + 4.0, {}};
  const auto measured = measure_stage(record, stage, 1.0);
  const auto& one = quantity_of(measured, StageQuantity::valve_per_rate);
  EXPECT_NEAR(one.value, 0.875, 4.0 * one.uncertainty + 1e-9);
  EXPECT_LT(one.uncertainty, 0.02);
  EXPECT_EQ(verdict_on(StageQuantity::valve_per_rate, one.value, one.uncertainty, stage, 1.2),
            StageVerdict::outside);
}

TEST(MeasureStage, ReadsTheValveCommandOfARateThatOvershoots) {
  const CommissioningStage& stage = stage_with(true);
  identification::ServoRecord record;
  record.name = "overshoot";
  record.sample_time = sample_time;
  constexpr Index count = 6000;
  VectorXd rate(count), command(count);
  for (Index k = 0; k < count; ++k) {
    const bool moves = k >= count / 3 && k < 2 * count / 3;
    const double since = sample_time * static_cast<double>(k - count / 3);
    command[k] = moves ? 3.0 : 2.0;
    rate[k] = moves ? 3.0 + 0.4 * std::exp(-since / 2.0) : 2.0;
  }
  record.rate_command = identification::Signal{command, {}};
  record.motor_rate = identification::Signal{rate, {}};
  record.valve_command = identification::Signal{1.2 * rate, {}};
  const auto measured = measure_stage(record, stage, 1.0);
  EXPECT_NEAR(quantity_of(measured, StageQuantity::valve_per_rate).value, 1.2, 1e-6);
}

// A slow motion that is commanded in steps of its resolution is as good as rest.
TEST(MeasureStage, ReadsStillAirOnASlowQuantisedMotion) {
  const CommissioningStage& stage = stage_with(false);
  identification::ServoRecord record;
  record.name = "slow";
  record.sample_time = sample_time;
  VectorXd command(4000), error(4000);
  for (Index k = 0; k < command.size(); ++k) {
    command[k] = 1e-5 * std::floor(0.02 * static_cast<double>(k));
    error[k] = 3e-6 * std::sin(0.7 * static_cast<double>(k));
  }
  record.position_command = identification::Signal{command, {}};
  record.encoder = identification::Signal{command - error, {}};
  record.position_error = identification::Signal{error, {}};
  const auto measured = measure_stage(record, stage, 10.0);
  ASSERT_EQ(measured.quantities.size(), 1U);
  EXPECT_NEAR(quantity_of(measured, StageQuantity::calm_encoder).value,
              10.0 * 3e-6 / std::sqrt(2.0), 1e-6);
}

// Not the rms in still air, and no step either.
TEST(MeasureStage, ReadsNothingFromAMotionInAStageOfSteps) {
  const CommissioningStage& stage = stage_with(false);
  identification::ServoRecord record;
  record.name = "scan";
  record.sample_time = sample_time;
  VectorXd command(2000);
  for (Index k = 0; k < command.size(); ++k) {
    command[k] = 0.01 * std::abs(static_cast<double>(k) - 1000.0);
  }
  record.position_command = identification::Signal{command, {}};
  record.encoder = identification::Signal{command, {}};
  record.position_error = identification::Signal{VectorXd::Zero(2000), {}};
  const auto measured = measure_stage(record, stage, 1.0);
  EXPECT_TRUE(measured.quantities.empty());
  EXPECT_THAT(measured.remarks, testing::Contains(HasSubstr("moves without a step")));
}

TEST(MeasureStage, DoesNotDependOnTheUnitOrTheSignOfTheStep) {
  const CommissioningStage& stage = stage_with(true);
  auto record = square_wave(stage, 0.01, 4);
  const auto first = measure_stage(record, stage, 1.0);
  record.rate_command->values *= -20.0;
  record.motor_rate->values *= -20.0;
  const auto second = measure_stage(record, stage, 1.0);
  ASSERT_EQ(first.quantities.size(), second.quantities.size());
  for (std::size_t i = 0; i < first.quantities.size(); ++i) {
    EXPECT_NEAR(second.quantities[i].value, first.quantities[i].value, 1e-9);
    EXPECT_NEAR(second.quantities[i].uncertainty, first.quantities[i].uncertainty, 1e-9);
  }
}

// White noise through a low pass has as many independent squares as its correlation leaves.
TEST(MeasureStage, KnowsTheUncertaintyOfAnRmsOfCorrelatedSamples) {
  const CommissioningStage& stage = stage_with(true);
  constexpr double memory = 0.95;
  std::vector<double> values;
  double relative = 0.0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    std::mt19937 numbers(seed);
    std::normal_distribution<double> normal;
    identification::ServoRecord record;
    record.name = "still";
    record.sample_time = sample_time;
    VectorXd rate(6000);
    double state = 0.0;
    for (double& value : rate) {
      state = memory * state + normal(numbers);
      value = state;
    }
    record.motor_rate = identification::Signal{rate, {}};
    const auto measured = measure_stage(record, stage, 1.0);
    EXPECT_THAT(measured.remarks, testing::Contains(HasSubstr("no channel for the valve")));
    const auto& one = quantity_of(measured, StageQuantity::calm_tachometer);
    values.push_back(one.value);
    relative += one.uncertainty / one.value / 40.0;
  }
  double mean = 0.0;
  double square = 0.0;
  for (const double value : values) mean += value / 40.0;
  for (const double value : values) square += std::pow(value - mean, 2) / 39.0;
  EXPECT_NEAR(mean, 1.0 / std::sqrt(1.0 - memory * memory), 0.03 * mean);
  // The scatter of 40 values is itself known to 11 %.
  EXPECT_NEAR(std::sqrt(square) / mean, relative, 0.3 * relative);
}

// The largest error of a move, less what was there before it.
TEST(MeasureStage, ReadsTheErrorOfAMove) {
  const CommissioningStage& stage = reference::planned_stages().plan.stages.back();
  ASSERT_EQ(stage.kind, StageKind::feedforward);
  constexpr Index samples = 2000;
  constexpr double gear = 100.0;
  constexpr double offset = 2e-6;
  constexpr double peak = 7e-6;
  VectorXd command(samples), error(samples);
  for (Index k = 0; k < samples; ++k) {
    const double part = static_cast<double>(k) / samples;
    command[k] = part < 0.3 ? 1e-4 * part : 1e-4 * part + 0.01 * std::min(part - 0.3, 0.3);
    error[k] = offset + (part > 0.3 && part < 0.4 ? -peak : 0.0);
  }
  identification::ServoRecord record;
  record.name = "move";
  record.sample_time = sample_time;
  record.position_command = identification::Signal{command, {}};
  record.position_error = identification::Signal{error, {}};
  const auto measured = measure_stage(record, stage, gear);
  ASSERT_EQ(measured.quantities.size(), 1U);
  EXPECT_EQ(measured.quantities.front().quantity, StageQuantity::move_error);
  EXPECT_NEAR(measured.quantities.front().value, gear * peak, 1e-12);
  EXPECT_NEAR(measured.quantities.front().uncertainty, 0.0, 1e-12);
}

TEST(MeasureStage, RefusesARecordThatShowsNothingOfTheStage) {
  const CommissioningStage& stage = stage_with(true);
  identification::ServoRecord record;
  record.name = "empty";
  record.sample_time = sample_time;
  EXPECT_THROW(measure_stage(record, stage, 1.0), InvalidInput);
  record.motor_rate = identification::Signal{VectorXd::Zero(50), {}};
  EXPECT_THROW(measure_stage(record, stage, 1.0), InvalidInput);
  record.motor_rate = identification::Signal{VectorXd::Zero(500), {}};
  record.sample_time = 0.0;
  EXPECT_THROW(measure_stage(record, stage, 1.0), InvalidInput);
}

}  // namespace
}  // namespace boresight::design
