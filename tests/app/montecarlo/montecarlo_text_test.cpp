// What the text of a Monte Carlo study shows.
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lag_loops.hpp"
#include <boresight/app/montecarlo/montecarlo_study.hpp>
#include <boresight/control/controllers/controller.hpp>
#include <boresight/control/controllers/sampled_controller.hpp>
#include <boresight/plant/linear/interconnection.hpp>

namespace boresight::app {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

MonteCarloSection section_of(std::vector<double> losses) {
  MonteCarloSection section;
  section.boresight_rms = design::summarise({1e-5, 2e-5}, {0.05, 0.5, 0.95, 0.99});
  section.losses.emplace_back().band.name = "Ka";
  section.losses.back().loss = design::summarise(std::move(losses), {0.05, 0.5, 0.95, 0.99});
  section.controller.structure = control::LoopStructure::pi_with_lag();
  return section;
}

TEST(MonteCarloText, GivesNoFigureOfALossBeyondTheBeamsParabola) {
  const std::string within = to_text(section_of({0.5, 0.7, 0.9}));
  EXPECT_THAT(within, AllOf(ContainsRegex("loss Ka, dB +0\\.7000 \\[.*\\] +0\\.2000 +0\\.[0-9]+ "),
                            Not(HasSubstr("parabola"))));
  const std::string beyond = to_text(section_of({0.5, 0.7, 9.0, 11.0}));
  EXPECT_THAT(beyond, AllOf(ContainsRegex("loss Ka, dB +> 3 +- +0\\.5300 \\[-, 0\\.7000\\] +> 3 "),
                            ContainsRegex("loss Ka, .* > 3 *\n"), Not(HasSubstr("11.0")),
                            HasSubstr("beyond 3 dB the parabolic beam model does not hold")));
}

TEST(MonteCarloConclusions, SpeakOfGainsWhereTheControllerHasSome) {
  MonteCarloSection section = section_of({0.5, 0.7, 0.9});
  section.stable = 2;
  EXPECT_THAT(conclude(section).front(), HasSubstr("With these fixed gains, "));
  const control::Controller loops = reference::lag_loops();
  section.controller = control::state_space_controller(
      "of a file", plant::subsystem(control::sampled_controller(loops, 0.02),
                                    {"tachometer", "encoder"}, {"valve_demand"}));
  EXPECT_THAT(conclude(section).front(), HasSubstr("With this controller, "));
}

}  // namespace
}  // namespace boresight::app
