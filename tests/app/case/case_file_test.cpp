#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "io/edited_case.hpp"
#include "scratch_folder.hpp"
#include <boresight/io/case/antenna_of.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_goals.hpp>
#include <boresight/io/case/case_mechanics.hpp>
#include <boresight/io/case/case_motor.hpp>
#include <boresight/io/case/case_oil.hpp>
#include <boresight/io/case/case_pointing.hpp>
#include <boresight/io/case/case_statements.hpp>
#include <boresight/io/case/case_structure.hpp>
#include <boresight/io/case/case_tests.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/mission_of.hpp>
#include <boresight/io/case/plant_numbers.hpp>
#include <boresight/plant/antenna/antenna_change.hpp>
#include <boresight/plant/antenna/motors_held_modes.hpp>

namespace boresight::app {
namespace {

io::Case read_edited(const EditedCase& edited) {
  const ScratchFolder folder;
  return io::read_case(folder.write("case.toml", edited.text()));
}

io::Case big_antenna() {
  return io::read_case(case_path("dss14-70m"));
}

io::Case small_antenna() {
  return io::read_case(case_path("dss14-64m"));
}

TEST(CaseFile, ReadsThe70MeterAntenna) {
  const io::Case antenna = big_antenna();
  EXPECT_EQ(antenna.path, case_path("dss14-70m"));
  EXPECT_EQ(antenna.axis, "elevation");
  EXPECT_DOUBLE_EQ(antenna.antenna->dish_diameter.value, 70.0);
  EXPECT_EQ(antenna.gear_train->stages.size(), 5U);
  EXPECT_EQ(antenna.gear_train->assemblies.size(), 5U);
  EXPECT_EQ(antenna.gear_train->assemblies[3].parts.size(), 2U);
  EXPECT_EQ(antenna.motor->count, 4);
  EXPECT_EQ(antenna.motor->flywheel_disks, 24.0);
  EXPECT_EQ(antenna.oil->lines.size(), 2U);
  ASSERT_TRUE(antenna.resonance->frequency);
  EXPECT_DOUBLE_EQ(antenna.resonance->frequency->value, 0.97);
  ASSERT_TRUE(antenna.tachometer);
  EXPECT_DOUBLE_EQ(antenna.tachometer->shaft_speed.value, 20.0 * std::numbers::pi);
  EXPECT_EQ(antenna.impulse_results.size(), 2U);
  EXPECT_EQ(antenna.structure->modes.size(), 4U);
  EXPECT_EQ(antenna.structure->lowest_predicted_axis, "azimuth");
  EXPECT_EQ(antenna.bands.size(), 2U);
  EXPECT_EQ(antenna.budgets.size(), 4U);
  EXPECT_EQ(antenna.matching->disks.front(), 0.0);
  EXPECT_EQ(antenna.matching->disks.back(), 24.0);
  EXPECT_GE(antenna.stated.size(), 25U);
  EXPECT_GE(antenna.remarks.size(), 8U);
}

TEST(CaseFile, ReadsThe64MeterAntennaWithoutTests) {
  const io::Case antenna = small_antenna();
  EXPECT_DOUBLE_EQ(antenna.antenna->dish_diameter.value, 64.0);
  EXPECT_EQ(antenna.motor->flywheel_disks, 14.0);
  EXPECT_FALSE(antenna.resonance->frequency);
  EXPECT_FALSE(antenna.tachometer);
  EXPECT_FALSE(antenna.friction_tests->slow_ramp_up);
  EXPECT_TRUE(antenna.impulse_results.empty());
  EXPECT_TRUE(antenna.oil->lines.empty());
}

TEST(CaseFile, KnowsWhatEveryNumberRestsOn) {
  for (const io::Case& antenna :
       {big_antenna(), small_antenna(), io::read_case(case_path("bwg-34m")),
        io::read_case(case_path("xy-13m"))}) {
    EXPECT_GT(antenna.quantities.size(), 70U);
    const std::string text = content_of(antenna.path);
    for (const auto& quantity : antenna.quantities) {
      EXPECT_NE(quantity.source, "") << quantity.key;
      // A stated number is printed by definition; every other says what it rests on.
      if (!quantity.key.starts_with("stated")) {
        EXPECT_NE(quantity.basis, io::Basis::unstated) << quantity.key;
      }
      EXPECT_EQ(quantity.uncertainty_given, !quantity.uncertainty_source.empty()) << quantity.key;
      EXPECT_GE(quantity.standard_uncertainty, 0.0) << quantity.key;
      EXPECT_NE(text.find('"' + quantity.text + '"'), std::string::npos) << quantity.key;
      EXPECT_EQ(quantity.location.file, antenna.path);
      EXPECT_GT(quantity.location.line, 1) << quantity.key;
    }
    EXPECT_TRUE(std::is_sorted(
        antenna.quantities.begin(), antenna.quantities.end(),
        [](const auto& x, const auto& y) { return x.location.line < y.location.line; }))
        << "not in file order";
  }
}

TEST(CaseFile, CarriesUncertaintiesOfEverySort) {
  const io::Case antenna = big_antenna();
  // Relative, absolute, and by the printed digits alone.
  EXPECT_DOUBLE_EQ(antenna.motor->inertia.standard_uncertainty, 0.01 * 0.3007);
  EXPECT_DOUBLE_EQ(antenna.resonance->frequency->standard_uncertainty, 0.01);
  const io::Quantity& disk = antenna.motor->disk_inertia;
  EXPECT_FALSE(disk.uncertainty_given);
  EXPECT_NEAR(disk.standard_uncertainty, 0.5e-6 / std::sqrt(3.0), 1e-18);
  ASSERT_EQ(antenna.motor->inertia.also.size(), 1U);
  EXPECT_NEAR(antenna.motor->inertia.also[0].value, 0.30068, 1e-6);
}

TEST(CaseFile, LeavesDefaultsWhereKeysAreLeftOut) {
  EditedCase edited;
  edited.replace("efficiency_in_stiffness = true\n", "");
  edited.replace("bulk_modulus = {", "# bulk_modulus = {");
  const io::Case antenna = read_edited(edited);
  EXPECT_TRUE(antenna.oil->efficiency_in_stiffness);
  EXPECT_FALSE(antenna.oil->bulk_modulus);
  // The mean of the lines': (2 L f)^2 rho.
  const double lines = (std::pow(2 * 13.11 * 46.3, 2) + std::pow(2 * 15.60 * 38.3, 2)) / 2 * 850.0;
  EXPECT_NEAR(oil_stiffness(antenna) / oil_stiffness(big_antenna()), lines / 1229e6, 1e-12);
}

// The paper's own numbers: section II, Tables 1 and 3, section III.
TEST(AntennaModel, HasThe70MeterAntennasNumbers) {
  const io::Case antenna = big_antenna();
  EXPECT_NEAR(io::gear_ratio(antenna), 28723.647, 5e-4);
  EXPECT_NEAR(std::pow(io::gear_ratio(antenna), 2), 8.250479e8, 50.0);
  EXPECT_NEAR(gear_train_inertia(antenna), 0.21719, 5e-4);
  EXPECT_NEAR(antenna_inertia(antenna), 0.39714, 1e-5);
  ASSERT_EQ(antenna.antenna->alternatives.size(), 1U);
  EXPECT_DOUBLE_EQ(antenna_inertia(antenna, antenna.antenna->alternatives[0]), 0.356047);
  EXPECT_NEAR(oil_stiffness(antenna), 52.6, 0.05);
}

TEST(AntennaModel, AddsDisksToEveryMotor) {
  const io::Case antenna = big_antenna();
  EXPECT_DOUBLE_EQ(motor_inertia(antenna, 24.0), 4 * 0.3007);
  EXPECT_NEAR(motor_inertia(antenna, 14.0), 4 * 0.17712, 1e-12);
  EXPECT_NEAR(motor_inertia(antenna, 0.0), 4 * 0.004108, 1e-12);
  EXPECT_NEAR(motor_inertia(antenna, 12.5), 4 * (0.004108 + 12.5 * 0.012358), 1e-12);
  EXPECT_DOUBLE_EQ(motor_inertia(small_antenna(), 14.0), 4 * 0.17712);
}

TEST(AntennaModel, FindsTheDisksOfRatioOne) {
  const io::Case antenna = big_antenna();
  const double load = gear_train_inertia(antenna) + antenna_inertia(antenna);
  const auto disks = disks_at_unit_ratio(antenna, load);
  ASSERT_TRUE(disks);
  EXPECT_NEAR(*disks, 12.09, 0.005);
  EXPECT_NEAR(motor_inertia(antenna, *disks), load, 1e-12);
  const auto other =
      disks_at_unit_ratio(antenna, gear_train_inertia(antenna) +
                                       antenna_inertia(antenna, antenna.antenna->alternatives[0]));
  ASSERT_TRUE(other);
  EXPECT_NEAR(*other, 11.26, 0.005);
  EXPECT_FALSE(disks_at_unit_ratio(antenna, 0.01)) << "would take fewer disks than none";
}

TEST(AntennaModel, BuildsItsPlantFromTheCase) {
  const io::Case antenna = big_antenna();
  const auto plant = make_plant(antenna);
  EXPECT_NEAR(plant::reflected_inertia(plant),
              4 * 0.3007 + gear_train_inertia(antenna) + antenna_inertia(antenna), 1e-12);
  EXPECT_DOUBLE_EQ(plant.drive.leakage_rate, 1.219);
  EXPECT_DOUBLE_EQ(plant.drive.valve_corner, 2 * std::numbers::pi * 12.0);
  // A choice changes what it names and keeps the structure's frequencies.
  const auto lighter = make_plant(antenna, {plant::set_to("at_shaft.antenna_inertia", 0.2),
                                            plant::set_to("at_shaft.oil_stiffness", 60.0)});
  EXPECT_NEAR(plant::antenna_inertia(lighter.structure), 0.2, 1e-12);
  EXPECT_DOUBLE_EQ(lighter.drive.oil_stiffness, 60.0);
  EXPECT_DOUBLE_EQ(lighter.drive.motor_inertia, plant.drive.motor_inertia);
  const auto held = plant::motors_held_modes(plant.structure);
  const auto held_lighter = plant::motors_held_modes(lighter.structure);
  ASSERT_EQ(held_lighter.size(), held.size());
  for (std::size_t i = 0; i < held.size(); ++i) {
    EXPECT_NEAR(held_lighter[i].frequency, held[i].frequency, 1e-9);
  }
  EXPECT_NEAR(lighter.structure.gear_stiffness / plant.structure.gear_stiffness,
              0.2 / antenna_inertia(antenna), 1e-12);
  // As a case with that inertia has it.
  io::Case other = antenna;
  other.antenna->inertia.value *= 0.2 / antenna_inertia(antenna);
  EXPECT_NEAR(make_plant(other).structure.modes[0].stiffness, lighter.structure.modes[0].stiffness,
              1e-9 * lighter.structure.modes[0].stiffness);
}

/// The 70-m case in other units, by factors that are exact by definition.
EditedCase in_other_units() {
  constexpr double inch = 0.0254, foot = 0.3048, pound = 0.45359237;
  constexpr double pound_force = pound * 9.80665;
  constexpr double psi = pound_force / (inch * inch);
  constexpr double cubic_inch = inch * inch * inch * 1e6;  // cm3
  constexpr double turn = 2.0 * std::numbers::pi;
  EditedCase edited;
  // The number of `old`, in a unit that is `factor` of the old one.
  const auto change = [&edited](const std::string& old, double factor, const std::string& unit) {
    edited.replace("value = \"" + old + "\"",
                   fmt::format("value = \"{:.17g} {}\"", std::stod(old) / factor, unit));
  };
  change("70 m", 1e3, "km");
  change("2.41667e8 lbf.ft.s2", foot * pound / pound_force, "lbm.ft2");
  change("1.5876 kg.m2", pound * foot * foot, "lbm.ft2");
  change("0.3007 kg.m2", pound_force * foot, "lbf.ft.s2");
  change("38.329 cm3/rev", cubic_inch * 360.0, "in3/deg");
  change("0.938", 0.01, "%");
  change("850 kg/m3", pound / (foot * foot * foot), "lbm/ft3");
  change("1229 MPa", psi / 1e6, "psi");
  change("0.02455 m3", 231.0 * cubic_inch * 1e-6, "US_gal");
  change("13.11 m", foot, "ft");
  change("46.3 Hz", 1.0 / turn, "rad/s");
  change("0.97 Hz", 1.0 / 60.0, "rpm");
  change("1.219 1/s", 1.0 / 60.0, "1/min");
  change("0.9 N.m.s/rad", pound_force * foot * 60.0 / turn, "lbf.ft/rpm");
  change("12 Hz", 1.0 / 360.0, "deg/s");
  change("2000 psi", 1e5 / psi, "bar");
  change("15 arcsec/s", 3600.0, "deg/s");
  change("10.33 N.m", pound_force * inch, "in.lbf");
  change("2.0 Hz", 1e3, "kHz");
  change("2.4 Hz", 1e3, "kHz");
  change("0.1 mdeg", 1.0 / 3.6, "arcsec");
  change("0.03 s", 1e-3, "ms");
  change("10 m/s", 1609.344 / 3600.0, "mile/h");
  change("1.1 kg/m3", pound_force / foot / (foot * foot * foot), "slug/ft3");
  change("8.4 GHz", 1e-3, "MHz");
  change("2 mdeg", 180.0 / std::numbers::pi, "mrad");
  return edited;
}

void expect_equal(double value, double expected, const char* name) {
  EXPECT_NEAR(value, expected, 1e-12 * std::abs(expected)) << name;
}

TEST(CaseFile, MeansTheSameInAnyUnits) {
  const io::Case metric = big_antenna(), mixed = read_edited(in_other_units());
  ASSERT_EQ(metric.quantities.size(), mixed.quantities.size());
  std::size_t rewritten = 0;
  for (std::size_t i = 0; i < metric.quantities.size(); ++i) {
    const io::Quantity &one = metric.quantities[i], &other = mixed.quantities[i];
    EXPECT_EQ(one.key, other.key);
    EXPECT_EQ(one.source, other.source);
    EXPECT_EQ(one.basis, other.basis);
    expect_equal(other.value, one.value, one.key.c_str());
    if (one.uncertainty_given) {
      expect_equal(other.standard_uncertainty, one.standard_uncertainty, one.key.c_str());
    }
    rewritten += one.text != other.text ? 1 : 0;
  }
  EXPECT_EQ(rewritten, 26U);

  const auto plant = make_plant(metric), same = make_plant(mixed);
  expect_equal(same.drive.oil_stiffness, plant.drive.oil_stiffness, "oil stiffness");
  expect_equal(same.drive.motor_inertia, plant.drive.motor_inertia, "motor inertia");
  expect_equal(same.drive.leakage_rate, plant.drive.leakage_rate, "leakage");
  expect_equal(same.drive.viscous_friction, plant.drive.viscous_friction, "friction");
  expect_equal(same.drive.valve_corner, plant.drive.valve_corner, "valve");
  expect_equal(same.structure.gear_stiffness, plant.structure.gear_stiffness, "gear spring");
  for (std::size_t i = 0; i < plant.structure.modes.size(); ++i) {
    expect_equal(same.structure.modes[i].stiffness, plant.structure.modes[i].stiffness, "mode");
  }
  expect_equal(io::tracking_friction(mixed), io::tracking_friction(metric), "tracking friction");
  const auto problem = make_problem(metric), alike = make_problem(mixed);
  expect_equal(alike.noise.encoder_rms, problem.noise.encoder_rms, "encoder noise");
  expect_equal(alike.delay, problem.delay, "delay");
  const auto budgets = make_budgets(metric), equal = make_budgets(mixed);
  for (std::size_t i = 0; i < budgets.size(); ++i) {
    expect_equal(equal[i].rms, budgets[i].rms, budgets[i].name.c_str());
  }
}

}  // namespace
}  // namespace boresight::app
