// What of friction, supply, valve, gears, pressures and sizes an audit holds against one another.
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/edited_case.hpp"
#include <boresight/app/audit/case_graph.hpp>
#include <boresight/app/audit/plausibility_checks.hpp>
#include <boresight/design/problem/drive_reach.hpp>
#include <boresight/design/problem/static_bending.hpp>
#include <boresight/io/case/antenna_of.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/mission_of.hpp>
#include <boresight/io/case/tested_drive_of.hpp>

namespace boresight::app {
namespace {

using testing::AllOf;
using testing::Each;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Ne;
using testing::Not;

const std::string viscous = "viscous = { value = \"2.075 N.m.s/rad\"";
const std::string breakaway = "breakaway = { value = \"16.83 N.m\"";
const std::string supply_pressure = "supply_pressure = { value = \"2000 psi\"";

Implausibilities found_in(const io::Case& antenna, const std::string& check) {
  Implausibilities found;
  for (const Implausibility& one : implausibilities(antenna, case_graph(antenna))) {
    if (one.check == check) found.push_back(one);
  }
  return found;
}

Implausibilities found_in(const EditedCase& edited, const std::string& check) {
  return found_in(io::parse_case(edited.text(), "case.toml"), check);
}

Implausibilities against_supply(EditedCase edited) {
  return found_in(edited, "friction against the supply");
}

std::string campaign_case(const std::string& name) {
  return BORESIGHT_SOURCE_DIR "/tests/data/campaigns/" + name + "/case.toml";
}

TEST(FrictionAgainstTheSupply, SaysThatTheSlewRateIsOutOfReach) {
  const io::Case antenna = io::read_case(case_path("dss14-70m"));
  const double slewing = 0.25 * std::numbers::pi / 180.0 * gear_ratio(antenna);
  const auto found = against_supply(EditedCase());
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].id, "friction_curve.viscous");
  EXPECT_THAT(found[0].reasoning,
              AllOf(HasSubstr("The supply cannot slew the antenna against its friction"),
                    HasSubstr("'0.25 deg/s'"), HasSubstr("'2.075 N.m.s/rad' (assumed)"),
                    HasSubstr("'2000 psi' (assumed)"), HasSubstr("the slew rate is out of reach")));
  ASSERT_EQ(found[0].numbers.size(), 4U);
  EXPECT_NEAR(found[0].numbers[1].value, 10.33 + 63.29 + 2.075 * slewing, 1e-9);
  EXPECT_NEAR(found[0].numbers[2].value, io::supply_torque(antenna), 1e-9);
  EXPECT_GT(found[0].numbers[3].value, 1.0);
}

TEST(FrictionAgainstTheSupply, SaysHowMuchOfTheTorqueIsGone) {
  EXPECT_THAT(
      against_supply(EditedCase().replace(viscous, "viscous = { value = \"0.2 N.m.s/rad\"")),
      IsEmpty());
  const std::string large = "viscous = { value = \"0.6 N.m.s/rad\"";
  const auto found = against_supply(EditedCase().replace(viscous, large));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_THAT(found[0].reasoning,
              AllOf(HasSubstr("Friction takes 47 % of the supply's torque"),
                    HasSubstr("wind and acceleration"), Not(HasSubstr("cannot"))));
  EXPECT_THAT(against_supply(EditedCase().replace(viscous, large + ", uncertainty = \"50 %\"")),
              IsEmpty())
      << "within two standard uncertainties";
}

TEST(FrictionAgainstTheSupply, SaysThatTheAntennaCannotBreakAway) {
  const auto found =
      against_supply(EditedCase().replace(breakaway, "breakaway = { value = \"400 N.m\""));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].id, "friction_curve.breakaway");
  EXPECT_THAT(found[0].reasoning,
              AllOf(HasSubstr("The supply cannot move the antenna against its friction"),
                    HasSubstr("'400 N.m'"), Not(HasSubstr("slew"))));
  // A pressure in the wrong unit.
  const auto weak =
      against_supply(EditedCase()
                         .replace(supply_pressure, "supply_pressure = { value = \"2000 kPa\"")
                         .replace(breakaway, "breakaway = { value = \"60 N.m\""));
  ASSERT_EQ(weak.size(), 1U);
  EXPECT_EQ(weak[0].id, "friction_curve.breakaway");
}

TEST(FrictionAgainstTheSupply, LeavesAloneWhatTheSupplyOvercomes) {
  for (const std::string name : {"full", "paper-like"}) {
    EXPECT_THAT(found_in(io::read_case(campaign_case(name)), "friction against the supply"),
                IsEmpty())
        << name;
  }
  // 1 N.m.s/rad where the records were made with 0.125, "to be identified".
  EXPECT_EQ(
      found_in(io::read_case(campaign_case("small-dish")), "friction against the supply").size(),
      1U);
}

TEST(FrictionTests, MustLieOnTheCurve) {
  const std::string check = "friction tests";
  EXPECT_THAT(found_in(EditedCase(), check), IsEmpty());
  // Without the part that saturates the curve has neither the tests' intercept nor their slope.
  const auto found = found_in(EditedCase().replace("saturating = { value = \"63.29 N.m\"",
                                                   "saturating = { value = \"0 N.m\""),
                              check);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].id, "friction_tests.constant_speed_coulomb");
  EXPECT_THAT(found[0].reasoning, AllOf(HasSubstr("'69.49 N.m'"), HasSubstr("10.3 and 18.2 N.m")));
  EXPECT_EQ(found[1].id, "friction_tests.constant_speed_slope");
  EXPECT_THAT(found[1].reasoning, AllOf(HasSubstr("'5.21 N.m/rpm'"), HasSubstr("2.08 N.m.s/rad")));
  const auto low =
      found_in(EditedCase().replace("\"69.49 N.m\", also = \"615.00 in.lbf\"", "\"5 N.m\""), check);
  ASSERT_EQ(low.size(), 1U);
  EXPECT_EQ(low[0].id, "friction_tests.constant_speed_coulomb");
}

io::Quantity exactly(double value) {
  io::Quantity quantity;
  quantity.value = value;
  return quantity;
}

// Least squares through friction at a few speeds, from far below to far above the curve's rates.
io::FrictionTestsEntry tests_on(const plant::FrictionCurve& curve, std::mt19937_64& random) {
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
  io::FrictionTestsEntry tests;
  const double slope = (n * wt - w * t) / (n * ww - w * w);
  tests.constant_speed_slope = exactly(slope);
  tests.constant_speed_coulomb = exactly((t - slope * w) / n);
  return tests;
}

TEST(FrictionTests, DoNotContradictTheCurveAtAnySpeeds) {
  io::Case antenna = io::read_case(case_path("dss14-64m"));
  const auto graph = case_graph(antenna);
  const CaseNumbers numbers = case_numbers(antenna, graph);
  const plant::FrictionCurve curve = io::friction_curve(antenna);
  std::mt19937_64 random(1);
  for (int k = 0; k < 1000; ++k) {
    antenna.friction_tests = tests_on(curve, random);
    Implausibilities found;
    check_friction_tests(numbers, found);
    ASSERT_THAT(found, IsEmpty()) << antenna.friction_tests.constant_speed_slope->value << " "
                                  << antenna.friction_tests.constant_speed_coulomb->value;
  }
}

// Where friction falls with the rate, lines through tests may have a slope below 0.
TEST(FrictionTests, MayFallByHalfMoreThanTheCurve) {
  io::Case antenna = io::read_case(case_path("dss14-64m"));
  const io::FrictionCurveEntry& curve = antenna.friction_curve;
  const double steepest = curve.viscous.value - std::sqrt(2.0 / std::numbers::e) *
                                                    (curve.breakaway.value - curve.coulomb.value) /
                                                    curve.stribeck_rate.value;
  ASSERT_LT(steepest, 0.0);
  antenna.friction_tests.constant_speed_slope = exactly(1.4 * steepest);
  EXPECT_THAT(found_in(antenna, "friction tests"), IsEmpty());
  antenna.friction_tests.constant_speed_slope = exactly(1.7 * steepest);
  EXPECT_EQ(found_in(antenna, "friction tests").size(), 1U);
}

// The 70-m case with a return pressure for records beside that of its simulation, 60 psi.
Implausibilities return_pressures(const std::string& recorded) {
  EditedCase edited;
  edited.replace(supply_pressure, "return_pressure = " + recorded + "\n" + supply_pressure);
  return found_in(edited, "return pressure");
}

TEST(ReturnPressures, OfRecordsAndSimulationAreOne) {
  EXPECT_THAT(found_in(EditedCase(), "return pressure"), IsEmpty());
  EXPECT_THAT(return_pressures("\"62 psi\""), IsEmpty());
  EXPECT_THAT(return_pressures("{ value = \"80 psi\", uncertainty = \"15 psi\" }"), IsEmpty());
  const auto found = return_pressures("\"600 psi\"");
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].id, "simulation.return_pressure");
  EXPECT_THAT(found[0].reasoning,
              AllOf(HasSubstr("'600 psi' by drive.return_pressure"), HasSubstr("'60 psi'"),
                    HasSubstr("one of the two is wrong")));
  const io::Case campaign = io::read_case(BORESIGHT_SOURCE_DIR "/cases/dss14-70m/campaign.toml");
  EXPECT_THAT(implausibilities(campaign, case_graph(campaign)),
              Each(testing::Field(&Implausibility::check, Ne("return pressure"))));
}

const std::string slower = "viscous = { value = \"0.20 N.m.s/rad\"";

TEST(ValveStroke, GoesAgainstFrictionAndOffset) {
  // 150 rad/s without load: 125 rad/s against the 99 N.m of friction and 6 N.m of offset are not
  // within reach.
  EditedCase edited;
  edited.replace(viscous, slower);
  const auto found = found_in(edited, "valve stroke");
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].id, "drive.slew_rate");
  EXPECT_THAT(found[0].reasoning,
              AllOf(HasSubstr("friction and offset"), HasSubstr("150 rad/s without load"),
                    HasSubstr("out of reach")));
  ASSERT_EQ(found[0].numbers.size(), 5U);
  const io::Case antenna = io::parse_case(edited.text(), "case.toml");
  const double slewing = 0.25 * std::numbers::pi / 180.0 * gear_ratio(antenna);
  EXPECT_NEAR(found[0].numbers[2].value, 10.33 + 63.29 + 0.2 * slewing + 5.65, 1e-3);
  EXPECT_NEAR(found[0].numbers[3].value, io::supply_torque(antenna) * (1.0 - 60.0 / 2000.0), 1e-9);
  // Studies find the same, but for the valve's overlap.
  const double studies = design::attainable_rate(make_nonlinear_antenna(antenna), slewing);
  EXPECT_LT(found[0].numbers[4].value, slewing);
  EXPECT_GE(found[0].numbers[4].value, studies);
  EXPECT_NEAR(found[0].numbers[4].value, studies, 0.03 * slewing);
}

TEST(ValveStroke, IsEnoughWhereTheValveIsLarger) {
  EditedCase edited;
  edited.replace(viscous, slower);
  edited.replace("valve_stroke = { value = \"150 rad/s\"",
                 "valve_stroke = { value = \"170 rad/s\"");
  EXPECT_THAT(found_in(edited, "valve stroke"), IsEmpty());
  // That no valve does is said of the friction.
  EXPECT_THAT(found_in(EditedCase(), "valve stroke"), IsEmpty());
}

TEST(StructuralShares, SayWhatASoftPartUnderTheWindMeans) {
  const std::string check = "structural shares";
  EXPECT_THAT(found_in(EditedCase(), check), IsEmpty());
  const io::Case antenna = io::parse_case(
      EditedCase()
          .replace("inertia_fraction = { value = \"0.62\"", "inertia_fraction = { value = \"0.18\"")
          .text(),
      "case.toml");
  const auto found = found_in(antenna, check);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].id, "structure.mode[0].wind_fraction");
  EXPECT_THAT(found[0].reasoning,
              AllOf(HasSubstr("a wind_fraction of 0.75 on an inertia fraction of 0.18 and a "
                              "beam_weight of 0.8 on an inertia fraction of 0.18"),
                    HasSubstr("mean wind of 10 m/s")));
  ASSERT_EQ(found[0].numbers.size(), 2U);
  EXPECT_NEAR(found[0].numbers[0].value,
              std::abs(static_bending(make_problem(antenna))) * 180e3 / std::numbers::pi, 1e-9);
  // A part under little wind bends little.
  EXPECT_LT(found[0].numbers[1].value, 0.5 * found[0].numbers[0].value);
}

// N m/rad at the antenna's axis.
double gear_train_of(const io::Case& antenna, std::size_t solution = 0) {
  return linear_plant(antennas_of(antenna).at(solution)).structure.gear_stiffness *
         std::pow(io::gear_ratio(antenna), 2);
}

// A case with the stiffness of its gear train beside its frequencies, so many times its own.
io::Case with_gear_train(EditedCase edited, double times, const std::string& uncertainty = "",
                         std::size_t solution = 0) {
  const double own = gear_train_of(io::parse_case(edited.text(), "case.toml"), solution);
  edited.replace("\ngear_damping_ratio =",
                 fmt::format("\ngear_stiffness = {{ value = \"{:.17g} N.m/rad\"{} }}"
                             "\ngear_damping_ratio =",
                             times * own, uncertainty));
  return io::parse_case(edited.text(), "case.toml");
}

TEST(GearStiffness, AgreesWithinAThirdOrItsUncertainty) {
  const std::string check = "gear stiffness";
  EXPECT_THAT(found_in(EditedCase(), check), IsEmpty());
  for (const double times : {1.0, 1.28, 1.0 / 1.28}) {
    EXPECT_THAT(found_in(with_gear_train(EditedCase(), times), check), IsEmpty());
  }
  EXPECT_EQ(found_in(with_gear_train(EditedCase(), 1.32), check).size(), 1U);
  const auto found = [&](double times, const std::string& uncertainty, bool inertia_exact) {
    io::Case antenna =
        with_gear_train(EditedCase(), times, ", uncertainty = \"" + uncertainty + "\"");
    if (inertia_exact) antenna.antenna.inertia.uncertainty_given = false;
    return found_in(antenna, check).size();
  };
  EXPECT_EQ(found(1.04, "1 %", true), 0U);
  EXPECT_EQ(found(1.06, "1 %", true), 1U);
  EXPECT_EQ(found(1.14, "5 %", true), 0U);
  EXPECT_EQ(found(1.16, "5 %", true), 1U);
  EXPECT_EQ(found(1.0 / 1.16, "5 %", true), 1U);
  // That of the inertia, 10 %, is in the plant's.
  EXPECT_EQ(found(1.29, "1 %", false), 0U);
  EXPECT_EQ(found(1.31, "1 %", false), 1U);
}

TEST(GearStiffness, IsMadeByAnotherFrequencyOfTheHeaviestMode) {
  for (const double times : {2.0, 0.5}) {
    io::Case antenna = with_gear_train(EditedCase(), times);
    const auto found = found_in(antenna, "gear stiffness");
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].id, "structure.gear_stiffness");
    ASSERT_EQ(found[0].numbers.size(), 3U);
    const double stated = found[0].numbers[0].value, frequency = found[0].numbers[2].value;
    EXPECT_NEAR(found[0].numbers[1].value / gear_train_of(antenna), 1.0, 1e-9);
    EXPECT_THAT(
        found[0].reasoning,
        AllOf(HasSubstr(fmt::format("has {:.4g} N.m/rad at the antenna's axis", stated)),
              HasSubstr(fmt::format("there {:.4g} N.m/rad and is 2 times as {}",
                                    gear_train_of(antenna), times < 1.0 ? "stiff" : "soft")),
              HasSubstr(fmt::format("(structure.mode[0].frequency) at {:.4g} Hz in the "
                                    "place of 2.4,",
                                    frequency))));
    EXPECT_EQ(frequency > 2.4, times < 1.0);
    antenna.structure.modes.at(0).frequency.value = frequency;
    EXPECT_NEAR(gear_train_of(antenna) / stated, 1.0, 1e-9);
    EXPECT_THAT(found_in(antenna, "gear stiffness"), IsEmpty());
  }
}

TEST(GearStiffness, MayBeMadeByNoFrequencyOfThatMode) {
  // Softer than with that mode rigid, and another unit.
  for (const double times : {0.4, 1e6}) {
    const auto found = found_in(with_gear_train(EditedCase(), times), "gear stiffness");
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].numbers.size(), 2U);
    EXPECT_THAT(found[0].reasoning, HasSubstr("No frequency of its heaviest mode"));
  }
}

TEST(GearStiffness, TellsWhichAntennaHasTheFrequenciesWithTheMotorsHeld) {
  EditedCase edited;
  const std::string text = edited.text();
  const std::size_t first = text.find("[[structure.mode]]");
  edited.replace(text.substr(first, text.find("\n# What a simulated test needs") - first),
                 "[[structure.mode]]\nfrequency = \"4 Hz\"\ndamping_ratio = \"0.01\"\n"
                 "inertia_fraction = \"0.2\"\nwind_fraction = \"1\"\nbeam_weight = \"0.95\"\n");
  edited.replace("lowest_predicted_axis = \"azimuth\"",
                 "lowest_predicted_axis = \"azimuth\"\nmode_frequencies = \"motors_held\"");
  EXPECT_THAT(found_in(with_gear_train(edited, 1.0), "gear stiffness"), IsEmpty());
  const auto found = found_in(with_gear_train(edited, 1.0, "", 1), "gear stiffness");
  ASSERT_EQ(found.size(), 1U);
  EXPECT_THAT(found[0].reasoning,
              AllOf(HasSubstr("Another antenna of these frequencies with the motors held"),
                    HasSubstr("with 2.103 Hz, whose motors-held modes have 0.369, 0.631")));
  EXPECT_THAT(found_in(with_gear_train(edited, 10.0), "gear stiffness").at(0).reasoning,
              HasSubstr("their fractions, antenna.inertia or the stated stiffness is wrong."));
}

TEST(InertiaAgainstTheDish, FindsAnotherUnitAndARadius) {
  const std::string check = "inertia against the dish";
  EXPECT_THAT(found_in(EditedCase(), check), IsEmpty());
  EXPECT_THAT(found_in(io::read_case(campaign_case("small-dish")), check), IsEmpty());
  const auto light =
      found_in(EditedCase().replace("2.41667e8 lbf.ft.s2", "2.41667e8 lbm.ft2"), check);
  ASSERT_EQ(light.size(), 1U);
  EXPECT_EQ(light[0].id, "antenna.inertia");
  EXPECT_THAT(light[0].reasoning, AllOf(HasSubstr("'2.41667e8 lbm.ft2'"), HasSubstr("0.0061 kg/m3"),
                                        HasSubstr("Sommerville")));
  const auto small =
      found_in(EditedCase().replace("{ value = \"70 m\"", "{ value = \"35 m\""), check);
  ASSERT_EQ(small.size(), 1U);
  EXPECT_THAT(small[0].reasoning, HasSubstr("a radius stands for the diameter"));
}

TEST(Flywheel, MustNotBurstNorOutweighTheAntenna) {
  EXPECT_THAT(found_in(EditedCase(), "flywheel"), IsEmpty());
  // 125 rad/s of the motors: 12.5 m/s at the rim, or 250 m/s.
  EditedCase usual("dss14-64m"), burst("dss14-64m");
  for (EditedCase* edited : {&usual, &burst})
    edited->replace_line("inertia = { value = \"0.17712", "");
  usual.replace_line("disk_inertia", "disk_radius = \"10 cm\"\ndisk_length = \"1 cm\"");
  burst.replace_line("disk_inertia", "disk_radius = \"2 m\"\ndisk_length = \"1 mm\"");
  EXPECT_THAT(found_in(usual, "flywheel"), IsEmpty());
  const auto found = found_in(burst, "flywheel");
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].id, "motor.disk_radius");
  EXPECT_THAT(found[0].reasoning, HasSubstr("251 m/s"));
  EXPECT_NEAR(found[0].numbers[0].value * 2.0, found[0].numbers[1].value, 1e-9);
  EXPECT_EQ(found[1].id, "motor.disk_radius");
  EXPECT_GT(found[1].numbers[0].value, 10.0 * found[1].numbers[1].value);
}

}  // namespace
}  // namespace boresight::app
