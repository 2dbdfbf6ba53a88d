#include <numbers>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boresight/design/studies/gains_at_bounds.hpp>

namespace boresight::design {
namespace {

using control::BlockKind;
using testing::ElementsAre;

// Gains at their upper bounds, which for corners of lags and leads are 300 rad/s.
TuningResult searched(const std::string& structure, const std::vector<std::string>& at_bound) {
  TuningResult tuning;
  tuning.status = TuningStatus::optimal;
  tuning.controller.structure = control::LoopStructure::named(structure);
  for (const auto& gain : tuning.controller.structure.gains())
    tuning.controller.gains.push_back(gain.upper);
  tuning.gains_at_bound = at_bound;
  return tuning;
}

TEST(ReachedBounds, NameABoundOnceWithItsControllers) {
  const auto pi = searched("PI+C", {"compliance"}), feedback = searched("DPF+C", {"compliance"});
  auto lower = searched("PI+C", {"compliance"});
  const auto& gains = lower.controller.structure.gains();
  const auto compliance = std::ranges::find(gains, "compliance", &control::GainDescription::name);
  lower.controller.gains.at(static_cast<std::size_t>(compliance - gains.begin())) =
      compliance->lower;
  auto unstable = pi;
  unstable.status = TuningStatus::unstable;
  const auto bounds =
      reached_bounds({{"one", &pi}, {"two", &feedback}, {"three", &lower}, {"four", &unstable}});
  ASSERT_EQ(bounds.size(), 2U);
  EXPECT_THAT(bounds[0].controllers, ElementsAre("one", "two"));
  EXPECT_TRUE(bounds[0].upper);
  EXPECT_EQ(bounds[0].value(), bounds[0].gain.upper);
  EXPECT_THAT(bounds[1].controllers, ElementsAre("three"));
  EXPECT_EQ(bounds[1].value(), bounds[1].gain.lower);
  EXPECT_FALSE(bounds[0].idle || bounds[1].idle);
  // Controllers of another sample time have bounds of their own.
  EXPECT_EQ(reached_bounds({{"one", &pi, 0.02}, {"two", &feedback, 0.01}}).size(), 2U);
}

// A sampled controller acts up to half its sampling rate.
TEST(ReachedBounds, KnowTheLagThatNoSampledControllerNeeds) {
  EXPECT_DOUBLE_EQ(highest_frequency(0.02), 50.0 * std::numbers::pi);
  const auto pi = searched("PI", {"rate lag corner"});
  const auto feedback = searched("DPF+C", {"rate lag corner"});
  const auto bounds = reached_bounds({{"PI", &pi, 0.02}, {"DPF+C", &feedback, 0.02}});
  ASSERT_EQ(bounds.size(), 1U);
  EXPECT_EQ(bounds[0].idle, BlockKind::lag);
  ASSERT_EQ(bounds[0].simpler.size(), 2U);
  EXPECT_EQ(bounds[0].simpler[0].name, "PI-0");
  EXPECT_THAT(bounds[0].simpler[0].in_place_of, ElementsAre("PI"));
  // Pressure feedback and compliance without a lag are no usual structure.
  EXPECT_EQ(bounds[0].simpler[1].name, "");
  EXPECT_THAT(bounds[0].simpler[1].in_place_of, ElementsAre("DPF+C"));
  EXPECT_TRUE(ends_beyond_sampling(pi, 0.02));
  // At 5 ms it acts up to 628 rad/s; without a sample time nothing is known.
  EXPECT_FALSE(ends_beyond_sampling(pi, 0.005));
  EXPECT_FALSE(ends_beyond_sampling(pi, 0.0));
}

TEST(ReachedBounds, LetALeadGoButNotTheLagBeforeIt) {
  const auto both = searched("FULL", {"rate lag corner", "rate lead corner"});
  const auto bounds = reached_bounds({{"FULL", &both, 0.02}});
  ASSERT_EQ(bounds.size(), 2U);
  for (const auto& bound : bounds) {
    if (bound.idle == BlockKind::lead) {
      ASSERT_EQ(bound.simpler.size(), 1U);
      EXPECT_EQ(bound.simpler[0].name, "DPF");
    } else {
      EXPECT_EQ(bound.idle, BlockKind::lag);
      EXPECT_TRUE(bound.simpler.empty());
    }
  }
}

// At its lower bound a lag does much; an integral at its upper one acts below it.
TEST(ReachedBounds, HaveNoIdleBlockWhereItActsBelow) {
  auto slow = searched("PI", {"rate lag corner", "rate integral corner"});
  slow.controller.gains[2] = slow.controller.structure.gains()[2].lower;
  EXPECT_FALSE(ends_beyond_sampling(slow, 0.2));
}

}  // namespace
}  // namespace boresight::design
