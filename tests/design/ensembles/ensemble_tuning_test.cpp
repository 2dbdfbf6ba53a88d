#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <numbers>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/reference_problem.hpp"
#include "refused_call.hpp"
#include <boresight/control/loops/loop_constraints.hpp>
#include <boresight/design/ensembles/plant_ensemble.hpp>
#include <boresight/design/tuning/design_study.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/antenna/plant_response.hpp>

namespace boresight::design {
namespace {

using control::LoopStructure;
using reference::relative_error;
using testing::HasSubstr;
using testing::ThrowsMessage;

TuningOptions quick(std::uint64_t seed = 1) {
  TuningOptions options;
  options.starts = 6;
  options.seed = seed;
  return options;
}

TuningOptions robust(ObjectiveKind kind, double quantile = 0.95) {
  TuningOptions options = quick();
  options.starts = 3;
  options.members = reference_ensemble(reference::tracking_problem(), 1);
  options.objective = {kind, quantile};
  return options;
}

TEST(ReferenceEnsemble, HoldsThirtyPlantsWithinTheirRanges) {
  const TrackingProblem problem = reference::tracking_problem();
  const auto members = reference_ensemble(problem, 1);
  ASSERT_EQ(members.size(), 30u);
  std::set<std::string> names;
  for (const auto& [name, plant] : members) {
    names.insert(name);
    const double stiffness = plant.drive.oil_stiffness / problem.plant.drive.oil_stiffness;
    EXPECT_GE(stiffness, 0.8 - 1e-12);
    EXPECT_LE(stiffness, 1.33 + 1e-12);
    EXPECT_GE(plant.drive.leakage_rate, 0.366 - 1e-12);
    EXPECT_LE(plant.drive.leakage_rate, 1.219 + 1e-12);
    EXPECT_GE(plant.drive.viscous_friction, 0.0);
    EXPECT_LE(plant.drive.viscous_friction, 12.0);
  }
  EXPECT_EQ(names.size(), 30u);
  EXPECT_NEAR(members[5].plant.drive.leakage_rate, 0.366, 1e-12);
  // One sample in each of 24 equal parts of a range.
  std::set<int> parts;
  for (std::size_t i = 6; i < members.size(); ++i) {
    parts.insert(static_cast<int>(members[i].plant.drive.viscous_friction / 12.0 * 24.0));
  }
  EXPECT_EQ(parts.size(), 24u);
  EXPECT_EQ(reference_ensemble(problem, 1)[9].name, members[9].name);
  EXPECT_NE(reference_ensemble(problem, 2)[9].name, members[9].name);
  TrackingProblem tight = problem;
  tight.plant.drive.leakage_rate = 0.0;
  EXPECT_THAT(reference::Call([&] { reference_ensemble(tight, 1); }),
              ThrowsMessage<InvalidInput>(HasSubstr("leakage rate above 0, found 0")));
}

TEST(ReferenceEnsemble, ScalesEveryFrequencyOfTheStructureAndNoDampingRatio) {
  // The structure with 5 % higher frequencies is the structure specified so.
  const auto members = reference_ensemble(reference::tracking_problem(), 1);
  plant::StructureSpecification specification = reference::structure();
  specification.locked_rotor_frequency *= 1.05;
  for (auto& mode : specification.modes) mode.frequency *= 1.05;
  const plant::Structure expected = plant::make_structure(specification);
  const plant::Structure& found = members[2].plant.structure;
  EXPECT_LT(relative_error(found.gear_stiffness, expected.gear_stiffness), 1e-12);
  EXPECT_LT(relative_error(found.gear_damping, expected.gear_damping), 1e-12);
  for (std::size_t i = 0; i < found.modes.size(); ++i) {
    EXPECT_LT(relative_error(found.modes[i].stiffness, expected.modes[i].stiffness), 1e-12);
    EXPECT_LT(relative_error(found.modes[i].damping, expected.modes[i].damping), 1e-12);
  }
}

TEST(RobustTuning, MendsTheNominalDesignThatFailsWhereLeakageIsLow) {
  const TrackingProblem problem = reference::tracking_problem();
  const auto members = reference_ensemble(problem, 1);
  TuningOptions options;
  const TuningResult nominal = tune(problem, LoopStructure::pi_with_lag(), {}, options);
  const EnsembleResult fails = evaluate(problem, members, nominal.controller, {}, 1);
  EXPECT_EQ(members[fails.worst].name, "low leakage");
  EXPECT_GT(fails.members[fails.worst].worst_constraint, 2.0);
  EXPECT_LT(fails.within_constraints, 10);

  const TuningResult held =
      tune(problem, LoopStructure::pi_with_lag(), {}, robust(ObjectiveKind::nominal));
  EXPECT_EQ(held.status, TuningStatus::optimal);
  const EnsembleResult holds = evaluate(problem, members, held.controller, {}, 1);
  EXPECT_EQ(holds.within_constraints, 30);
  EXPECT_EQ(holds.stable, 30);
  // At a price, of a quarter more rms on the nominal plant.
  const double shadow_price =
      std::sqrt(held.evaluation.boresight_variance() / nominal.evaluation.boresight_variance());
  EXPECT_NEAR(shadow_price, 1.26, 0.02);
  // And by the certified peaks on the members that limit it.
  EXPECT_FALSE(held.active_scenarios.empty());
  EXPECT_LT(held.active_scenarios.size(), 12u);
  ASSERT_FALSE(held.limits.empty());
  EXPECT_FALSE(held.limits.front().member.empty());
  for (const auto& member : members) {
    if (std::ranges::find(held.active_scenarios, member.name) == held.active_scenarios.end()) {
      continue;
    }
    TrackingProblem one = problem;
    one.plant = member.plant;
    EXPECT_TRUE(verify(one, held.controller, {}).passed) << member.name;
  }
}

TEST(RobustTuning, MakesEachSoftGoalLeastOfAll) {
  const TrackingProblem problem = reference::tracking_problem();
  auto members = reference_ensemble(problem, 1);
  members.resize(12);
  struct Found {
    double nominal, expected, largest, high;
  };
  std::vector<Found> all;
  for (const auto kind : {ObjectiveKind::nominal, ObjectiveKind::expected,
                          ObjectiveKind::worst_case, ObjectiveKind::quantile}) {
    TuningOptions options = robust(kind, 0.9);
    options.members = members;
    const TuningResult result = tune(problem, LoopStructure::pressure_feedback(), {}, options);
    ASSERT_EQ(result.status, TuningStatus::optimal);
    const EnsembleResult evaluated = evaluate(problem, members, result.controller, {}, 1);
    EXPECT_EQ(evaluated.within_constraints, 12);
    std::vector<double> rms;
    double sum = 0.0;
    for (const auto& member : evaluated.members) {
      rms.push_back(member.boresight_rms * problem.gear_ratio);
      sum += std::pow(rms.back(), 2);
    }
    std::ranges::sort(rms);
    all.push_back({std::sqrt(result.evaluation.boresight_variance()), std::sqrt(sum / 12.0),
                   rms[11], rms[10]});
    const std::array values{all.back().nominal, all.back().expected, all.back().largest,
                            all.back().high};
    EXPECT_LT(relative_error(result.soft_rms, values.at(static_cast<std::size_t>(kind))), 1e-5);
    EXPECT_LT(result.gradient_residual, 1e-2);
  }
  constexpr double rounding = 1.0 + 1e-5;
  for (const Found& one : all) {
    EXPECT_LE(all[0].nominal, one.nominal * rounding);
    EXPECT_LE(all[1].expected, one.expected * rounding);
    EXPECT_LE(all[2].largest, one.largest * rounding);
    EXPECT_LE(all[3].high, one.high * rounding);
  }
}

TEST(RobustTuning, GivesTheSameBytesOnEveryNumberOfThreads) {
  TuningOptions options = robust(ObjectiveKind::worst_case);
  std::vector<TuningResult> results;
  for (const unsigned threads : {1u, 2u, 3u}) {
    options.threads = threads;
    results.push_back(tune(reference::tracking_problem(), LoopStructure::pi(), {}, options));
  }
  for (const auto& result : results) {
    EXPECT_EQ(result.controller.gains, results[0].controller.gains);
    EXPECT_EQ(result.evaluations, results[0].evaluations);
    EXPECT_EQ(result.soft_rms, results[0].soft_rms);
    EXPECT_EQ(result.starts_at_optimum, results[0].starts_at_optimum);
  }
}

TEST(Tune, SaysWhatRelaxingAGoalBuys) {
  const TrackingProblem problem = reference::tracking_problem();
  for (const auto& structure : {LoopStructure::pi_with_lag(), LoopStructure::pressure_feedback()}) {
    const TuningResult result = tune(problem, structure, {}, {});
    EXPECT_LT(result.gradient_residual, 1e-3);
    ASSERT_FALSE(result.limits.empty());
    EXPECT_THAT(result.limits.front().description(), HasSubstr("sensitivity peak at "));
    EXPECT_THAT(result.limits.front().description(),
                HasSubstr(" Hz: relaxing it by 1 % lowers the rms by 0."));
    // DPF's lag would go on beyond its bound of 300 rad/s.
    EXPECT_EQ(result.limiting_bounds.empty(), structure == LoopStructure::pi_with_lag());
    for (const LimitingBound& bound : result.limiting_bounds) {
      EXPECT_EQ(bound.gain, "rate lag corner");
      EXPECT_TRUE(bound.upper);
      EXPECT_EQ(bound.gain, result.gains_at_bound.front());
    }
    for (std::size_t b = 0; b < control::loop_breaks.size(); ++b) {
      double shadow_price = 0.0;
      for (const ActiveConstraint& limit : result.limits) {
        if (limit.goal.loop_break == control::loop_breaks[b]) shadow_price += limit.shadow_price;
      }
      Constraints relaxed;
      relaxed.sensitivity_peak[b] *= 1.01;
      TuningOptions again;
      again.starts = 0;
      again.warm_starts = {result.controller.gains};
      const TuningResult then = tune(problem, structure, relaxed, again);
      const double gained =
          0.5 *
          std::log(result.evaluation.boresight_variance() / then.evaluation.boresight_variance()) /
          std::log(1.01);
      // A price is a derivative: the step has a curvature of its own.
      EXPECT_NEAR(gained, shadow_price, 0.1 * shadow_price + 2e-3)
          << to_string(structure) << " " << to_string(control::loop_breaks[b]);
    }
  }
}

TEST(Tune, NamesTheGoalsThatContradictOneAnother) {
  const TrackingProblem problem = reference::tracking_problem();
  Constraints goals;
  goals.bandwidth = 20.0;  // rad/s, above the antenna's modes
  const TuningResult result = tune(problem, LoopStructure::pi_with_lag(), goals, quick());
  EXPECT_EQ(result.status, TuningStatus::infeasible);
  EXPECT_GT(result.worst_constraint, 1.0);
  std::set<GoalKind> kinds;
  double shadow_prices = 0.0;
  for (const auto& limit : result.limits) {
    kinds.insert(limit.goal.kind);
    shadow_prices += limit.shadow_price;
    EXPECT_NEAR(limit.goal.ratio, result.worst_constraint, 1e-3);
  }
  EXPECT_TRUE(kinds.contains(GoalKind::bandwidth));
  EXPECT_TRUE(kinds.contains(GoalKind::sensitivity_peak));
  EXPECT_NEAR(shadow_prices, 1.0, 1e-3);
  // It is the closest: with every limit relaxed by its ratio there is a controller, with less there
  // is none from many starts.
  const auto relaxed = [&](double factor) {
    Constraints loose = goals;
    for (double& peak : loose.sensitivity_peak) peak *= factor;
    loose.control_effort *= factor;
    loose.bandwidth = 20.0 / factor;
    TuningOptions options = quick(7);
    options.warm_starts = {result.controller.gains};
    return tune(problem, LoopStructure::pi_with_lag(), loose, options).status;
  };
  EXPECT_EQ(relaxed(1.002 * result.worst_constraint), TuningStatus::optimal);
  EXPECT_EQ(relaxed(0.97 * result.worst_constraint), TuningStatus::infeasible);
}

TEST(Tune, SaysOfAPlantThatNoControllerStabilises) {
  // The rate loop cannot bear a gain of 20.
  std::vector<control::LoopBlock> blocks = LoopStructure::pi().blocks();
  blocks[0].gains[0].lower = 20.0;
  const LoopStructure stiff("stiff PI", blocks);
  const TuningResult result = tune(reference::tracking_problem(), stiff, {}, quick());
  EXPECT_EQ(result.status, TuningStatus::unstable);
  EXPECT_TRUE(std::isinf(result.worst_constraint));
}

TEST(Tune, HoldsMarginsBandwidthAndGusts) {
  const TrackingProblem problem = reference::tracking_problem();
  const auto& structure = LoopStructure::pressure_feedback();
  const TuningResult free = tune(problem, structure, {}, quick());
  const Eigen::ArrayXd grid = analysis_grid(problem);
  const auto channels = control::make_channels(problem.plant, grid);
  const auto phase = [&](const control::Controller& controller) {
    return control::smallest_phase_margins(channels, problem.delay, controller,
                                           control::LoopBreak::position_loop)
        .front()
        .value;
  };
  Constraints goals;
  goals.phase_margin[2] = 1.15 * phase(free.controller);
  const TuningResult held = tune(problem, structure, goals, quick());
  EXPECT_EQ(held.status, TuningStatus::optimal);
  EXPECT_GE(phase(held.controller), *goals.phase_margin[2] * (1.0 - 1e-6));
  EXPECT_GT(held.soft_rms, free.soft_rms);
  // By the verification's own crossovers too, which the free controller fails.
  EXPECT_TRUE(verify(problem, held.controller, goals).passed);
  EXPECT_THAT(verify(problem, free.controller, goals).failure,
              HasSubstr("phase margin at position loop"));
  Constraints others;
  others.gain_margin[1] = 3.0;
  EXPECT_THAT(verify(problem, free.controller, others).failure,
              HasSubstr("gain margin at valve command"));
  others = {};
  others.bandwidth = 50.0;
  EXPECT_THAT(verify(problem, free.controller, others).failure, HasSubstr("bandwidth: |S|"));
  others = {};
  others.gust_torque = 1.0;
  EXPECT_THAT(verify(problem, free.controller, others).failure,
              HasSubstr("motor torque in gusts: "));

  Constraints gusts;
  gusts.gust_demand = 1e3;
  gusts.gust_torque = 1e5;
  const TuningResult known = tune(problem, structure, gusts, quick());
  EXPECT_LT(relative_error(known.soft_rms, free.soft_rms), 1e-5) << "limits far away";
  const double mean = plant::mean_wind_torque(problem.wind.site, 10.0) / problem.gear_ratio;
  const auto peak_torque = [&](const TuningResult& result) {
    return mean + 3.5 * std::sqrt(result.evaluation.wind_torque_variance);
  };
  EXPECT_GT(known.evaluation.wind_torque_variance, 0.0);
  gusts.gust_torque = 0.99 * peak_torque(known);
  const TuningResult less = tune(problem, structure, gusts, quick());
  if (less.status == TuningStatus::optimal) {
    EXPECT_LE(peak_torque(less), *gusts.gust_torque * (1.0 + 1e-6));
  } else {
    EXPECT_GT(less.worst_constraint, 1.0);
  }
}

TEST(Tune, KeepsTheBestControllerWhenItIsStopped) {
  const TrackingProblem problem = reference::tracking_problem();
  for (const int calls : {1, 60, 200}) {
    std::atomic<int> asked{0};
    TuningOptions options = quick();
    options.stop = [&] { return ++asked > calls; };
    const TuningResult result = tune(problem, LoopStructure::pi(), {}, options);
    EXPECT_TRUE(result.interrupted);
    EXPECT_LT(result.evaluations, calls + 60) << "what judging the found controllers takes besides";
    if (result.status == TuningStatus::optimal) {
      EXPECT_LE(result.worst_constraint, 1.0 + 1e-9);
      EXPECT_TRUE(verify(problem, result.controller, {}).passed);
    }
    if (calls == 200) {
      EXPECT_EQ(result.status, TuningStatus::optimal);
    }
  }
}

TEST(Constraints, RefuseWhatNoLoopOrEveryLoopMeets) {
  const auto refuses = [](const std::function<void(Constraints&)>& change, const char* text) {
    Constraints goals;
    change(goals);
    EXPECT_THAT(reference::Call([&] {
                  tune(reference::tracking_problem(), LoopStructure::pi(), goals, quick());
                }),
                ThrowsMessage<InvalidInput>(HasSubstr(text)));
  };
  refuses([](Constraints& goals) { goals.sensitivity_peak[1] = 1.0; },
          "above 1 and finite, found 1");
  refuses([](Constraints& goals) { goals.control_effort = 0.0; }, "valve_effort above 0");
  refuses([](Constraints& goals) { goals.gain_margin[0] = 0.5; }, "gain margin above 1");
  refuses([](Constraints& goals) { goals.phase_margin[2] = 4.0; }, "between 0 and pi rad, found 4");
  refuses([](Constraints& goals) { goals.bandwidth = -1.0; }, "bandwidth above 0");
  refuses([](Constraints& goals) { goals.gust_torque = std::nan(""); }, "gust_torque above 0");
  refuses([](Constraints& goals) { goals.crest_factor = 0.0; }, "crest_factor above 0");
  TuningOptions options = quick();
  options.objective.quantile = 1.5;
  EXPECT_THAT(reference::Call(
                  [&] { tune(reference::tracking_problem(), LoopStructure::pi(), {}, options); }),
              ThrowsMessage<InvalidInput>(HasSubstr("quantile above 0 and at most 1, found 1.5")));
}

TEST(Climate, IsTheExpectationOverItsWinds) {
  TrackingProblem problem = reference::tracking_problem();
  const auto controller = reference::cautious_gains();
  double expected = 0.0;
  for (const auto& [speed, weight] : {std::pair{6.0, 0.5}, {10.0, 0.3}, {15.0, 0.2}}) {
    TrackingProblem one = reference::tracking_problem();
    one.wind.mean_speed = speed;
    expected += weight * make_evaluator(one).evaluate(controller, false).wind_variance;
    problem.climate.push_back({one.wind, weight});
  }
  EXPECT_LT(
      relative_error(make_evaluator(problem).evaluate(controller, false).wind_variance, expected),
      1e-12);
  EXPECT_LT(verify(problem, controller, {}).rms_disagreement, 5e-3);
  auto adaptive = make_adaptive_evaluator(problem, WindTable(problem));
  EXPECT_LT(relative_error(adaptive.evaluate(controller, false).wind_variance, expected), 1e-5);
  problem.climate[0].weight = 0.4;
  EXPECT_THAT(reference::Call([&] { WindTable table(problem); }),
              ThrowsMessage<InvalidInput>(HasSubstr("sum to 1, found 0.9")));
  problem.climate[0].weight = -0.4;
  EXPECT_THAT(reference::Call([&] { make_evaluator(problem); }),
              ThrowsMessage<InvalidInput>(HasSubstr("0 or more, found -0.4")));
}

TEST(WindTable, IsTheSpectrumBetweenItsPoints) {
  const TrackingProblem problem = reference::tracking_problem();
  const WindTable table(problem);
  for (double w = 6.3e-4; w < 600.0; w *= 1.0137) {
    const double exact = motor_wind_spectrum(problem, Eigen::ArrayXd::Constant(1, w))[0];
    EXPECT_LT(relative_error(table.spectrum(w), exact), 2e-7) << w;
  }
}

}  // namespace
}  // namespace boresight::design
