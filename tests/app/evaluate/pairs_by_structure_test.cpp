// Candidates with laws of different structures, held against each other with one on both.
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/edited_case.hpp"
#include <boresight/app/evaluate/evaluate_study.hpp>
#include <boresight/app/evaluate/pairs_by_structure.hpp>
#include <boresight/io/campaign/designed_antenna.hpp>

namespace boresight::app {
namespace {

using testing::AllOf;
using testing::HasSubstr;

// A law of that name whose gains are those of one PI loop, whatever the name.
CandidateLaw law_of(const std::string& structure, double factor) {
  CandidateLaw law;
  law.structure = structure;
  law.goals_met = true;
  law.design.verification.passed = true;
  auto& tuning = law.design.tuning;
  tuning.status = design::TuningStatus::optimal;
  tuning.law.structure = control::LoopStructure::named("PI");
  // kr, wi, wp, kp, wip: near those of docs/reference-designs.md.
  tuning.law.gains = {0.15, 0.4, 2.6, 8.0, 0.15};
  auto& run = law.time_domain.emplace();
  run.wind.beam_rms = factor;
  run.wind.continuous_rms = 1.0;
  return law;
}

Candidate candidate_of(const std::string& name, double first, double second, std::size_t chosen) {
  Candidate candidate;
  candidate.name = name;
  if (name != "as it is") {
    candidate.path = name + ".toml";
    candidate.changes.emplace_back();
  }
  candidate.laws = {law_of("PI", first), law_of("DPF", second)};
  candidate.chosen = chosen;
  return candidate;
}

// One plant for both, so that means over the draws go as the factors of the laws.
DecisionSection decided(const std::vector<Candidate>& candidates) {
  static const io::DesignedAntenna antenna =
      designed_antenna(io::read_case(case_path("dss14-70m")), 1, 1, nullptr);
  EvaluateOptions options;
  options.draws = 100;
  return decide(candidates, {candidates.size(), antenna.antenna}, antenna.distribution, options);
}

TEST(PairsByStructure, CompareWithOneStructureOnBothOverTheSameDraws) {
  const std::vector<Candidate> candidates{candidate_of("as it is", 1.0, 0.9, 0),
                                          candidate_of("no flywheels", 1.1, 0.95, 1)};
  const auto decision = decided(candidates);
  ASSERT_EQ(decision.by_structure.size(), 1U);
  const auto& found = decision.by_structure[0].structures;
  ASSERT_EQ(found.size(), 2U);
  const double mean = decision.statistics.options[0].mean;
  EXPECT_EQ(found[0].structure, "PI");
  EXPECT_NEAR(found[0].mean_gain, 0.1 * mean, 1e-9 * mean);
  EXPECT_EQ(found[1].structure, "DPF");
  EXPECT_NEAR(found[1].mean_gain, 0.05 * mean, 1e-9 * mean);
  EXPECT_GT(found[1].better.value, 0.95);
}

TEST(PairsByStructure, LeaveOutPairsThatTheChosenLawsHoldApartAlready) {
  EXPECT_TRUE(
      decided({candidate_of("as it is", 1.0, 0.9, 0), candidate_of("no flywheels", 1.1, 0.95, 0)})
          .by_structure.empty());
}

// As it is with PI, a proposal with DPF and 0.2 mdeg less; gains of the proposal with one on both.
std::string told(const std::vector<double>& gains) {
  EvaluateSection section;
  section.candidates = {candidate_of("as it is", 1.0, 0.9, 0),
                        candidate_of("no flywheels", 1.1, 0.95, 1)};
  DecisionSection decision;
  decision.candidates = {{.candidate = 0, .unstable = {}, .outside_goals = {}},
                         {.candidate = 1, .unstable = {}, .outside_goals = {}}};
  auto& pair = decision.statistics.pairs.emplace_back();
  pair.second = 1;
  pair.mean_gain = -0.2;
  PairByStructure& found = decision.by_structure.emplace_back();
  found.second = 1;
  for (const double gain : gains) {
    found.structures.push_back({.structure = found.structures.empty() ? "PI" : "DPF",
                                .better = {.value = 0.25, .lower = 0.2, .upper = 0.3},
                                .mean_gain = -gain,
                                .gain_error = 0.001,
                                .first_usable = true,
                                .second_usable = true});
  }
  return law_or_hardware(section, decision);
}

TEST(PairsByStructure, TellTheLawsShareFromTheHardwares) {
  EXPECT_THAT(told({-0.03, -0.04}),
              AllOf(HasSubstr("no flywheels (DPF) has 0.2000 mdeg less than as it is (PI)"),
                    HasSubstr("with PI on both 0.0300 more (better with probability 0.750)"),
                    HasSubstr("the gain is the law's, and by its hardware alone the order turns "
                              "round")));
  EXPECT_THAT(told({0.05, 0.08}),
              HasSubstr("the hardware makes 0.0500 to 0.0800 mdeg of it, the law the rest."));
  EXPECT_THAT(told({0.05, -0.08}),
              HasSubstr("which hardware is the better one turns round with the structure."));
  EXPECT_THAT(told({0.0005, 0.0}), HasSubstr("the hardware makes no difference."));
  EXPECT_THAT(told({0.21, 0.2}), HasSubstr("the gain is the hardware's, whatever the law."));
  EXPECT_THAT(told({}), HasSubstr("No structure was tuned for both, so that law and hardware are "
                                  "not told apart: no flywheels (DPF) and as it is (PI)."));
}

}  // namespace
}  // namespace boresight::app
