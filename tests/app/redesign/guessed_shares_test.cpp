// Other places of the shares of wind and beam that a case guesses.
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/edited_case.hpp"
#include <boresight/app/redesign/choices.hpp>
#include <boresight/io/case/structure_numbers.hpp>

namespace boresight::app {
namespace {

using testing::IsEmpty;

// The 70-m antenna: all shares assumed, the third mode's beam weight below 0.
io::Case guessing_antenna() {
  return io::read_case(case_path("dss14-70m"));
}

plant::Structure placed(const io::Case& antenna, GuessedShares place) {
  return make_plant(antenna, {.guessed_shares = place}).structure;
}

std::vector<std::string> share_choices(const io::Case& antenna) {
  std::vector<std::string> names;
  for (const auto& choice : plant_choices(antenna)) {
    if (!choice.variant || choice.variant->guessed_shares == GuessedShares::as_stated) continue;
    names.push_back(choice.result.name);
    EXPECT_FALSE(choice.result.contradicts);
  }
  return names;
}

TEST(GuessedShares, AsInertiaLetTheWindTurnAFreeAntennaAsOneBody) {
  const auto structure = placed(guessing_antenna(), GuessedShares::as_inertia);
  // One angular acceleration of all: no spring bends at first.
  const double acceleration = structure.bull_gear_wind_fraction / structure.bull_gear_inertia;
  for (const auto& mode : structure.modes) {
    EXPECT_NEAR(mode.wind_fraction / mode.inertia, acceleration, 1e-12 * acceleration);
  }
}

TEST(GuessedShares, LeaveAloneWhatIsNoGuessAndSumToOne) {
  const io::Case antenna = guessing_antenna();
  for (const auto place : {GuessedShares::as_inertia, GuessedShares::all_at_heaviest}) {
    const auto structure = placed(antenna, place);
    double wind = structure.bull_gear_wind_fraction, beam = structure.bull_gear_beam_weight;
    for (const auto& mode : structure.modes) {
      wind += mode.wind_fraction;
      beam += mode.beam_weight;
    }
    EXPECT_NEAR(wind, 1.0, 1e-12);
    EXPECT_NEAR(beam, 1.0, 1e-12);
    EXPECT_EQ(structure.modes[2].beam_weight, -0.15);
  }
  const auto alone = placed(antenna, GuessedShares::all_at_heaviest);
  EXPECT_NEAR(alone.modes[0].wind_fraction, 1.0, 1e-12);
  EXPECT_NEAR(alone.modes[0].beam_weight, 1.15, 1e-12);
  EXPECT_EQ(alone.modes[1].wind_fraction, 0.0);
}

// A subreflector's support turns the beam against itself, and the dish has what balances it.
TEST(GuessedShares, MoveWhatBalancesANegativeOne) {
  io::Case antenna = guessing_antenna();
  auto& modes = antenna.structure.modes;
  modes[2].beam_weight.value = -0.8;
  modes[0].beam_weight.value = 1.45;  // with 0.05, 0.25 and 0.05 on the others
  const auto alone = placed(antenna, GuessedShares::all_at_heaviest);
  EXPECT_NEAR(alone.modes[0].beam_weight, 1.8, 1e-12);
  EXPECT_EQ(alone.modes[1].beam_weight, 0.0);
  EXPECT_EQ(alone.modes[2].beam_weight, -0.8);
  const auto spread = placed(antenna, GuessedShares::as_inertia);
  EXPECT_NEAR(spread.modes[0].beam_weight, 1.8 * 0.62 / 0.93, 1e-12);
}

TEST(GuessedShares, AreChoicesOfTheRedesign) {
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
  EXPECT_FALSE(moves_guessed_shares(own.structure, GuessedShares::as_inertia));
  EXPECT_THAT(share_choices(own), testing::ElementsAre("wind and beam shares all at one"));
  // A guess that says how far it may be off is one of the ensemble's, not of these.
  for (io::Quantity* share : shares(own)) share->uncertainty_given = true;
  EXPECT_THAT(share_choices(own), IsEmpty());
}

}  // namespace
}  // namespace boresight::app
