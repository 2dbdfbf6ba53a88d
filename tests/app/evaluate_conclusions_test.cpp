// What the conclusions of an evaluation say of drives that do not reach the slew rate.
#include <string>
#include <vector>

#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boresight/app/evaluate/evaluate_section.hpp>

namespace boresight::app {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

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

}  // namespace
}  // namespace boresight::app
