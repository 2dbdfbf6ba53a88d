#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/reference_problem.hpp"
#include "lag_loops.hpp"
#include <boresight/control/analysis/step_characteristics.hpp>
#include <boresight/design/commissioning/commissioning.hpp>
#include <boresight/design/commissioning/commissioning_path.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::design {
namespace {

using control::Controller;
using control::LoopStructure;
using testing::HasSubstr;
using testing::StartsWith;

TrackingProblem problem_of_test() {
  TrackingProblem problem = reference::tracking_problem();
  problem.points_per_decade = 60;
  return problem;
}

const CommandedMove move{10.0, 5.0};

std::vector<EnsembleMember> few_members(const TrackingProblem& problem) {
  std::vector<EnsembleMember> members;
  for (const double stiffness : {0.8, 1.33}) {
    for (const double leakage : {0.4, 1.0}) {
      EnsembleMember member{"K x " + std::to_string(stiffness), problem.plant};
      member.plant.drive.oil_stiffness *= stiffness;
      member.plant.drive.leakage_rate *= leakage;
      members.push_back(std::move(member));
    }
  }
  return members;
}

// Near what a robust tuning on the reference antenna comes to.
Controller pressure_controller() {
  return {LoopStructure::named("DPF"), {1.2, 2.0, 300.0, 0.204, 5.66, 0.8, 0.2}};
}
Controller compliance_law() {
  return {LoopStructure::named("DPF+C"),
          {1.43, 2.06, 300.0, 0.2, 5.23, 1.05, 0.0905, 0.0087, 2.22}};
}

double gain_of(const Controller& controller, const std::string& symbol) {
  const auto& gains = controller.structure.gains();
  for (std::size_t i = 0; i < gains.size(); ++i) {
    if (gains[i].symbol == symbol) return controller.gains[i];
  }
  return std::numeric_limits<double>::quiet_NaN();
}

TEST(StageObserver, AgreesWithTheEvaluatorAndTheExactStepResponse) {
  const auto problem = problem_of_test();
  const auto controller = reference::cautious_gains();
  StageObserver observer(problem, problem.plant, WindTable(problem), move);
  const auto seen = observer.observe({controller, false, false});
  auto evaluator = make_evaluator(problem);
  const auto evaluation = evaluator.evaluate(controller, false);
  EXPECT_TRUE(seen.stable);
  EXPECT_NEAR(seen.calm.valve_command, std::sqrt(evaluation.effort_variance),
              2e-3 * seen.calm.valve_command);
  EXPECT_NEAR(seen.boresight_rms, std::sqrt(evaluation.boresight_variance()),
              1e-3 * seen.boresight_rms);
  EXPECT_NEAR(seen.peak,
              std::max({evaluation.highest_peak(control::LoopBreak::rate_loop_alone),
                        evaluation.highest_peak(control::LoopBreak::valve_command),
                        evaluation.highest_peak(control::LoopBreak::position_loop)}),
              1e-3);

  const auto exact = control::step_characteristics(
      reference::command_to_encoder(problem, controller), {.settling_band = 0.05});
  EXPECT_NEAR(seen.rise_time, exact.rise_time, 1e-3 * exact.rise_time);
  EXPECT_NEAR(seen.overshoot, exact.overshoot, 1e-3);
  EXPECT_NEAR(seen.settling_time, exact.settling_time, 2e-2 * exact.settling_time);
}

TEST(StageObserver, KnowsWhatAnAccelerationAndItsFeedforwardLeave) {
  const auto problem = problem_of_test();
  const auto controller = pressure_controller();
  // So long a ramp that the error settles: acceleration over kp wip (the loop's acceleration
  // constant, the rate loop's own integral making its gain 1).
  const double acceleration = 0.01;
  StageObserver observer(problem, problem.plant, WindTable(problem),
                         {acceleration * 200.0, acceleration});
  const double left = observer.observe({controller, false, false}).move_error;
  const double settled = acceleration / (gain_of(controller, "kp") * gain_of(controller, "wip"));
  EXPECT_GT(left, 0.98 * settled);
  EXPECT_LT(left, 1.5 * settled);  // it swings into that
  EXPECT_LT(observer.observe({controller, false, true}).move_error, 0.3 * left);
}

TEST(StageObserver, HasNothingToSayOfAPositionLoopThatIsOpen) {
  const auto problem = problem_of_test();
  StageObserver observer(problem, problem.plant, WindTable(problem), move);
  const auto seen = observer.observe({pressure_controller(), true, false});
  EXPECT_TRUE(seen.stable);
  EXPECT_TRUE(std::isnan(seen.boresight_rms));
  EXPECT_TRUE(std::isnan(seen.calm.encoder_error));
  EXPECT_TRUE(std::isnan(seen.move_error));
  EXPECT_GT(seen.calm.tachometer, problem.noise.tachometer_rms * 0.5);
  EXPECT_GT(seen.windy.torque, seen.calm.torque);
  Controller wild = pressure_controller();
  wild.gains[0] *= 50.0;
  const auto lost = observer.observe({wild, true, false});
  EXPECT_FALSE(lost.stable);
  EXPECT_GT(lost.abscissa, 0.0);
  EXPECT_TRUE(std::isnan(lost.rise_time));
  EXPECT_THROW(StageObserver(problem, problem.plant, WindTable(problem), {0.0, 1.0}), InvalidInput);
}

TEST(CommissioningPath, PutsWhatIsNotThereWhereItDoesNothing) {
  const Controller pi{LoopStructure::named("PI-0"), {0.2, 1.0, 0.3, 0.05}};
  const auto within = controller_within(pi, compliance_law());
  ASSERT_TRUE(within.has_value());
  EXPECT_FALSE(within->structure.has(control::LoopPath::pressure));
  EXPECT_FALSE(within->structure.has(control::LoopPath::compliance));
  EXPECT_EQ(gain_of(*within, "kr"), 0.2);
  EXPECT_EQ(gain_of(*within, "wip"), 0.05);
  EXPECT_GE(gain_of(*within, "wp"), 300.0);
  // The same response, but for a lag far above all that moves.
  const auto one = control::compensator_response(pi, 3.0);
  const auto other = control::compensator_response(*within, 3.0);
  EXPECT_NEAR(std::abs(other.rate / one.rate), 1.0, 0.01);
  EXPECT_EQ(one.position, other.position);
  EXPECT_FALSE(controller_within(compliance_law(), pi).has_value());
  EXPECT_EQ(detuned(pi, 2.0, 4.0).gains, (std::vector<double>{0.1, 1.0, 0.075, 0.0125}));
}

void expect_orderly(const CommissioningPlan& plan, const Controller& target, double limit) {
  ASSERT_GE(plan.stages.size(), 4u);
  EXPECT_EQ(plan.stages.back().kind, StageKind::feedforward);
  EXPECT_TRUE(plan.stages.back().controller.feedforward);
  EXPECT_EQ(plan.stages.back().controller.controller.gains, target.gains);
  bool closed = false;
  std::map<std::string, double> direction;
  const Controller* before = nullptr;
  for (const auto& stage : plan.stages) {
    if (stage.kind == StageKind::as_found) continue;
    const bool open =
        stage.kind == StageKind::rate_loop || stage.kind == StageKind::pressure_feedback;
    EXPECT_EQ(stage.controller.position_open, open);
    EXPECT_FALSE(open && closed) << "the position loop was closed before";
    closed = closed || !open;
    EXPECT_EQ(stage.expected.stable, stage.expected.plants);
    EXPECT_LE(stage.expected.peak.largest, limit * 1.0001);
    EXPECT_GE(stage.abort.overshoot, stage.expected.overshoot.largest);
    EXPECT_GE(stage.abort.calm_valve_rms, stage.expected.calm_valve.largest);
    EXPECT_GE(stage.abort.gain_reserve, 1.0);
    if (before != nullptr) {
      const auto& gains = stage.controller.controller.structure.gains();
      for (std::size_t i = 0; i < gains.size(); ++i) {
        const double last = gain_of(*before, gains[i].symbol);
        if (std::isnan(last)) continue;  // its path has just come in
        const double change = std::log(stage.controller.controller.gains[i] / last);
        EXPECT_LE(std::abs(change), std::log(plan.largest_step) * 1.0001) << gains[i].symbol;
        if (std::abs(change) < 1e-12) continue;
        double& way = direction[gains[i].symbol];
        EXPECT_GE(way * change, 0.0) << gains[i].symbol << " reverses";
        way = change;
      }
    }
    before = &stage.controller.controller;
  }
}

TEST(Commissioning, GoesFromGainsFoundToTheTunedOnesInOrder) {
  const auto problem = problem_of_test();
  const auto members = few_members(problem);
  const auto target = compliance_law();
  const Controller found{LoopStructure::named("PI-0"), {0.1, 1.5, 0.06, 0.01}};
  const auto plan = plan_commissioning(problem, members, found, target, move);
  EXPECT_FALSE(plan.detuning.has_value());
  EXPECT_THAT(plan.remarks, testing::IsEmpty());
  ASSERT_EQ(plan.stages[0].kind, StageKind::as_found);
  EXPECT_EQ(plan.stages[0].controller.controller.gains, found.gains);
  EXPECT_EQ(plan.stages[1].kind, StageKind::rate_loop);
  EXPECT_EQ(gain_of(plan.stages[1].controller.controller, "kr"), 0.1);
  expect_orderly(plan, target, 2.5);
  // The first position stage closes the loop at the gains found.
  for (const auto& stage : plan.stages) {
    if (stage.kind != StageKind::position_loop) continue;
    EXPECT_EQ(gain_of(stage.controller.controller, "kp"), 0.06);
    EXPECT_EQ(stage.step, 1);
    break;
  }
  // What it is done for.
  EXPECT_LT(plan.stages.back().expected.boresight_rms.largest,
            plan.stages.front().expected.boresight_rms.minimum);
}

TEST(Commissioning, StartsFromDetunedGainsWhereNoneAreKnown) {
  const auto problem = problem_of_test();
  const auto members = few_members(problem);
  const auto target = pressure_controller();
  const auto plan = plan_commissioning(problem, members, std::nullopt, target, move);
  ASSERT_TRUE(plan.detuning.has_value());
  EXPECT_EQ(plan.stages[0].kind, StageKind::rate_loop);
  EXPECT_DOUBLE_EQ(gain_of(plan.stages[0].controller.controller, "kr"),
                   gain_of(target, "kr") / *plan.detuning);
  expect_orderly(plan, target, 2.5);
  // The same for three threads, and with smaller steps there are more stages.
  const auto threads =
      plan_commissioning(problem, members, std::nullopt, target, move, {.threads = 3});
  ASSERT_EQ(threads.stages.size(), plan.stages.size());
  for (std::size_t i = 0; i < plan.stages.size(); ++i) {
    EXPECT_EQ(threads.stages[i].expected.rise_time.upper, plan.stages[i].expected.rise_time.upper);
    EXPECT_EQ(threads.stages[i].abort.overshoot, plan.stages[i].abort.overshoot);
  }
}

TEST(Commissioning, SaysWhyItStartsAfresh) {
  const auto problem = problem_of_test();
  const auto members = few_members(problem);
  const Controller other{LoopStructure::named("LL"), {0.1, 1.5, 50.0, 300.0, 0.06, 0.01}};
  const auto plan = plan_commissioning(problem, members, other, pressure_controller(), move);
  ASSERT_EQ(plan.remarks.size(), 1u);
  EXPECT_THAT(plan.remarks[0], HasSubstr("parts that the controller chosen has not"));
  EXPECT_TRUE(plan.detuning.has_value());
  const Controller hot{LoopStructure::named("PI-0"), {0.9, 2.0, 0.06, 0.01}};
  const auto from_hot = plan_commissioning(problem, members, hot, pressure_controller(), move);
  ASSERT_EQ(from_hot.remarks.size(), 1u);
  EXPECT_THAT(from_hot.remarks[0], HasSubstr("as found has an Ms above 2.5"));
  EXPECT_FALSE(from_hot.stages[0].expected.all_stable());
  // The plan's peaks are those of its own stages.
  double largest = 0.0;
  for (std::size_t i = 1; i < from_hot.stages.size(); ++i) {
    EXPECT_TRUE(from_hot.stages[i].expected.all_stable());
    largest = std::max(largest, from_hot.stages[i].expected.peak.largest);
  }
  EXPECT_EQ(from_hot.largest_peak(), largest);
}

template <typename Failure>
std::string message_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const Failure& failure) {
    return failure.what();
  }
  return "nothing was thrown";
}

std::vector<double> output_factors(const std::function<bool(const StageController&)>& allowed,
                                   std::string& why_not) {
  std::vector<double> factors;
  const auto path = output_path(reference::lag_loops_as_state_space(), 2.0, allowed, why_not);
  if (!path) return factors;
  for (const auto& stage : *path) factors.push_back(stage.controller.output_factor);
  return factors;
}

TEST(OutputPath, RisesToTheWholeOutputFromTheLeastFactorAllowed) {
  std::string why_not;
  const auto at_least = [](double least) {
    return [least](const StageController& stage) { return stage.output_factor >= least; };
  };
  EXPECT_THAT(output_factors(at_least(0.0), why_not), testing::ElementsAre(0.25, 0.5, 1.0));
  EXPECT_THAT(output_factors(at_least(0.3), why_not), testing::ElementsAre(0.5, 1.0));
  EXPECT_EQ(why_not, "");
  EXPECT_THAT(output_factors(at_least(0.6), why_not), testing::IsEmpty());
  EXPECT_THAT(why_not, HasSubstr("0.5 of the output is not allowed"));

  const auto path = output_path(reference::lag_loops_as_state_space(), 2.0, at_least(0.0), why_not);
  ASSERT_TRUE(path);
  EXPECT_EQ(path->front().kind, StageKind::output);
  EXPECT_EQ(path->front().controller.controller.structure.state_space()->d(0, 0),
            0.25 * reference::lag_loops_as_state_space().structure.state_space()->d(0, 0));
  EXPECT_EQ(path->back().kind, StageKind::output);
  for (const auto& stage : *path) EXPECT_TRUE(stage.controller.feedforward);
  EXPECT_TRUE(path->back().controller.controller.structure ==
              reference::lag_loops_as_state_space().structure);
}

TEST(Commissioning, BringsAStateSpaceInByItsOutput) {
  const auto problem = problem_of_test();
  const auto members = few_members(problem);
  const auto plan = plan_commissioning(problem, members, pressure_controller(),
                                       reference::lag_loops_as_state_space(), move);
  ASSERT_EQ(plan.stages.size(), 4U);
  EXPECT_EQ(plan.stages[0].kind, StageKind::as_found);
  for (std::size_t i = 1; i < 4; ++i) {
    EXPECT_EQ(plan.stages[i].kind, StageKind::output);
    EXPECT_EQ(plan.stages[i].steps, 3);
    EXPECT_FALSE(plan.stages[i].controller.position_open);
    EXPECT_TRUE(plan.stages[i].expected.all_stable());
    EXPECT_LE(plan.stages[i].expected.peak.largest, 2.5);
  }
  EXPECT_FALSE(plan.detuning);
  ASSERT_FALSE(plan.remarks.empty());
  EXPECT_THAT(plan.remarks.back(), HasSubstr("with 0.25 of its output"));
  // At the end it does what the loops do.
  StageObserver observer(problem, problem.plant, WindTable(problem), move);
  const auto loops = observer.observe({reference::lag_loops()});
  const auto& last = plan.stages[3].expected;
  EXPECT_NEAR(last.boresight_rms.nominal / loops.boresight_rms, 1.0, 1e-3);
  // The recorder shows the samples of the command, of which the evaluator's effort is.
  auto evaluator = make_evaluator(problem);
  const double effort =
      std::sqrt(evaluator.evaluate(reference::lag_loops_as_state_space(), false).effort_variance);
  EXPECT_NEAR(last.calm_valve.nominal / effort, 1.0, 2e-3);
  EXPECT_NEAR(last.overshoot.nominal, loops.overshoot, 5e-3);
  const auto moved = observer.observe({reference::lag_loops(), false, true});
  EXPECT_NEAR(last.move_error.nominal, moved.move_error, 0.05 * moved.move_error);
  // The reserve is that of the whole output.
  const double reserve = plan.stages[3].abort.gain_reserve;
  ASSERT_TRUE(std::isfinite(reserve));
  EXPECT_GT(reserve, 1.0);
}

TEST(Commissioning, SaysWhatIsWrong) {
  const auto problem = problem_of_test();
  const auto members = few_members(problem);
  const auto refusal = [&](const CommissioningOptions& options) {
    return message_of<InvalidInput>([&] {
      plan_commissioning(problem, members, std::nullopt, pressure_controller(), move, options);
    });
  };
  EXPECT_THAT(refusal({.largest_step = 1.0}), HasSubstr("a largest step above 1, at most 10"));
  EXPECT_THAT(refusal({.abort_peak = 2.0}), HasSubstr("found 2, 2.5 and 2, 0.05 and 1.2"));
  EXPECT_THAT(refusal({.rms_allowance = 0.5}), HasSubstr("1 for rms"));
  EXPECT_THAT(refusal({.confidence = 99.0}), HasSubstr("confidence within (0, 1), found 99"));
  EXPECT_THAT(message_of<InvalidInput>([&] {
                plan_commissioning(problem, {}, std::nullopt, pressure_controller(), move);
              }),
              HasSubstr("at least 3 ensemble members, found 0"));
  Controller wild = pressure_controller();
  wild.gains[0] *= 50.0;
  EXPECT_THAT(message_of<InfeasibleRequirement>(
                  [&] { plan_commissioning(problem, members, std::nullopt, wild, move); }),
              StartsWith("the controller chosen is unstable on an ensemble member"));
  EXPECT_THROW(plan_commissioning(problem, members, std::nullopt, pressure_controller(), move,
                                  {.stop = [] { return true; }}),
               Interrupted);
}

}  // namespace
}  // namespace boresight::design
