#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/reference_problem.hpp"
#include <boresight/design/ensembles/plant_ensemble.hpp>
#include <boresight/design/tuning/design_study.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::design {
namespace {

TrackingProblem coarse_problem() {
  TrackingProblem problem = reference::tracking_problem();
  problem.points_per_decade = 60;
  return problem;
}

EnsembleMember member(const TrackingProblem& problem, const std::string& name, double stiffness,
                      double leakage) {
  EnsembleMember one{name, problem.plant};
  one.plant.drive.oil_stiffness *= stiffness;
  one.plant.drive.leakage_rate *= leakage;
  return one;
}

TEST(PlantEnsemble, EvaluatesTheNominalPlantAsAnEvaluationDoes) {
  const TrackingProblem problem = coarse_problem();
  const auto controller = reference::cautious_gains();
  const auto result = evaluate(problem, {{"nominal", problem.plant}}, controller, {}, 1);
  auto evaluator = make_adaptive_evaluator(problem, WindTable(problem));
  const auto evaluation = evaluator.evaluate(controller, false);
  ASSERT_EQ(result.members.size(), 1u);
  EXPECT_TRUE(result.members[0].stable);
  EXPECT_EQ(result.members[0].boresight_rms,
            std::sqrt(evaluation.boresight_variance()) / problem.gear_ratio);
  EXPECT_EQ(result.members[0].worst_constraint, worst_constraint(evaluation, {}));
  EXPECT_EQ(result.min_rms, result.largest_rms);
  EXPECT_EQ(result.median_rms, result.high_rms);
}

TEST(PlantEnsemble, FindsTheMemberThatAControllerFailsOnAndCountsTheRest) {
  const TrackingProblem problem = coarse_problem();
  const auto controller = reference::cautious_gains();
  Constraints goals;
  // What the nominal plant just meets, a softer and less damped oil spring does not.
  const auto nominal =
      evaluate(problem, {{"nominal", problem.plant}}, controller, goals, 1).members[0];
  for (std::size_t b = 0; b < 3; ++b) {
    goals.sensitivity_peak[b] = 1.0001 * nominal.sensitivity_peaks[b];
  }
  const std::vector<EnsembleMember> members{member(problem, "nominal", 1.0, 1.0),
                                            member(problem, "soft", 0.5, 0.2),
                                            member(problem, "stiff", 1.2, 1.0)};
  const auto one = evaluate(problem, members, controller, goals, 1);
  const auto two = evaluate(problem, members, controller, goals, 2);
  EXPECT_EQ(one.members[one.worst].name, "soft");
  EXPECT_GT(one.members[1].worst_constraint, 1.0);
  EXPECT_LE(one.members[0].worst_constraint, 1.0);
  EXPECT_EQ(one.stable, 3);
  EXPECT_LT(one.within_constraints, 3);
  for (std::size_t i = 0; i < members.size(); ++i) {
    EXPECT_EQ(one.members[i].boresight_rms, two.members[i].boresight_rms);
    EXPECT_LE(one.min_rms, one.members[i].boresight_rms);
    EXPECT_GE(one.largest_rms, one.members[i].boresight_rms);
  }
}

TEST(PlantEnsemble, SaysOfAnUnstableMemberNothingButThatItIs) {
  const TrackingProblem problem = coarse_problem();
  const control::Controller wild{control::LoopStructure::pi(), {20.0, 1.0, 0.05, 1e-3}};
  const auto result = evaluate(problem, {{"nominal", problem.plant}}, wild, {}, 1);
  EXPECT_FALSE(result.members[0].stable);
  EXPECT_TRUE(std::isnan(result.members[0].boresight_rms));
  EXPECT_TRUE(std::isinf(result.members[0].worst_constraint));
  EXPECT_EQ(result.stable, 0);
  EXPECT_EQ(result.within_constraints, 0);
  EXPECT_TRUE(std::isnan(result.median_rms));
}

TEST(PlantEnsemble, RefusesAnEmptyEnsembleAndAWrongController) {
  const TrackingProblem problem = coarse_problem();
  EXPECT_THROW(evaluate(problem, {}, reference::cautious_gains(), {}, 1), InvalidInput);
  EXPECT_THROW(
      evaluate(problem, {{"nominal", problem.plant}}, {control::LoopStructure::pi(), {1.0}}, {}, 1),
      InvalidInput);
}

}  // namespace
}  // namespace boresight::design
