// What of friction an audit holds against tests and supply.
#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/audit/failed_checks.hpp"
#include <boresight/io/audit/case_checks.hpp>
#include <boresight/io/case/case_friction.hpp>
#include <boresight/io/case/case_tests.hpp>
#include <boresight/io/case/drive_numbers.hpp>

namespace boresight::io {
namespace {

using testing::Each;
using testing::IsEmpty;

const std::string viscous = "viscous = { value = \"2.075 N.m.s/rad\"";
const std::string breakaway = "breakaway = { value = \"16.83 N.m\"";
const std::string supply_pressure = "supply_pressure = { value = \"2000 psi\"";

Checks against_supply(const EditedCase& edited) {
  return failed(edited, "friction_against_supply");
}

std::string campaign_case(const std::string& name) {
  return BORESIGHT_SOURCE_DIR "/tests/data/campaigns/" + name + "/case.toml";
}

TEST(FrictionAgainstTheSupply, SaysThatTheSlewRateIsOutOfReach) {
  const Case antenna = read_case(case_path("dss14-70m"));
  const double slewing = 0.25 * std::numbers::pi / 180.0 * gear_ratio(antenna);
  const auto found = against_supply(EditedCase());
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].quantity, "friction_curve.viscous");
  ASSERT_EQ(found[0].numbers.size(), 4U);
  EXPECT_NEAR(found[0].numbers[1].value, 10.33 + 63.29 + 2.075 * slewing, 1e-9);
  EXPECT_NEAR(found[0].numbers[2].value, supply_torque(antenna), 1e-9);
  EXPECT_GT(found[0].numbers[3].value, 1.0);
  EXPECT_EQ(found[0].explanation, "slewing_beyond_supply");
  ASSERT_EQ(found[0].entries.size(), 2U);
  EXPECT_EQ(found[0].entries[0].text, "2.075 N.m.s/rad");
  EXPECT_TRUE(found[0].entries[0].assumed);
  EXPECT_EQ(found[0].entries[1].id, "drive.supply_pressure");
}

TEST(FrictionAgainstTheSupply, SaysHowMuchOfTheTorqueIsGone) {
  EXPECT_THAT(
      against_supply(EditedCase().replace(viscous, "viscous = { value = \"0.2 N.m.s/rad\"")),
      IsEmpty());
  const std::string large = "viscous = { value = \"0.6 N.m.s/rad\"";
  const auto found = against_supply(EditedCase().replace(viscous, large));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].explanation, "slewing");
  EXPECT_NEAR(found[0].number("fraction of the supply torque").value, 0.47, 0.005);
  EXPECT_THAT(against_supply(EditedCase().replace(viscous, large + ", uncertainty = \"50 %\"")),
              IsEmpty())
      << "within two standard uncertainties";
}

TEST(FrictionAgainstTheSupply, SaysThatTheAntennaCannotBreakAway) {
  const auto found =
      against_supply(EditedCase().replace(breakaway, "breakaway = { value = \"400 N.m\""));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].quantity, "friction_curve.breakaway");
  EXPECT_EQ(found[0].explanation, "breakaway_beyond_supply");
  // A pressure in the wrong unit.
  const auto weak =
      against_supply(EditedCase()
                         .replace(supply_pressure, "supply_pressure = { value = \"2000 kPa\"")
                         .replace(breakaway, "breakaway = { value = \"60 N.m\""));
  ASSERT_EQ(weak.size(), 1U);
  EXPECT_EQ(weak[0].quantity, "friction_curve.breakaway");
}

TEST(FrictionAgainstTheSupply, LeavesAloneWhatTheSupplyOvercomes) {
  for (const std::string name : {"full", "paper-like"}) {
    EXPECT_THAT(failed(read_case(campaign_case(name)), "friction_against_supply"), IsEmpty())
        << name;
  }
  // 1 N.m.s/rad where the records were made with 0.125, "to be identified".
  EXPECT_EQ(failed(read_case(campaign_case("small-dish")), "friction_against_supply").size(), 1U);
}

TEST(FrictionTests, MustLieOnTheCurve) {
  const std::string check = "friction_test_line";
  EXPECT_THAT(failed(EditedCase(), check), IsEmpty());
  // Without the part that saturates the curve has neither the tests' intercept nor their slope.
  const auto found = failed(EditedCase().replace("saturating = { value = \"63.29 N.m\"",
                                                 "saturating = { value = \"0 N.m\""),
                            check);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].quantity, "friction_tests.constant_speed_coulomb");
  EXPECT_EQ(found[1].quantity, "friction_tests.constant_speed_slope");
  EXPECT_NEAR(found[0].number("least by the curve").value, 10.33, 1e-9);
  EXPECT_NEAR(found[0].number("most by the curve").value, 18.2, 0.05);
  EXPECT_GT(found[0].numbers[0].value, found[0].numbers[0].upper);
  EXPECT_NEAR(found[1].number("most by the curve").value, 2.075, 1e-9);
  const auto low =
      failed(EditedCase().replace("\"69.49 N.m\", also = \"615.00 in.lbf\"", "\"5 N.m\""), check);
  ASSERT_EQ(low.size(), 1U);
  EXPECT_EQ(low[0].quantity, "friction_tests.constant_speed_coulomb");
  EXPECT_LT(low[0].numbers[0].value, low[0].numbers[0].lower);
}

Quantity exactly(double value) {
  Quantity quantity;
  quantity.value = value;
  return quantity;
}

// Least squares through friction at a few speeds, from far below to far above the curve's rates.
FrictionTestsEntry tests_on(const plant::FrictionCurve& curve, std::mt19937_64& random) {
  std::uniform_real_distribution<double> decades(-3.0, 2.0);
  const int count = std::uniform_int_distribution<int>(2, 6)(random);
  double n = 0.0, w = 0.0, t = 0.0, ww = 0.0, wt = 0.0;
  for (int i = 0; i < count; ++i) {
    const double rate = std::pow(10.0, decades(random));
    const double torque = plant::friction_torque(curve, rate);
    n += 1.0;
    w += rate;
    t += torque;
    ww += rate * rate;
    wt += rate * torque;
  }
  FrictionTestsEntry tests;
  const double slope = (n * wt - w * t) / (n * ww - w * w);
  tests.constant_speed_slope = exactly(slope);
  tests.constant_speed_coulomb = exactly((t - slope * w) / n);
  return tests;
}

TEST(FrictionTests, DoNotContradictTheCurveAtAnySpeeds) {
  Case antenna = read_case(case_path("dss14-64m"));
  const plant::FrictionCurve curve = friction_curve(antenna);
  std::mt19937_64 random(1);
  for (int k = 0; k < 1000; ++k) {
    antenna.friction_tests = tests_on(curve, random);
    PhysicalChecks found;
    check_friction_tests(antenna, found);
    ASSERT_EQ(found.checks.size(), 2U);
    ASSERT_THAT(found.checks, Each(testing::Field(&design::PhysicalCheck::holds, true)))
        << antenna.friction_tests->constant_speed_slope->value << " "
        << antenna.friction_tests->constant_speed_coulomb->value;
  }
}

// Where friction falls with the rate, lines through tests may have a slope below 0.
TEST(FrictionTests, MayFallByHalfMoreThanTheCurve) {
  Case antenna = read_case(case_path("dss14-64m"));
  const FrictionCurveEntry& curve = *antenna.friction_curve;
  const double steepest = curve.viscous.value - std::sqrt(2.0 / std::numbers::e) *
                                                    (curve.breakaway.value - curve.coulomb.value) /
                                                    curve.stribeck_rate.value;
  ASSERT_LT(steepest, 0.0);
  antenna.friction_tests->constant_speed_slope = exactly(1.4 * steepest);
  EXPECT_THAT(failed(antenna, "friction_test_line"), IsEmpty());
  antenna.friction_tests->constant_speed_slope = exactly(1.7 * steepest);
  EXPECT_EQ(failed(antenna, "friction_test_line").size(), 1U);
}

TEST(FrictionSlope, IsHeldAgainstTheSupplyInEveryReadingOfItsUnit) {
  const Case antenna = read_case(case_path("dss14-70m"));
  const auto found = failed(antenna, "friction_slope");
  ASSERT_EQ(found.size(), 1U);
  ASSERT_EQ(found[0].numbers.size(), 2U + 3U * 4U);
  const double slope = 5.21 / (2.0 * std::numbers::pi / 60.0);
  const double slewing = 0.25 * std::numbers::pi / 180.0 * gear_ratio(antenna);
  const auto& torque = found[0].number("torque at slew rate at the motor's shaft");
  EXPECT_NEAR(torque.value, 69.49 + slope * slewing, 1e-6);
  EXPECT_EQ(torque.upper, found[0].number("supply torque").value);
  EXPECT_EQ(found[0].number("damping ratio at the motor's shaft").upper, 1.0) << "seen to ring";
  EXPECT_NEAR(found[0].number("slope if the speed is the tachometer's").value, slope * 23.0 / 130.0,
              1e-9);
  Case silent = antenna;
  silent.friction_tests->constant_speed_slope->value *= 0.01;
  EXPECT_THAT(failed(silent, "friction_slope"), IsEmpty());
}

TEST(CoulombLevels, AreApartByNoMoreThanAHalf) {
  Case antenna = read_case(case_path("dss14-70m"));
  const auto found = failed(antenna, "coulomb_levels");
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].number("factor").value, 69.49 / 19.77, 1e-9);
  antenna.friction_tests->constant_speed_coulomb->value = 1.49 * 19.77;
  EXPECT_THAT(failed(antenna, "coulomb_levels"), IsEmpty());
}

}  // namespace
}  // namespace boresight::io
