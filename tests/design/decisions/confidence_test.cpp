#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boresight/design/decisions/confidence.hpp>

namespace boresight::design {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

Evidence sound() {
  Evidence evidence;
  evidence.verified = evidence.robust = evidence.simulated = evidence.plant_identified = true;
  return evidence;
}

TEST(Confidence, IsHighWithoutDoubts) {
  EXPECT_EQ(grade(sound()).grade, Confidence::high);
  EXPECT_THAT(grade(sound()).doubts, IsEmpty());
}

TEST(Confidence, IsModerateWhereFiguresMayBeOff) {
  Evidence evidence = sound();
  evidence.plant_identified = false;
  EXPECT_EQ(grade(evidence).grade, Confidence::moderate);
  evidence = sound();
  evidence.largest_effect = telling_effect;
  EXPECT_EQ(grade(evidence).grade, Confidence::high);
  evidence.largest_effect = 0.21;
  EXPECT_EQ(grade(evidence).grade, Confidence::moderate);
  // Unstable within the number's uncertainty, or not known.
  for (const double effect : {HUGE_VAL, std::nan("")}) {
    evidence.largest_effect = effect;
    EXPECT_THAT(grade(evidence).doubts, ElementsAre(Doubt::input_decides));
  }
}

TEST(Confidence, IsLowWhereTheVerdictMayBeWrong) {
  const auto is_low = [](auto spoil, Doubt reason) {
    Evidence evidence = sound();
    spoil(evidence);
    EXPECT_EQ(grade(evidence).grade, Confidence::low);
    EXPECT_THAT(grade(evidence).doubts, ElementsAre(reason));
  };
  is_low([](Evidence& e) { e.verified = false; }, Doubt::not_verified);
  is_low([](Evidence& e) { e.robust = false; }, Doubt::not_robust);
  is_low([](Evidence& e) { e.simulated = false; }, Doubt::not_simulated);
  is_low([](Evidence& e) { e.within_budget = false; }, Doubt::limit_cycle);
  is_low([](Evidence& e) { e.inertias_agree = false; }, Doubt::inertias_disagree);
  is_low([](Evidence& e) { e.resonance_agrees = false; }, Doubt::resonance_disagrees);
  is_low([](Evidence& e) { e.verdict_depends_on_interpretation = true; },
         Doubt::interpretation_decides);
}

TEST(Confidence, ListsEveryDoubt) {
  EXPECT_THAT(grade(Evidence{}).doubts,
              ElementsAre(Doubt::not_verified, Doubt::not_robust, Doubt::not_simulated,
                          Doubt::plant_not_identified));
}

}  // namespace
}  // namespace boresight::design
