#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <boresight/design/studies/matching_verdict.hpp>

namespace boresight::design {
namespace {

MatchSeries series_of(const std::string& name, const std::vector<double>& rms) {
  MatchSeries series;
  series.name = name;
  series.curve.structure = control::LoopStructure::named(name);
  for (const double one : rms) {
    MatchValue value;
    value.found = true;
    value.boresight_rms = one;
    series.values.push_back(std::move(value));
  }
  series.best = least_of(rms);
  return series;
}

// At 0 disks, 1 as built and 3; a limit cycle of 1 is allowed.
MatchingStudy study_of(std::vector<MatchSeries> series) {
  MatchingStudy study;
  study.points = {{.disks = 0.0}, {.disks = 1.0, .as_built = true}, {.disks = 3.0}};
  study.series = std::move(series);
  study.allowed_limit_cycle = 1.0;
  return study;
}

MatchSeries limit_cycles(MatchSeries series, double amplitude) {
  LimitCycleResult rest;
  rest.status = RunStatus::complete;
  rest.limit_cycle = true;
  rest.boresight_amplitude = amplitude;
  for (auto& value : series.values) value.time_domain = MatchTimeDomain{{rest}, {}};
  return series;
}

TEST(MatchingVerdict, ExcludesStructuresThatLimitCycleBeyondTheAllowedAmplitude) {
  const auto study = study_of({limit_cycles(series_of("PI", {0.2, 0.3, 0.4}), 30.0),
                               limit_cycles(series_of("DPF", {0.5, 0.6, 0.7}), 0.1)});
  EXPECT_TRUE(has_limit_cycle(study, study.series[0]));
  EXPECT_TRUE(limit_cycle_beyond(study, limit_cycle_of(study, study.series[0])));
  EXPECT_FALSE(is_eligible(study, "PI"));
  EXPECT_TRUE(is_eligible(study, "DPF"));
  EXPECT_FALSE(is_eligible(study, "LL")) << "was not studied";
  EXPECT_EQ(most_moved(study), &study.series[1]);
  EXPECT_EQ(recommended_structure(study, [](const MatchSeries&) { return true; }),
            &study.series[1]);
}

TEST(MatchingVerdict, InertiaHardlyMattersWhereEveryCurveIsFlat) {
  EXPECT_TRUE(hardly_matters(study_of({series_of("PI", {1.0, 1.01, 1.015})})));
  EXPECT_FALSE(hardly_matters(study_of({series_of("PI", {1.0, 1.01, 1.03})})));
  EXPECT_FALSE(hardly_matters(study_of({})));
  auto gap = study_of({series_of("PI", {1.0, 1.01, 1.015})});
  gap.series[0].values[2].found = false;
  EXPECT_FALSE(hardly_matters(gap));
  EXPECT_NEAR(span_of(gap.series[0]), 0.01, 1e-12);
}

TEST(MatchingVerdict, ComparesStructuresAsBuilt) {
  const auto study =
      study_of({series_of("PI", {1.0, 1.2, 1.3}), series_of("DPF", {0.9, 0.8, 0.7})});
  const auto built = structures_as_built(study);
  EXPECT_EQ(as_built(study), 1U);
  EXPECT_EQ(built.count, 2U);
  EXPECT_EQ(built.minimum, &study.series[1]);
  EXPECT_EQ(built.largest, &study.series[0]);
  EXPECT_NEAR(built.change, 0.5, 1e-12);
}

TEST(MatchingVerdict, SeesAnOptimumOnlyBelowTheUpperEnd) {
  EXPECT_TRUE(has_optimum(study_of({series_of("PI", {1.0, 1.2, 1.3})})));
  EXPECT_FALSE(has_optimum(study_of({series_of("PI", {1.3, 1.2, 1.0})})));
}

TEST(MatchingVerdict, NamesInertiasAsGoodBeyondTheFlatRange) {
  auto study = study_of({series_of("PI", {1.0, 1.2, 1.005})});
  EXPECT_EQ(as_good_elsewhere(study, study.series[0]), std::vector<double>{3.0});
  study.series[0].values[2].found = false;
  EXPECT_TRUE(as_good_elsewhere(study, study.series[0]).empty());
}

TEST(MatchingVerdict, RulesCostWhatTheComparedStructuresPay) {
  const auto study = study_of({series_of("PI", {1.0, 1.2, 1.3}), series_of("DPF", {0.9, 0.8, 0.7}),
                               limit_cycles(series_of("LL", {0.5, 0.6, 0.7}), 30.0)});
  const RuleVerdict rule{ClassicRule::one_to_one, 1.0, 1.0, {0.2, 0.1, 0.9}};
  const auto costs = costs_of(study, rule);
  EXPECT_EQ(costs.cheapest, &study.series[1]);
  EXPECT_EQ(costs.dearest, &study.series[0]);
  EXPECT_EQ(costs.minimum, 0.1);
  EXPECT_EQ(costs_of(study_of({}), {}).cheapest, nullptr);
}

TEST(MatchingVerdict, FrictionDecidesWithinWhatTheAntennaMayHave) {
  auto study = study_of({series_of("PI", {1.0, 1.2, 1.3})});
  study.friction = 1.0;
  study.tracking_friction = 4.0;
  FrictionThreshold threshold;
  threshold.structure = "PI";
  threshold.slope = 5.0;
  threshold.spread_at_nominal = 0.3;
  study.thresholds = {threshold};
  EXPECT_EQ(deciding_friction(study), &study.thresholds[0]);
  study.thresholds[0].slope = 7.0;
  EXPECT_EQ(deciding_friction(study), nullptr) << "beyond 1.5 times the curve's slope";
  study.thresholds[0].slope = 5.0;
  study.thresholds[0].spread_at_nominal = 0.01;
  EXPECT_EQ(deciding_friction(study), nullptr) << "matters little already";
}

// Runs in wind of a series: simulated by `factor` over linear, each over members of the nominal
// rms.
MatchSeries in_wind(MatchSeries series, double factor, double amplitude, double scatter) {
  series = limit_cycles(std::move(series), amplitude);
  for (auto& value : series.values) {
    MatchTimeDomain& run = *value.time_domain;
    run.member_rms = value.boresight_rms;
    SimulatedRms& expected = run.expected.emplace();
    expected.records = expected.winds = 10;
    const double rms = factor * value.boresight_rms;
    expected.linear_mean_squares = rms * rms * Eigen::VectorXd::LinSpaced(10, 0.8, 1.2);
    expected.mean_squares = expected.linear_mean_squares;
    for (Eigen::Index i = 0; i < 10; ++i) {
      expected.mean_squares[i] *= i % 2 == 0 ? 1.0 + scatter : 1.0 - scatter;
    }
    expected.rms.value = rms;
  }
  return series;
}

TEST(MatchingVerdict, RanksMotorsByTheirOwnControllerAsSimulated) {
  // Linear loops put the first motors and DPF first; as simulated they are the last.
  const auto study = study_of({in_wind(series_of("PI", {0.40, 0.30, 0.42}), 1.0, 0.1, 1e-5),
                               in_wind(series_of("DPF", {0.20, 0.29, 0.50}), 2.5, 0.1, 1e-5)});
  const auto ranked = ranked_motors(study);
  ASSERT_EQ(ranked.size(), 3U);
  EXPECT_EQ(ranked[0].point, 1U);
  EXPECT_EQ(ranked[0].series, 0U);
  EXPECT_NEAR(ranked[0].compared_rms, std::hypot(0.30, 0.1 / std::sqrt(2.0)), 1e-12);
  EXPECT_TRUE(ranked[0].tied);
  EXPECT_EQ(ranked[1].point, 0U);
  EXPECT_FALSE(ranked[1].tied);
  EXPECT_TRUE(ranked_motors(study_of({series_of("PI", {0.4, 0.3, 0.42})})).empty());
}

TEST(MatchingVerdict, CallsMotorsATieThatTheSameWindsDoNotTellApart) {
  const auto tied = [](double scatter) {
    auto first = in_wind(series_of("PI", {0.40, 0.42, 0.60}), 1.0, 0.0, 0.0);
    const auto second = in_wind(series_of("PI", {0.40, 0.42, 0.60}), 1.0, 0.0, scatter);
    first.values[1] = second.values[1];
    return ranked_motors(study_of({first})).at(1).tied;
  };
  EXPECT_FALSE(tied(1e-5));
  EXPECT_TRUE(tied(0.2));
}

TEST(MatchingVerdict, TellsWhatEachVariantChanges) {
  auto study = study_of({series_of("PI", {1.0, 1.2, 1.3})});
  MatchVariants variants;
  variants.structure = "PI";
  variants.disks = {0.0};
  variants.variants = {{"", {0.5}, 0U, {}}, {"leakage x 2", {0.6}, 0U, {}}, {"none", {}, {}, {}}};
  study.variants = {variants};
  const auto changes = variant_changes(study);
  ASSERT_EQ(changes.size(), 2U);
  EXPECT_EQ(changes[1].variant, "leakage x 2");
  EXPECT_NEAR(changes[1].change, 0.2, 1e-12);
}

}  // namespace
}  // namespace boresight::design
