#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lag_loops.hpp"
#include <boresight/app/document/document_text.hpp>
#include <boresight/app/page/gains_to_load.hpp>

namespace boresight::app {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

Candidate candidate_of(const std::string& path, double rate_gain) {
  Candidate candidate;
  candidate.name = path.empty() ? "as it is" : "no flywheels";
  candidate.path = path;
  CandidateController controller;
  controller.structure = "PI";
  controller.constraints_met = true;
  controller.design.verification.passed = true;
  controller.design.tuning.controller = {control::LoopStructure::named("PI"),
                                         {rate_gain, 0.255, 3.28, 30.0, 0.262}};
  candidate.gains = {io::GainUnits().texts(controller.design.tuning.controller)};
  candidate.controllers = {controller};
  candidate.chosen = 0U;
  return candidate;
}

TEST(GainsToLoad, AreOfTheProposalWorthItsCost) {
  Report report;
  EvaluateSection& section = report.evaluated.emplace();
  section.candidates = {candidate_of("", 0.133), candidate_of("none.toml", 0.126)};
  EXPECT_THAT(to_text(gains_to_load(report)), AllOf(HasSubstr("kr rate gain"), HasSubstr("0.133"),
                                                    HasSubstr("30 1/s"), Not(HasSubstr("0.126"))));
  section.decision.emplace();
  section.decision->candidates.resize(2);
  section.decision->candidates[1].candidate = 1;
  section.decision->worth = 1;
  EXPECT_THAT(to_text(gains_to_load(report)),
              AllOf(HasSubstr("no flywheels"), HasSubstr("0.126"), Not(HasSubstr("0.133"))));
}

// A control computer may not run a state space: the best loops' gains stand below it.
TEST(GainsToLoad, AreOfTheBestLoopsBesideAStateSpace) {
  const auto controller = reference::lag_loops_as_state_space("state space, order 2");
  Report report;
  TuningSection& section = report.tuning.emplace();
  section.name = "SS";
  section.fitness = design::Fitness::fit;
  section.structure = controller.structure;
  section.design.tuning.controller = controller;
  section.design.tuning.status = design::TuningStatus::optimal;
  section.design.verification.passed = true;
  auto& loops = section.loops.emplace();
  loops.structure = "PI";
  loops.design.tuning.controller = candidate_of("", 0.133).controllers[0].design.tuning.controller;
  EXPECT_THAT(
      to_text(gains_to_load(report)),
      AllOf(HasSubstr("to load: SS"), HasSubstr("state space, order 2, sampled every 0.02 s"),
            HasSubstr("of the best loops: PI"), HasSubstr("kr rate gain")));
}

TEST(GainsToLoad, AreNoneWithoutAControllerThatMeetsItsConstraints) {
  Report report;
  EXPECT_TRUE(gains_to_load(report).blocks.empty());
  EvaluateSection& section = report.evaluated.emplace();
  section.candidates = {candidate_of("", 0.133)};
  section.candidates[0].controllers[0].constraints_met = false;
  EXPECT_TRUE(gains_to_load(report).blocks.empty());
}

}  // namespace
}  // namespace boresight::app
