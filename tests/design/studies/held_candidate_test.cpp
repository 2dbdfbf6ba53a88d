#include <cmath>

#include <gtest/gtest.h>

#include "design/studies/held_law.hpp"
#include <boresight/design/studies/held_candidate.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/plant/nonlinear/drive_capability.hpp>

namespace boresight::design {
namespace {

PlantDraw draw_of(const Mission& mission) {
  return PlantDistribution::of_ranges(mission).draw(1, 5);
}

TEST(ProposedPlant, DrawsAreFactorsOnWhatTheProposalMakes) {
  const Mission mission = reference::uncertain_mission();
  const plant::Antenna& as_is = mission.antenna;
  const PlantDraw draw = draw_of(mission);
  const auto before = proposed_plant(as_is, as_is, draw);
  const plant::Antenna stiff = plant::changed(as_is, {plant::scaled_by("oil.bulk_modulus", 2.0)});
  const auto after = proposed_plant(as_is, stiff, draw);
  EXPECT_NEAR(after.drive.oil_stiffness / before.drive.oil_stiffness, 2.0, 1e-12);
  EXPECT_DOUBLE_EQ(after.drive.viscous_friction, before.drive.viscous_friction);
}

// The friction slope is that of the same curve at another rate of the motor.
TEST(ProposedPlant, TakesTheFrictionSlopeAtTheProposalsTrackingRate) {
  const Mission mission = reference::uncertain_mission();
  const plant::Antenna& as_is = mission.antenna;
  const PlantDraw draw = draw_of(mission);
  plant::Antenna geared = as_is;
  geared.gear_train.stages.back().driven_teeth *= 2;
  ASSERT_GT(plant::tracking_friction(as_is), 0.0);
  EXPECT_NEAR(proposed_plant(as_is, geared, draw).drive.viscous_friction /
                  proposed_plant(as_is, as_is, draw).drive.viscous_friction,
              plant::tracking_friction(geared) / plant::tracking_friction(as_is), 1e-12);
}

// On the plant as it is, by the evaluator that the search uses.
TEST(HeldCandidate, JudgesAsTheTunersEvaluatorTimesTheFactor) {
  const Mission mission = reference::uncertain_mission();
  const CandidateLaw law = reference::held_law("PI", 1.25);
  HeldCandidate held(mission.antenna, mission, law);
  PlantDraw none;
  none.values.at(static_cast<std::size_t>(UncertainInput::leakage_rate)) = 1.0;
  none.values.at(static_cast<std::size_t>(UncertainInput::friction_slope)) =
      mission.antenna.drive.viscous_friction;
  const TrackingProblem problem = tracking_problem(mission);
  const auto evaluation = make_evaluator(problem).evaluate(law.design.tuning.law, false);
  ASSERT_TRUE(evaluation.stable());
  EXPECT_NEAR(held.judge(none).rms,
              1.25 * std::sqrt(evaluation.beam_variance()) / problem.gear_ratio / millidegree,
              1e-6 * held.judge(none).rms);
}

TEST(JudgeDraws, AreTheSameForAnyNumberOfThreads) {
  const Mission mission = reference::uncertain_mission();
  const std::vector<HeldCandidate> held{
      HeldCandidate(mission.antenna, mission, reference::held_law("PI", 1.0)),
      HeldCandidate(mission.antenna, mission, reference::held_law("PI", 2.0))};
  const auto distribution = PlantDistribution::of_ranges(mission);
  ProposalOptions options;
  options.draws = 150;
  const auto one = judge_draws(held, distribution, options);
  options.threads = 3;
  const auto three = judge_draws(held, distribution, options);
  ASSERT_TRUE(one && three);
  EXPECT_EQ(one->rms, three->rms);
  EXPECT_NEAR((one->rms.col(1) - 2.0 * one->rms.col(0)).norm(), 0.0, 1e-9 * one->rms.norm());
  options.interrupted = [] { return true; };
  EXPECT_FALSE(judge_draws(held, distribution, options));
}

}  // namespace
}  // namespace boresight::design
