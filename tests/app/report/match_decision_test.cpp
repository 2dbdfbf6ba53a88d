#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boresight/app/match/match_conclusions.hpp>
#include <boresight/app/report/decision.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/app/report/study_decision.hpp>

namespace boresight::app {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

// At 0 disks, 1 as built and 3.
MatchSeries series_of(const std::string& name, const std::vector<double>& rms_mdeg) {
  MatchSeries series;
  series.name = name;
  series.curve.structure = control::LoopStructure::named(name);
  std::vector<double> rms;
  for (const double one : rms_mdeg) {
    MatchValue value;
    value.found = true;
    value.boresight_rms = one * millidegree;
    rms.push_back(value.boresight_rms);
    series.values.push_back(std::move(value));
  }
  series.best = design::least_of(rms);
  series.best_at_end = series.best != 1U;
  return series;
}

MatchSection section_of(std::vector<MatchSeries> series) {
  MatchSection section;
  section.wind_speed = 12.0;
  section.points.resize(3);
  section.points[1].disks = 1.0;
  section.points[1].as_built = true;
  section.points[2].disks = 3.0;
  section.series = std::move(series);
  RuleVerdict rule{.rule = design::ClassicRule::one_to_one,
                   .motor_to_load_ratio = 1.0,
                   .disks = 1.0,
                   .cost = {}};
  for (const auto& one : section.series) {
    rule.cost.push_back(one.values[1].boresight_rms / one.values[*one.best].boresight_rms - 1.0);
  }
  section.rules.push_back(std::move(rule));
  return section;
}

FrictionThreshold threshold_of(double at_nominal) {
  FrictionThreshold threshold;
  threshold.structure = "PI";
  threshold.slope = 4.0;
  threshold.spread_at_nominal = at_nominal;
  return threshold;
}

TEST(MatchConclusions, GatherEffectsOfVelocityReversalAndNameTheTrackingRate) {
  MatchSection section =
      section_of({series_of("PI", {0.4, 0.5, 0.6}), series_of("DPF", {0.4, 0.5, 0.6}),
                  series_of("LL", {0.4, 0.5, 0.6})});
  section.tracking_rate = 5.0 * millidegree;
  section.friction = section.tracking_friction = 0.7;
  section.thresholds = {threshold_of(0.002)};
  for (auto& series : section.series) {
    MatchTimeDomain run;
    design::LimitCycleResult at_rest, tracking;
    at_rest.limit_cycle = series.name != "LL";
    tracking.rate = section.tracking_rate;
    tracking.limit_cycle = series.name != "LL";
    run.limit_cycles = {at_rest, tracking};
    run.reversal = design::ReversalResult{};
    run.reversal->boresight_error = 2.0 * millidegree;
    series.values[0].time_domain = run;
  }
  const auto sentences = conclude(section);
  const auto about = std::ranges::count_if(sentences, [](const std::string& sentence) {
    return sentence.find("Peak boresight error") != std::string::npos;
  });
  EXPECT_EQ(about, 1);
  EXPECT_THAT(sentences,
              Contains(AllOf(HasSubstr("tracking rate of 5 mdeg/s"),
                             HasSubstr("2.00 to 2.00 mdeg with DPF"),
                             HasSubstr("0 disks at rest and at the tracking rate with PI, DPF"),
                             HasSubstr("none seen with LL"))));
  EXPECT_THAT(sentences, Not(Contains(HasSubstr("of the friction curve at the tracking rate"))))
      << "it is the linear plant's";
}

TEST(MatchConclusions, GiveTheErrorOfTheBeamWhereTheRateReverses) {
  MatchSection section = section_of({series_of("PI", {0.4, 0.5, 0.6})});
  const auto reverse = [&](std::size_t point, double encoder_mdeg, double boresight_mdeg) {
    design::ReversalResult reversal;
    reversal.encoder_error = encoder_mdeg * millidegree;
    reversal.boresight_error = boresight_mdeg * millidegree;
    section.series[0].values[point].time_domain = MatchTimeDomain{{}, reversal};
  };
  reverse(0, 2.84, 5.2);
  reverse(2, 2.98, 3.2);
  EXPECT_THAT(conclude(section),
              Contains(AllOf(HasSubstr("Peak boresight error at a velocity reversal"),
                             HasSubstr("over the inertias simulated (2 from 0 to 3 disks): "
                                       "3.20 to 5.20 mdeg with PI"))));
}

TEST(MatchDecision, OfOneFlatStructureIsToLeaveTheFlywheels) {
  MatchSection section = section_of({series_of("PI", {0.5148, 0.5159, 0.5183})});
  section.thresholds = {threshold_of(0.002)};
  MatchVariants variants;
  variants.structure = "PI";
  variants.disks = {0.0};
  variants.variants = {{"", {0.5}, 0U, {}},
                       {"wind model uniform", {0.95}, 0U, {}},
                       {"leakage x 2", {0.503}, 0U, {}}};
  section.variants = {variants};
  EXPECT_THAT(decision(section),
              ElementsAre(AllOf(HasSubstr("Leave the flywheels as they are: with PI loops"),
                                HasSubstr("by more than 0.7 %"),
                                HasSubstr("'wind model uniform' with PI (by 90 %)"),
                                Not(HasSubstr("leakage")))));
  const auto sentences = conclude(section);
  EXPECT_THAT(sentences, Contains(HasSubstr("hardly matters here")));
  EXPECT_THAT(sentences, Each(AllOf(Not(HasSubstr("The rule")), Not(HasSubstr("matters more")),
                                    Not(HasSubstr("PI against PI")))));
}

TEST(MatchDecision, SaysNothingOfStructuresThatWereNotStudied) {
  const MatchSection section = section_of({series_of("PI", {0.4, 0.5, 0.6})});
  EXPECT_THAT(decision(section), ElementsAre(HasSubstr("with PI loops and 0 disks"),
                                             AllOf(HasSubstr("costs +25.0 % with these loops"),
                                                   HasSubstr("other loops were not studied"))));
  const auto sentences = conclude(section);
  EXPECT_THAT(sentences, Contains(HasSubstr("is not known from this study")));
  EXPECT_THAT(sentences,
              Contains(HasSubstr("costs +25.0 % of rms with PI, against its own best: no "
                                 "good rule here")));
}

TEST(MatchDecision, SetsStructuresAgainstFlywheels) {
  const auto text = [](const std::vector<double>& second) {
    return decision(section_of({series_of("PI", {0.4, 0.5, 0.6}), series_of("DPF", second)}))[1];
  };
  EXPECT_THAT(text({0.7, 0.8, 0.9}), HasSubstr("change the loops first"));
  EXPECT_THAT(text({0.45, 0.51, 0.6}), HasSubstr("change the flywheels first"));
  EXPECT_THAT(text({0.5, 0.62, 0.7}), HasSubstr("the two matter equally"));
}

TEST(MatchDecision, AsksForTheFrictionSlopeOnlyWhereItDecides) {
  MatchSection section = section_of({series_of("PI", {0.4, 0.5, 0.6})});
  section.thresholds = {threshold_of(0.5)};
  section.tracking_friction = 12.0;
  EXPECT_THAT(decision(section), Contains(HasSubstr("Measure the friction slope")));
  section.thresholds = {threshold_of(0.01)};
  EXPECT_THAT(decision(section), Each(Not(HasSubstr("Measure the friction slope"))));
  // A slope that no friction of the case comes near to is nothing to measure.
  section.thresholds = {threshold_of(0.5)};
  section.tracking_friction = 0.05;
  EXPECT_THAT(decision(section), Each(Not(HasSubstr("Measure the friction slope"))));
}

// Runs every point on the nonlinear antenna: a limit cycle of that amplitude at rest.
MatchSeries limit_cycles(MatchSeries series, double amplitude_mdeg) {
  design::LimitCycleResult rest;
  rest.limit_cycle = amplitude_mdeg > 0.0;
  rest.boresight_amplitude = amplitude_mdeg * millidegree;
  for (auto& value : series.values) value.time_domain = MatchTimeDomain{{rest}, {}};
  return series;
}

TEST(MatchDecision, PutsNoStructureFirstThatLimitCyclesBeyondTheAllowedAmplitude) {
  const auto with = [](double amplitude_mdeg) {
    MatchSection section =
        section_of({limit_cycles(series_of("PI", {0.4, 0.5, 0.6}), 0.1),
                    limit_cycles(series_of("DPF+C", {0.1, 0.11, 0.12}), amplitude_mdeg)});
    section.allowed_limit_cycle = 0.705 * millidegree;
    return decision(section);
  };
  EXPECT_THAT(with(0.5).front(), HasSubstr("with DPF+C loops"));
  // sqrt(0.1^2 + 0.6^2 / 2) = 0.436 against 0.406, though not excluded.
  EXPECT_THAT(with(0.6).front(), HasSubstr("with PI loops"));
  const auto barred = with(0.71);
  EXPECT_THAT(barred.front(), HasSubstr("with PI loops"));
  EXPECT_THAT(barred, Contains(HasSubstr("Not DPF+C, 0.100 mdeg on the linear plant: on the "
                                         "nonlinear antenna it limit-cycles by +-0.71 mdeg")));
  EXPECT_THAT(barred, Each(Not(HasSubstr("change the loops first"))));
  MatchSection alone = section_of({limit_cycles(series_of("PI", {0.4, 0.5, 0.6}), 3.0)});
  alone.allowed_limit_cycle = 0.705 * millidegree;
  EXPECT_THAT(decision(alone),
              ElementsAre(HasSubstr("is shown free of limit cycles beyond the allowed amplitude")));
}

// Still at every other point.
MatchSeries limit_cycle_as_built(MatchSeries series, double amplitude_mdeg) {
  MatchSeries result = limit_cycles(std::move(series), 0.0);
  result.values[1] = limit_cycles(result, amplitude_mdeg).values[1];
  return result;
}

MatchSection within_allowed(std::vector<MatchSeries> series) {
  MatchSection section = section_of(std::move(series));
  section.allowed_limit_cycle = 0.705 * millidegree;
  return section;
}

TEST(MatchConclusions, CompareInertiaAndStructureByThoseThatDoNotLimitCycle) {
  for (const auto& third : {limit_cycles(series_of("DPF+C", {0.1, 0.3, 0.4}), 3.0),
                            limit_cycle_as_built(series_of("DPF+C", {0.1, 0.3, 0.4}), 3.0)}) {
    const auto sentences =
        conclude(within_allowed({limit_cycles(series_of("PI", {0.4, 0.42, 0.44}), 0.1),
                                 series_of("LL", {0.4, 0.5, 0.5}), third}));
    EXPECT_THAT(sentences,
                Contains(AllOf(HasSubstr("the rms changes most with LL, by 25 %"),
                               HasSubstr("changes it by 19 % (PI against LL): the inertia"))));
    EXPECT_THAT(sentences, Contains(HasSubstr("costs +5.0 % of rms with PI and +25.0 % with LL")));
  }
  EXPECT_THAT(conclude(within_allowed({series_of("PI", {0.5, 0.501, 0.502}),
                                       limit_cycles(series_of("DPF+C", {0.1, 0.3, 0.4}), 3.0)})),
              Contains(HasSubstr("by more than 0.4 %: the motors' inertia hardly matters here")));
}

TEST(MatchConclusions, CompareNothingWhereAllLimitCycle) {
  const auto sentences =
      conclude(within_allowed({limit_cycles(series_of("PI", {0.4, 0.5, 0.6}), 1.0),
                               limit_cycles(series_of("DPF+C", {0.1, 0.3, 0.4}), 3.0)}));
  EXPECT_THAT(sentences, Contains(HasSubstr("examine friction before the motors")));
  EXPECT_THAT(sentences, Each(AllOf(Not(HasSubstr("changes most with")),
                                    Not(HasSubstr("good rule")), Not(HasSubstr("hardly")))));
}

MatchSeries lost_at(MatchSeries series, std::size_t point) {
  design::LimitCycleResult run;
  run.status = design::RunStatus::lost;
  series.values[point].time_domain = MatchTimeDomain{{run}, {}};
  return series;
}

TEST(MatchDecision, TellsNoLimitCycleThatWasNotSeen) {
  const MatchSeries calm = limit_cycles(series_of("PI", {0.4, 0.5, 0.6}), 0.1);
  const MatchSeries limit_cycle_free = limit_cycles(series_of("DPF", {0.3, 0.31, 0.32}), 0.1);
  EXPECT_THAT(decision(within_allowed({calm, lost_at(limit_cycle_free, 1)})),
              Contains(HasSubstr("As built, these loops are not shown free of limit cycles")));
  EXPECT_THAT(decision(within_allowed({lost_at(limit_cycle_free, 0)})),
              ElementsAre(HasSubstr(
                  "No structure that meets the constraints is shown free of limit cycles")));
  EXPECT_THAT(
      decision(within_allowed({calm, lost_at(limit_cycle_free, 0)})),
      Contains(HasSubstr("Not DPF, 0.300 mdeg on the linear plant: on the nonlinear antenna it is "
                         "not shown free of limit cycles, as a run did not complete.")));
}

TEST(MatchDecision, MeasuresNoFrictionForStructuresThatLimitCycle) {
  const auto with = [](double amplitude_mdeg) {
    MatchSection section =
        within_allowed({limit_cycles(series_of("PI", {0.4, 0.5, 0.6}), amplitude_mdeg),
                        limit_cycles(series_of("DPF", {0.3, 0.4, 0.5}), 0.1)});
    section.tracking_friction = 4.0;
    section.thresholds = {threshold_of(0.5)};
    auto sentences = decision(section);
    for (auto& sentence : conclude(section)) sentences.push_back(std::move(sentence));
    return sentences;
  };
  EXPECT_THAT(with(0.1), AllOf(Contains(HasSubstr("Measure the friction slope")),
                               Contains(HasSubstr("With PI, if the friction slope"))));
  EXPECT_THAT(with(3.0), Each(AllOf(Not(HasSubstr("Measure the friction slope")),
                                    Not(HasSubstr("With PI, if the friction slope")))));
}

TEST(MatchConclusions, NameTheStructuresThatLimitCycleAndByHowMuch) {
  const auto with = [](const MatchSeries& second) {
    return conclude(within_allowed({limit_cycles(series_of("PI", {0.4, 0.5, 0.6}), 0.1), second}));
  };
  const MatchSeries series = series_of("DPF+C", {0.1, 0.3, 0.4});
  EXPECT_THAT(with(limit_cycles(series, 3.0)),
              Contains(AllOf(
                  HasSubstr("limit-cycle beyond the allowed boresight amplitude of +-0.705 mdeg"),
                  HasSubstr(": as built DPF+C (+-3.00 mdeg); with its best motors DPF+C (+-3.00 "
                            "mdeg at 0 disks). They are excluded from the comparisons"))));
  EXPECT_THAT(with(limit_cycle_as_built(series, 3.0)),
              Contains(HasSubstr(": as built DPF+C (+-3.00 mdeg). They are excluded")));
  EXPECT_THAT(with(limit_cycles(series, 0.7)), Each(Not(HasSubstr("allowed amplitude"))));
  EXPECT_THAT(with(lost_at(series, 1)),
              Contains(AllOf(HasSubstr("Freedom from limit cycles is not shown for DPF+C"),
                             Not(HasSubstr("+-")))));
  // Seen to limit-cycle in one run, it is known enough.
  MatchSeries seen = limit_cycles(series, 3.0);
  design::LimitCycleResult lost;
  lost.status = design::RunStatus::lost;
  for (auto& value : seen.values) value.time_domain->limit_cycles.push_back(lost);
  EXPECT_THAT(with(seen), AllOf(Contains(HasSubstr("as built DPF+C (+-3.00 mdeg)")),
                                Each(Not(HasSubstr("Freedom from limit cycles is not shown")))));
}

TEST(MatchDecision, ExcludesLoopsThatLimitCycleWithTheMotorsAsBuilt) {
  const MatchSeries calm = limit_cycles(series_of("PI", {0.4, 0.5, 0.6}), 0.1);
  const auto text = [&](const std::vector<double>& rms) {
    return decision(within_allowed({calm, limit_cycle_as_built(series_of("DPF", rms), 3.0)}))[1];
  };
  EXPECT_THAT(
      text({0.7, 0.8, 0.9}),
      AllOf(
          HasSubstr("costs +25.0 % with these loops; no other loops studied meet the constraints"),
          Not(HasSubstr("change the loops first"))));
  EXPECT_THAT(text({0.3, 0.31, 0.32}),
              HasSubstr("As built, these loops limit-cycle beyond the allowed amplitude"));
}

TEST(MatchConclusions, ConfirmNoRuleByALeastAtTheUpperEnd) {
  const auto rule = [](const std::vector<double>& rms) {
    return conclude(section_of({series_of("PI", rms)}));
  };
  EXPECT_THAT(rule({0.6, 0.505, 0.5}), Contains(HasSubstr("not confirmed")));
  EXPECT_THAT(rule({0.6, 0.5, 0.505}), Contains(HasSubstr("a good rule here")));
}

}  // namespace
}  // namespace boresight::app
