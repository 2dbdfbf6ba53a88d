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
  evidence.fitness = Fitness::fit;
  evidence.simulated = true;
  evidence.plant = PlantBasis::records;
  return evidence;
}

TEST(Confidence, IsHighWithoutDoubts) {
  EXPECT_EQ(grade(sound()).grade, Confidence::high);
  EXPECT_THAT(grade(sound()).doubts, IsEmpty());
}

TEST(Confidence, IsModerateWhereFiguresMayBeOff) {
  Evidence evidence = sound();
  evidence.plant = PlantBasis::drawings;
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

// That it is missed is as sure as that it is met.
TEST(Confidence, IsNotLessOfAControllerThatMissesABudget) {
  Evidence evidence = sound();
  evidence.fitness = Fitness::misses_budget;
  EXPECT_EQ(grade(evidence).grade, Confidence::high);
}

TEST(Confidence, IsLowWhereTheVerdictMayBeWrong) {
  const auto is_low = [](auto spoil, Doubt reason) {
    Evidence evidence = sound();
    spoil(evidence);
    EXPECT_EQ(grade(evidence).grade, Confidence::low);
    EXPECT_THAT(grade(evidence).doubts, ElementsAre(reason));
  };
  for (const auto fitness : {Fitness::misses_nominal, Fitness::unverified, Fitness::unstable}) {
    is_low([&](Evidence& e) { e.fitness = fitness; }, Doubt::not_verified);
  }
  is_low([](Evidence& e) { e.fitness = Fitness::misses_member; }, Doubt::not_robust);
  is_low([](Evidence& e) { e.simulated = false; }, Doubt::not_simulated);
  is_low([](Evidence& e) { e.fitness = Fitness::limit_cycle; }, Doubt::limit_cycle);
  is_low([](Evidence& e) { e.fitness = Fitness::not_shown; }, Doubt::limit_cycle);
  is_low([](Evidence& e) { e.inertias_agree = false; }, Doubt::inertias_disagree);
  is_low([](Evidence& e) { e.resonance_agrees = false; }, Doubt::resonance_disagrees);
  is_low([](Evidence& e) { e.verdict_depends_on_interpretation = true; },
         Doubt::interpretation_decides);
  is_low([](Evidence& e) { e.plant = PlantBasis::failed_fit; }, Doubt::fit_failed);
  is_low([](Evidence& e) { e.constraints_met_on_members = false; }, Doubt::not_robust);
}

TEST(Confidence, ListsEveryDoubt) {
  EXPECT_THAT(grade(Evidence{}).doubts,
              ElementsAre(Doubt::not_verified, Doubt::not_simulated, Doubt::plant_not_identified));
}

}  // namespace
}  // namespace boresight::design
