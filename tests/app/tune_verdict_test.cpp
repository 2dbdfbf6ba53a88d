// What is said of tuned laws that hunt on the nonlinear antenna, and of gains at their bounds.
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boresight/app/report/sky_units.hpp>
#include <boresight/app/tune/gains_at_bounds.hpp>
#include <boresight/app/tune/tune_study.hpp>

namespace boresight::app {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;

TEST(TuneConclusions, SayThatABoundOnlyStopsAFlatDirection) {
  TunedLaw law;
  law.structure = "PI";
  law.tuned_for = TunedFor::robust;
  law.wind_speed = 12.7056;
  law.beam_rms = 9.4551 * millidegree;
  EXPECT_TRUE(gain_trades({&law}).empty());
  law.trade = {"6 1/s", "0.254", 9.5 * millidegree, 20};
  law.ensemble.emplace().members.resize(30);
  const auto sentences = gain_trades({&law});
  ASSERT_EQ(sentences.size(), 1U);
  EXPECT_THAT(sentences[0],
              AllOf(HasSubstr("PI (robust, 12.7 m/s) has kp at its bound because"),
                    HasSubstr("kp = 6 1/s and kr = 0.254 have 9.5000 mdeg, +0.5 %, with every "
                              "goal kept on 20 of 30 plants")));
}

TEST(Shortfalls, TrustNoBudgetToALawThatHunts) {
  TuneSection section;
  section.wind_speeds = {12.0};
  section.wind_mast = WindMast{10.0, 28.0, 0.14, 1.2};
  PointingBudget budget;
  budget.name = "need";
  budget.band = "Ka";
  budget.rms = 1.2 * millidegree;
  budget.wind_speed = 12.0;
  section.budgets = {budget};
  const auto row = [](const std::string& structure, double rms, double hunting, double simulated) {
    TunedLaw law;
    law.structure = structure;
    law.tuned_for = TunedFor::robust;
    law.wind_speed = 12.0;
    law.goals_met = true;
    law.design.tuning.status = design::TuningStatus::optimal;
    law.design.verification.passed = true;
    law.beam_rms = rms * millidegree;
    law.speed_limits = {12.0 * 1.2 / rms};
    law.in_time = {hunting < 1.0, hunting * millidegree, simulated * millidegree};
    return law;
  };
  section.laws = {row("DPF+C", 1.0, 7.4, 1.05), row("LL", 1.1, 0.2, 1.5), row("PI", 1.5, 0.2, 1.6)};
  // The linear plant's best meets the budget, and hunts; the second misses it on the nonlinear one.
  EXPECT_EQ(best_law(section, 12.0), &section.laws[0]);
  EXPECT_EQ(best_pointing_law(section, 12.0), &section.laws[1]);
  auto shortfalls = find_shortfalls(section);
  ASSERT_EQ(shortfalls.size(), 1U);
  EXPECT_THAT(shortfalls[0].infeasible,
              HasSubstr("cannot be met up to 12 m/s at the dish, 10 at the mast."));
  EXPECT_THAT(shortfalls[0].closest,
              AllOf(HasSubstr("LL (robust) comes nearest with 1.5000 mdeg on the nonlinear antenna "
                              "(1.1000 by the linear plant)"),
                    HasSubstr("met up to 13.1 m/s at the dish, 10.9 at the mast by the linear"),
                    HasSubstr("Left out for what they do on the nonlinear antenna: DPF+C (robust), "
                              "1.0000 mdeg by the linear plant, hunts by +-7.40 mdeg.")));
  EXPECT_THAT(conclude(section),
              Contains(HasSubstr("but it hunts by +-7.40 mdeg on the nonlinear antenna")));
  // A law that loses on the nonlinear antenna but meets the budget there all the same is good.
  section.laws[1] = row("LL", 0.9, 0.2, 1.15);
  EXPECT_TRUE(find_shortfalls(section).empty());
  // Where none is left, the linear best is named for what it is.
  section.laws = {row("DPF+C", 1.3, 7.4, 1.35)};
  shortfalls = find_shortfalls(section);
  ASSERT_EQ(shortfalls.size(), 1U);
  EXPECT_THAT(shortfalls[0].closest,
              AllOf(HasSubstr("DPF+C (robust) comes nearest with 1.3500 mdeg on the nonlinear"),
                    HasSubstr("On the nonlinear antenna it hunts by +-7.40 mdeg, and no other")));
}

}  // namespace
}  // namespace boresight::app
