#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/studies/fixed_controller.hpp"
#include "refused_call.hpp"
#include <boresight/design/studies/proposal_study.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::design {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

ProposedAntenna proposed(const std::string& name, const std::vector<plant::AntennaChange>& changes,
                         double cost) {
  ProposedAntenna one;
  one.name = name;
  one.mission = reference::uncertain_mission();
  one.mission.uncertainty.random_samples = 2;
  one.mission.antenna = plant::changed(one.mission.antenna, changes);
  one.structures.loops = {one.mission.structures.loops.front()};
  one.cost = cost;
  one.changed = !changes.empty();
  return one;
}

PlantUncertainty uncertainty() {
  return {PlantDistribution::of_ranges(reference::uncertain_mission()), false};
}

ProposalOptions quick() {
  ProposalOptions options;
  options.random_samples = 100;
  options.starts = 1;
  options.time_domain = false;
  return options;
}

// Motors without flywheels reflect less inertia; a proposal that changes nothing is the antenna as
// it is, to the digit.
TEST(StudyProposals, RanksWhatEachMakesOfTheAntenna) {
  const std::vector<ProposedAntenna> antennas{
      proposed("as it is", {}, 0.0), proposed("the same", {}, 1.0),
      proposed("no flywheels", {plant::set_to("motor.flywheel_disks", 0.0)}, 2.0)};
  const ProposalStudy study = study_proposals(antennas, uncertainty(), quick());
  ASSERT_EQ(study.candidates.size(), 3U);
  EXPECT_TRUE(study.not_run.empty());
  EXPECT_EQ(study.candidates[1].controllers[0].design.boresight_rms,
            study.candidates[0].controllers[0].design.boresight_rms);
  EXPECT_LT(study.candidates[2].motor_to_load_ratio, study.candidates[0].motor_to_load_ratio);
  EXPECT_GT(study.candidates[2].oil_mode.frequency, study.candidates[0].oil_mode.frequency);
  ASSERT_TRUE(study.decision);
  EXPECT_EQ(study.decision->candidates.size(), 3U);
  // What changes nothing is not worth a cost.
  EXPECT_NE(study.decision->worth, 1U);
  for (const std::size_t place : study.front) EXPECT_NE(place, 1U);
}

TEST(StudyProposals, NamesWhatAnInterruptLeftOut) {
  ProposalOptions options = quick();
  options.interrupted = [] { return true; };
  const ProposalStudy study =
      study_proposals({proposed("as it is", {}, 0.0)}, uncertainty(), options);
  EXPECT_TRUE(study.candidates.empty());
  EXPECT_EQ(study.not_run, std::vector<std::size_t>{0});
  EXPECT_FALSE(study.decision);
}

TEST(StudyProposals, RefusesWhatCannotBeCompared) {
  ProposalOptions options = quick();
  EXPECT_THAT(reference::Call([&] { study_proposals({}, uncertainty(), options); }),
              ThrowsMessage<InvalidInput>(HasSubstr("expected an antenna")));
  options.random_samples = 99;
  EXPECT_THAT(reference::Call([&] {
                study_proposals({proposed("as it is", {}, 0.0)}, uncertainty(), options);
              }),
              ThrowsMessage<InvalidInput>(HasSubstr("expected 100 samples or more, found 99")));
}

}  // namespace
}  // namespace boresight::design
