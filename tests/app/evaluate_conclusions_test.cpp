// What the conclusions of an evaluation say of drives, of motions and of needed budgets.
#include <string>
#include <vector>

#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boresight/app/evaluate/evaluate_section.hpp>
#include <boresight/app/report/sky_units.hpp>

namespace boresight::app {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

constexpr double degree = 1e3 * millidegree;

Candidate candidate_of(const std::string& name, double stroke) {
  Candidate candidate;
  candidate.name = name;
  if (name != "as it is") candidate.path = name + ".toml";
  candidate.figures.emplace();
  candidate.figures->slew_stroke_margin = stroke;
  return candidate;
}

std::string concluded(const std::vector<Candidate>& candidates) {
  EvaluateSection section;
  section.candidates = candidates;
  return fmt::format("{}", fmt::join(conclude(section), " "));
}

TEST(EvaluateConclusions, BlameAProposalForTheStrokeThatItTakes) {
  EXPECT_THAT(
      concluded({candidate_of("as it is", 1.2), candidate_of("large motors", 0.85)}),
      AllOf(HasSubstr("Their valves' stroke does not reach the slew rate of today: large motors "
                      "(stroke 0.85 of what the slew rate takes). Pumps and valves"),
            Not(HasSubstr("The stated slew rate"))));
  EXPECT_THAT(concluded({candidate_of("as it is", 1.2), candidate_of("no flywheels", 1.2)}),
              Not(HasSubstr("stroke")));
}

TEST(EvaluateConclusions, DoNotBlameProposalsForASlewRateOutOfReach) {
  EXPECT_THAT(concluded({candidate_of("as it is", 0.66), candidate_of("no flywheels", 0.66),
                         candidate_of("more pressure", 0.75)}),
              AllOf(HasSubstr("The stated slew rate is out of reach of the drive as it is (stroke "
                              "0.66 of what it takes): check drive.slew_rate"),
                    Not(HasSubstr("Pumps and valves")), Not(HasSubstr("today"))));
  EXPECT_THAT(concluded({candidate_of("as it is", 0.66), candidate_of("no flywheels", 0.66),
                         candidate_of("large motors", 0.47)}),
              AllOf(HasSubstr("The stated slew rate is out of reach"),
                    HasSubstr("These proposals lower the stroke further: large motors (stroke 0.47 "
                              "of what the slew rate takes). Pumps and valves")));
}

Candidate moving(const std::string& name, double acceleration, double reversal) {
  Candidate candidate = candidate_of(name, 1.2);
  candidate.figures->slew.emplace().reachable_acceleration = acceleration * degree;
  CandidateLaw law;
  law.design.tuning.status = design::TuningStatus::optimal;
  law.time_domain.emplace().reversal.emplace().beam_error = reversal * millidegree;
  candidate.laws = {law};
  candidate.chosen = 0U;
  return candidate;
}

TEST(EvaluateConclusions, SayWhatAProposalDoesToReversalsAndAcceleration) {
  const auto base = moving("as it is", 0.1, 5.0);
  EXPECT_THAT(concluded({base, moving("no flywheels", 0.15, 5.2), moving("filter", 0.1, 3.0)}),
              AllOf(HasSubstr("5.00 mdeg as it is; filter 3.00 mdeg (-40 %)."),
                    HasSubstr("0.100 deg/s2 as it is; no flywheels 0.150 deg/s2 (+50 %).")));
  EXPECT_THAT(concluded({base, moving("half the flywheels", 0.109, 4.6)}),
              AllOf(Not(HasSubstr("turning round")), Not(HasSubstr("Acceleration"))));
}

TEST(EvaluateConclusions, SayOnHowManyPlantsANeededBudgetIsMet) {
  EvaluateSection section;
  section.ensemble_size = 30;
  section.budgets.resize(2);
  section.budgets[0].name = "tracking";
  section.budgets[0].band = "Ka";
  section.budgets[0].rms = 0.5 * millidegree;
  section.budgets[0].wind_speed = 12.0;
  for (const auto& [name, met] : {std::pair("as it is", 12), std::pair("no flywheels", 25)}) {
    section.candidates.push_back(moving(name, 0.1, 5.0));
    section.candidates.back().laws[0].budgets_met = {met, std::nullopt};
  }
  EXPECT_THAT(
      conclude(section),
      Contains("Of 30 plants that may be the true one tracking (Ka: 0.500 mdeg) is met in 12 "
               "m/s by as it is on 12, no flywheels on 25."));
}

}  // namespace
}  // namespace boresight::app
