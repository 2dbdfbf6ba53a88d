// Other places of the shares of wind and beam that a case guesses.
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/edited_case.hpp"
#include <boresight/app/redesign/choices.hpp>
#include <boresight/io/case/antenna_of.hpp>
#include <boresight/io/case/guessed_shares.hpp>
#include <boresight/io/case/structure_numbers.hpp>

namespace boresight::app {
namespace {

using testing::IsEmpty;

// The 70-m antenna: all shares assumed, the third mode's beam weight below 0.
io::Case guessing_antenna() {
  return io::read_case(case_path("dss14-70m"));
}

std::vector<std::string> share_choices(const io::Case& antenna) {
  std::vector<std::string> names;
  for (const auto& choice : plant_choices(antenna)) {
    if (!choice.result.other_shares) continue;
    names.push_back(choice.result.name);
    EXPECT_FALSE(choice.result.contradicts);
  }
  return names;
}

TEST(GuessedShareChoices, AreMadeOfGuessesOnly) {
  EXPECT_THAT(
      share_choices(guessing_antenna()),
      testing::ElementsAre("wind and beam shares as inertia", "wind and beam shares all at one"));
  // None where no share is a guess, and not the case's own again.
  io::Case known = guessing_antenna(), own = guessing_antenna();
  const auto shares = [](io::Case& antenna) {
    std::vector<io::Quantity*> all{&antenna.structure.bull_gear_wind_fraction,
                                   &antenna.structure.bull_gear_beam_weight};
    for (auto& mode : antenna.structure.modes) {
      all.insert(all.end(), {&mode.wind_fraction, &mode.beam_weight});
    }
    return all;
  };
  for (io::Quantity* share : shares(known)) share->basis = io::Basis::measured;
  EXPECT_THAT(share_choices(known), IsEmpty());
  double rest = 1.0;
  for (auto& mode : own.structure.modes) {
    rest -= mode.inertia_fraction.value;
    mode.wind_fraction.value = mode.beam_weight.value = mode.inertia_fraction.value;
  }
  own.structure.bull_gear_wind_fraction.value = own.structure.bull_gear_beam_weight.value = rest;
  EXPECT_FALSE(moves_guessed_shares(own.structure, io::GuessedShares::as_inertia));
  EXPECT_THAT(share_choices(own), testing::ElementsAre("wind and beam shares all at one"));
  // A guess that says how far it may be off is one of the ensemble's, not of these.
  for (io::Quantity* share : shares(own)) share->uncertainty_given = true;
  EXPECT_THAT(share_choices(own), IsEmpty());
}

}  // namespace
}  // namespace boresight::app
