// A controller held where the guessed fractions of wind and beam are elsewhere.
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/edited_case.hpp"
#include <boresight/app/redesign/assumed_fractions_fixed.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/design/tuning/design_study.hpp>
#include <boresight/io/case/case_structure.hpp>
#include <boresight/io/case/guessed_fractions.hpp>
#include <boresight/io/case/mission_of.hpp>

namespace boresight::app {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const control::Controller& controller() {
  static const control::Controller tuned{control::LoopStructure::pi_with_lag(),
                                         {0.15873, 0.42068, 2.6277, 10.257, 0.23532}};
  return tuned;
}

std::vector<std::string> sentences_of(const io::Case& antenna) {
  std::vector<std::string> sentences;
  conclude_guessed_fractions(antenna, controller(), 10.0, sentences);
  return sentences;
}

TEST(AssumedFractionsFixed, AreWorthASentenceWhereTheyMoveTheRms) {
  const io::Case antenna = io::read_case(case_path("dss14-70m"));
  const auto rms_of = [&](io::GuessedFractions place) {
    auto problem = make_problem(antenna, guessed_fraction_changes(*antenna.structure, place));
    problem.wind.mean_speed = 10.0;
    return design::assess(problem, controller(), make_goals(antenna)).boresight_rms / millidegree;
  };
  EXPECT_THAT(
      sentences_of(antenna),
      ElementsAre(HasSubstr(fmt::format(
          "With fixed gains, the linear {:.3f} mdeg of PI with lag on the case's plant "
          "would be {:.3f} mdeg with wind and boresight fractions as inertia, {:.3f} mdeg with "
          "wind and boresight fractions all at one.",
          rms_of(io::GuessedFractions::as_stated), rms_of(io::GuessedFractions::as_inertia),
          rms_of(io::GuessedFractions::all_at_heaviest)))));
  io::Case known = antenna;
  for (auto& mode : known.structure->modes) {
    mode.wind_fraction.basis = mode.beam_weight.basis = io::Basis::measured;
  }
  EXPECT_THAT(sentences_of(known), IsEmpty());
}

}  // namespace
}  // namespace boresight::app
