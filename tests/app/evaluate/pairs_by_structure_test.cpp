// Candidates with controllers of different structures, held against each other with one on both.
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boresight/app/evaluate/pairs_by_structure.hpp>

namespace boresight::app {
namespace {

using testing::AllOf;
using testing::HasSubstr;

Candidate candidate_of(const std::string& name, std::size_t chosen) {
  Candidate candidate;
  candidate.name = name;
  if (name != "as it is") candidate.path = name + ".toml";
  for (const char* structure : {"PI", "DPF"})
    candidate.controllers.emplace_back().structure = structure;
  candidate.chosen = chosen;
  return candidate;
}

// As it is with PI, a proposal with DPF and 0.2 mdeg less; gains of the proposal with one on both.
std::string told(const std::vector<double>& gains) {
  EvaluateSection section;
  section.candidates = {candidate_of("as it is", 0), candidate_of("no flywheels", 1)};
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
  return controller_or_hardware(section, decision);
}

TEST(PairsByStructure, TellTheControllersFractionFromTheHardwares) {
  EXPECT_THAT(
      told({-0.03, -0.04}),
      AllOf(HasSubstr("no flywheels (DPF) has 0.2000 mdeg less than as it is (PI)"),
            HasSubstr("with PI on both 0.0300 more (better with probability 0.750)"),
            HasSubstr(
                "the gain comes from the controller; with equal structures the order reverses")));
  EXPECT_THAT(
      told({0.05, 0.08}),
      HasSubstr("the hardware contributes 0.0500 to 0.0800 mdeg, the controller the rest."));
  EXPECT_THAT(told({0.05, -0.08}), HasSubstr("which hardware is better depends on the structure."));
  EXPECT_THAT(told({0.0005, 0.0}), HasSubstr("the hardware makes no difference."));
  EXPECT_THAT(told({0.21, 0.2}),
              HasSubstr("the gain comes from the hardware, whatever the controller."));
  EXPECT_THAT(told({}),
              HasSubstr("No structure was tuned for both, so controller and hardware effects are "
                        "not separated: no flywheels (DPF) and as it is (PI)."));
}

}  // namespace
}  // namespace boresight::app
