#include <gtest/gtest.h>

#include "io/edited_case.hpp"
#include <boresight/io/case/antenna_of.hpp>
#include <boresight/io/case/case_structure.hpp>
#include <boresight/io/case/guessed_fractions.hpp>

namespace boresight::io {
namespace {

// The 70-m antenna: all fractions assumed, the third mode's `beam_weight` below 0.
Case guessing_antenna() {
  return read_case(case_path("dss14-70m"));
}

plant::Structure placed(const Case& antenna, GuessedFractions place) {
  return make_plant(antenna, guessed_fraction_changes(*antenna.structure, place)).structure;
}

TEST(GuessedFractions, AsInertiaLetTheWindTurnAFreeAntennaAsOneBody) {
  const auto structure = placed(guessing_antenna(), GuessedFractions::as_inertia);
  // One angular acceleration of all: no spring bends at first.
  const double acceleration = structure.bull_gear_wind_fraction / structure.bull_gear_inertia;
  for (const auto& mode : structure.modes) {
    EXPECT_NEAR(mode.wind_fraction / mode.inertia, acceleration, 1e-12 * acceleration);
  }
}

TEST(GuessedFractions, LeaveAloneWhatIsNoGuessAndSumToOne) {
  const Case antenna = guessing_antenna();
  for (const auto place : {GuessedFractions::as_inertia, GuessedFractions::all_at_heaviest}) {
    const auto structure = placed(antenna, place);
    double wind = structure.bull_gear_wind_fraction, boresight = structure.bull_gear_beam_weight;
    for (const auto& mode : structure.modes) {
      wind += mode.wind_fraction;
      boresight += mode.beam_weight;
    }
    EXPECT_NEAR(wind, 1.0, 1e-12);
    EXPECT_NEAR(boresight, 1.0, 1e-12);
    EXPECT_EQ(structure.modes[2].beam_weight, -0.15);
  }
  const auto alone = placed(antenna, GuessedFractions::all_at_heaviest);
  EXPECT_NEAR(alone.modes[0].wind_fraction, 1.0, 1e-12);
  EXPECT_NEAR(alone.modes[0].beam_weight, 1.15, 1e-12);
  EXPECT_EQ(alone.modes[1].wind_fraction, 0.0);
}

// A subreflector's support turns the beam against itself, and the dish has what balances it.
TEST(GuessedFractions, MoveWhatBalancesANegativeOne) {
  Case antenna = guessing_antenna();
  auto& modes = antenna.structure->modes;
  modes[2].beam_weight.value = -0.8;
  modes[0].beam_weight.value = 1.45;  // with 0.05, 0.25 and 0.05 on the others
  const auto alone = placed(antenna, GuessedFractions::all_at_heaviest);
  EXPECT_NEAR(alone.modes[0].beam_weight, 1.8, 1e-12);
  EXPECT_EQ(alone.modes[1].beam_weight, 0.0);
  EXPECT_EQ(alone.modes[2].beam_weight, -0.8);
  const auto spread = placed(antenna, GuessedFractions::as_inertia);
  EXPECT_NEAR(spread.modes[0].beam_weight, 1.8 * 0.62 / 0.93, 1e-12);
}

}  // namespace
}  // namespace boresight::io
