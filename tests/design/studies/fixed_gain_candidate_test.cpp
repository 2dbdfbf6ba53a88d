#include <cmath>

#include <gtest/gtest.h>

#include "design/studies/fixed_controller.hpp"
#include <boresight/design/studies/fixed_gain_candidate.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/plant/nonlinear/drive_capability.hpp>

namespace boresight::design {
namespace {

PlantSample draw_of(const Mission& mission) {
  return PlantDistribution::of_ranges(mission).draw(1, 5);
}

TEST(ProposedPlant, SamplesAreFactorsOnWhatTheProposalMakes) {
  const Mission mission = reference::uncertain_mission();
  const plant::Antenna& as_is = mission.antenna;
  const PlantSample draw = draw_of(mission);
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
  const PlantSample draw = draw_of(mission);
  plant::Antenna geared = as_is;
  geared.gear_train.stages.back().driven_teeth *= 2;
  ASSERT_GT(plant::tracking_friction(as_is), 0.0);
  EXPECT_NEAR(proposed_plant(as_is, geared, draw).drive.viscous_friction /
                  proposed_plant(as_is, as_is, draw).drive.viscous_friction,
              plant::tracking_friction(geared) / plant::tracking_friction(as_is), 1e-12);
}

// On the plant as it is, by the evaluator that the search uses.
TEST(FixedGainCandidate, EvaluatesAsTheTunersEvaluatorTimesTheFactor) {
  const Mission mission = reference::uncertain_mission();
  const CandidateController controller = reference::fixed_controller("PI", 1.25);
  FixedGainCandidate candidates(mission.antenna, mission, controller);
  PlantSample none;
  none.values.at(static_cast<std::size_t>(UncertainInput::leakage_rate)) = 1.0;
  none.values.at(static_cast<std::size_t>(UncertainInput::friction_slope)) =
      mission.antenna.drive.viscous_friction;
  const TrackingProblem problem = tracking_problem(mission);
  const auto evaluation =
      make_evaluator(problem).evaluate(controller.design.tuning.controller, false);
  ASSERT_TRUE(evaluation.stable());
  EXPECT_NEAR(candidates.evaluate(none).rms,
              1.25 * std::sqrt(evaluation.boresight_variance()) / problem.gear_ratio / millidegree,
              1e-6 * candidates.evaluate(none).rms);
}

TEST(EvaluateSamples, AreTheSameForAnyNumberOfThreads) {
  const Mission mission = reference::uncertain_mission();
  const std::vector<FixedGainCandidate> candidates{
      FixedGainCandidate(mission.antenna, mission, reference::fixed_controller("PI", 1.0)),
      FixedGainCandidate(mission.antenna, mission, reference::fixed_controller("PI", 2.0))};
  const auto distribution = PlantDistribution::of_ranges(mission);
  ProposalOptions options;
  options.random_samples = 150;
  const auto one = evaluate_samples(candidates, distribution, options);
  options.threads = 3;
  const auto three = evaluate_samples(candidates, distribution, options);
  ASSERT_TRUE(one && three);
  EXPECT_EQ(one->rms, three->rms);
  EXPECT_NEAR((one->rms.col(1) - 2.0 * one->rms.col(0)).norm(), 0.0, 1e-9 * one->rms.norm());
  options.interrupted = [] { return true; };
  EXPECT_FALSE(evaluate_samples(candidates, distribution, options));
}

}  // namespace
}  // namespace boresight::design
