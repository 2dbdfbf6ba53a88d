// What follows from a proposal's changes, and changes that contradict one another.
#include <array>
#include <numbers>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/edited_case.hpp"
#include "refused_call.hpp"
#include <boresight/io/case/antenna_of.hpp>
#include <boresight/io/case/case_campaign.hpp>
#include <boresight/io/case/case_drive.hpp>
#include <boresight/io/case/case_goals.hpp>
#include <boresight/io/case/case_mechanics.hpp>
#include <boresight/io/case/case_motor.hpp>
#include <boresight/io/case/case_oil.hpp>
#include <boresight/io/case/case_sensors.hpp>
#include <boresight/io/case/case_simulation.hpp>
#include <boresight/io/case/case_structure.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/member_ranges.hpp>
#include <boresight/io/case/mission_of.hpp>
#include <boresight/io/case/plant_numbers.hpp>
#include <boresight/io/case/structure_numbers.hpp>
#include <boresight/io/proposals/proposed_case.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/antenna/antenna_change.hpp>
#include <boresight/plant/antenna/motors_held_modes.hpp>

namespace boresight::io {
namespace {

using ::testing::HasSubstr;

const std::string head = "name = 'a'\ndescription = 'b'\n[cost]\namount = 1\ncurrency = 'kUSD'\n";

const Case& as_is() {
  static const Case antenna = read_case(case_path("dss14-70m"));
  return antenna;
}

ProposedCase of(const Case& antenna, const std::string& text) {
  return apply_proposal(antenna, parse_proposal(head + text, "p.toml"));
}

ProposedCase with(const std::string& text) {
  return of(as_is(), text);
}

enum class Fractions { of_inertia, effective };

// The same antenna by its modes with the motors held.
Case by_motors_held(Fractions fractions) {
  Case antenna = as_is();
  const auto held = plant::motors_held_modes(make_plant(antenna).structure);
  antenna.structure->motors_held = true;
  for (std::size_t i = 0; i < antenna.structure->modes.size(); ++i) {
    StructureModeEntry& mode = antenna.structure->modes[i];
    mode.frequency.value = held.at(i + 1).frequency;
    if (fractions == Fractions::of_inertia) continue;
    mode.effective_fraction = mode.inertia_fraction;
    mode.effective_fraction->value = held.at(i + 1).inertia_fraction;
  }
  return antenna;
}

std::string refusal(const std::string& text) {
  try {
    with(text);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "accepted";
}

// The case with its valve stated by the rated flow.
Case by_rated_flow() {
  EditedCase edited;
  edited.replace("\nvalve_stroke = {", "\n# valve_stroke = {")
      .replace("valve_damping = {",
               "valve_rated_flow = \"160 L/min\"\nvalve_rated_pressure_drop = \"7 MPa\"\n"
               "valve_damping = {");
  return parse_case(edited.text(), case_path("dss14-70m"));
}

double leakage(const Case& antenna) {
  return antenna.drive->leakage_rate.value;
}

const DerivedChange* find(const ProposedCase& proposed, const std::string& quantity) {
  for (const auto& one : proposed.derived_quantities) {
    if (one.quantity == quantity) return &one;
  }
  return nullptr;
}

TEST(ProposedCase, LeakageRateFollowsVolumesAndBulkModulus) {
  const Case volumes =
      with("[oil]\nvolume_1 = { factor = '0.5' }\nvolume_2 = { factor = '0.25' }\n").antenna;
  const auto& oil = *as_is().oil;
  const double sides = (2.0 / oil.volume_1.value + 4.0 / oil.volume_2.value) /
                       (1.0 / oil.volume_1.value + 1.0 / oil.volume_2.value);
  EXPECT_NEAR(leakage(volumes) / leakage(as_is()), sides, 1e-12);
  EXPECT_NEAR(oil_stiffness(volumes) / oil_stiffness(as_is()), sides, 1e-12);
  const Case stiff = with("[oil]\nbulk_modulus = { factor = '1.3' }\n").antenna;
  EXPECT_NEAR(leakage(stiff) / leakage(as_is()), 1.3, 1e-12);
  for (const Case* one : {&volumes, &stiff}) {
    EXPECT_NEAR(oil_stiffness(*one) / leakage(*one), oil_stiffness(as_is()) / leakage(as_is()),
                1e-10);
  }
}

TEST(ProposedCase, StatedLeakageIsTheChangedDrives) {
  const Case stated =
      with("[oil]\nbulk_modulus = { factor = '1.3' }\n[drive]\nleakage_rate = '2 1/s'\n").antenna;
  EXPECT_DOUBLE_EQ(leakage(stated), 2.0);
  // A factor is one on the hardware's coefficient, on top of what follows.
  const Case factor =
      with("[oil]\nbulk_modulus = { factor = '1.3' }\n[drive]\nleakage_rate = { factor = '0.5' }\n")
          .antenna;
  EXPECT_NEAR(leakage(factor) / leakage(as_is()), 0.65, 1e-12);
}

TEST(ProposedCase, DisplacementChangesAllThatPressureAndFlowDo) {
  const auto proposed = with("[motor]\ndisplacement = { factor = '1.41' }\n");
  const Case& larger = proposed.antenna;
  EXPECT_NEAR(oil_stiffness(larger) / oil_stiffness(as_is()), 1.41 * 1.41, 1e-12);
  EXPECT_NEAR(supply_torque(larger) / supply_torque(as_is()), 1.41, 1e-12);
  EXPECT_DOUBLE_EQ(leakage(larger), leakage(as_is()));
  EXPECT_NEAR(larger.sensors->torque_noise->value / as_is().sensors->torque_noise->value, 1.41,
              1e-12);
  EXPECT_NEAR(larger.simulation->valve_stroke.value / as_is().simulation->valve_stroke.value,
              1.0 / 1.41, 1e-12);
  EXPECT_NEAR(larger.goals->control_effort.value / as_is().goals->control_effort.value, 1.0 / 1.41,
              1e-12);
  ASSERT_NE(find(proposed, "oil stiffness K"), nullptr);
  EXPECT_THAT(find(proposed, "oil stiffness K")->follows_from, HasSubstr("D^2"));
  ASSERT_NE(find(proposed, "leakage damper K/lambda"), nullptr);
  EXPECT_EQ(find(proposed, "leakage rate"), nullptr);
}

TEST(ProposedCase, MoreMotorsCountInEverything) {
  const Case more = with("[motor]\ncount = 8\n").antenna;
  EXPECT_NEAR(oil_stiffness(more) / oil_stiffness(as_is()), 4.0, 1e-12);
  EXPECT_NEAR(supply_torque(more) / supply_torque(as_is()), 2.0, 1e-12);
  EXPECT_NEAR(motor_inertia(more, 24) / motor_inertia(as_is(), 24), 2.0, 1e-12);
  EXPECT_NEAR(gear_train_inertia(more) / gear_train_inertia(as_is()), 2.0, 1e-12);
  EXPECT_NEAR(leakage(more) / leakage(as_is()), 2.0, 1e-12);
}

TEST(ProposedCase, GearRatioChangesEveryReflection) {
  const auto proposed = with("[[gear_train.stage]]\nnumber = 5\ndriven_teeth = '1508'\n");
  const Case& geared = proposed.antenna;
  EXPECT_NEAR(gear_ratio(geared) / gear_ratio(as_is()), 2.0, 1e-12);
  EXPECT_NEAR(antenna_inertia(geared) / antenna_inertia(as_is()), 0.25, 1e-12);
  // All bodies stand before the last stage.
  EXPECT_NEAR(gear_train_inertia(geared) / gear_train_inertia(as_is()), 1.0, 1e-12);
  const auto before = make_problem(as_is()), after = make_problem(geared);
  EXPECT_NEAR(after.noise.encoder_rms / before.noise.encoder_rms, 2.0, 1e-12);
  EXPECT_NEAR(after.noise.tachometer_rms / before.noise.tachometer_rms, 1.0, 1e-12);
  // The gear spring turns with the antenna: its frequency with the rotor locked stays.
  EXPECT_NEAR(after.plant.structure.gear_stiffness / before.plant.structure.gear_stiffness, 0.25,
              1e-9);
  const Eigen::ArrayXd frequency = Eigen::ArrayXd::Constant(1, 1.0);
  EXPECT_NEAR(design::motor_wind_spectrum(after, frequency)(0) /
                  design::motor_wind_spectrum(before, frequency)(0),
              0.25, 1e-9);
  EXPECT_NEAR(geared.simulation->backlash->value / as_is().simulation->backlash->value, 2.0, 1e-12);
  EXPECT_NEAR(geared.simulation->offset_torque.value / as_is().simulation->offset_torque.value, 0.5,
              1e-12);
  EXPECT_LT(tracking_friction(geared), tracking_friction(as_is()));
  for (const char* quantity : {"slew rate at the motor", "tracking rate at the motor",
                               "friction level at the sky", "encoder noise at the motor"}) {
    ASSERT_NE(find(proposed, quantity), nullptr) << quantity;
    EXPECT_NEAR(find(proposed, quantity)->after / find(proposed, quantity)->before, 2.0, 1e-12)
        << quantity;
  }
}

TEST(ProposedCase, FirstStageLeavesTheMotorsAlone) {
  const Case geared = with("[[gear_train.stage]]\nnumber = 1\ndriven_teeth = '268'\n").antenna;
  const auto& assemblies = as_is().gear_train->assemblies;
  const double at_motors =
      static_cast<double>(assemblies.back().count) * assemblies.back().inertia->value;
  EXPECT_NEAR(gear_train_inertia(geared) - at_motors,
              0.25 * (gear_train_inertia(as_is()) - at_motors), 1e-12);
}

TEST(ProposedCase, FlywheelsChangeTheMotorsInertiaOnly) {
  const Case bare = with("[motor]\nflywheel_disks = 0\n").antenna;
  const auto& motor = *as_is().motor;
  EXPECT_NEAR(motor_inertia(bare, bare.motor->flywheel_disks), motor_inertia(as_is(), 0.0), 1e-12);
  EXPECT_NEAR(bare.motor->inertia.value, motor.inertia.value - 24.0 * motor.disk_inertia.value,
              1e-12);
  EXPECT_DOUBLE_EQ(oil_stiffness(bare), oil_stiffness(as_is()));
  const auto plant = make_plant(bare),
             own = make_plant(as_is(), {plant::set_to("motor.flywheel_disks", 0.0)});
  EXPECT_NEAR(plant.drive.motor_inertia, own.drive.motor_inertia, 1e-12);
}

TEST(ProposedCase, LinesCarryTheirFractionOfTheVolumes) {
  const Case near = with("[oil]\nline_lengths = { factor = '0.1' }\nline_share = '0.9'\n").antenna;
  EXPECT_NEAR(near.oil->volume_1.value / as_is().oil->volume_1.value, 0.19, 1e-12);
  EXPECT_NEAR(leakage(near) / leakage(as_is()), 1.0 / 0.19, 1e-9);
  // The lines' pressure waves are faster, the oil the same.
  EXPECT_NEAR(
      near.oil->lines[0].slosh_frequency.value / as_is().oil->lines[0].slosh_frequency.value, 10.0,
      1e-12);
  EXPECT_NEAR(bulk_modulus(near), bulk_modulus(as_is()), 1e-3);
}

TEST(ProposedCase, PressureFeedsTheValve) {
  const Case strong = with("[drive]\nsupply_pressure = { factor = '1.5' }\n").antenna;
  EXPECT_NEAR(supply_torque(strong) / supply_torque(as_is()), 1.5, 1e-12);
  const double returned = as_is().simulation->return_pressure.value;
  const double supply = as_is().drive->supply_pressure.value;
  EXPECT_NEAR(strong.simulation->valve_stroke.value / as_is().simulation->valve_stroke.value,
              std::sqrt((1.5 * supply - returned) / (supply - returned)), 1e-12);
}

TEST(ProposedCase, RatedFlowDoesWhatTheStrokeDoes) {
  const Case antenna = by_rated_flow();
  const auto by_stroke = of(antenna, "[simulation]\nvalve_stroke = { factor = '2' }\n");
  for (const std::string flow : {"'320 L/min'", "{ factor = '2' }"}) {
    const auto by_flow = of(antenna, "[drive]\nvalve_rated_flow = " + flow + "\n");
    EXPECT_NEAR(by_flow.antenna.simulation->valve_stroke.value,
                by_stroke.antenna.simulation->valve_stroke.value, 1e-9);
    for (const char* quantity : {"valve stroke, no-load motor rate", "control effort allowed",
                                 "slew rate at the sky within the stroke"}) {
      const auto* found = find(by_flow, quantity);
      ASSERT_NE(found, nullptr) << quantity;
      EXPECT_NEAR(found->after / found->before, 2.0, 1e-12) << quantity;
    }
    EXPECT_EQ(by_flow.derived_quantities.size(), 3U);
    ASSERT_EQ(by_flow.changes.size(), 1U);
    EXPECT_EQ(by_flow.changes[0].before, "160 L/min");
  }
  // A stroke that the case states beside the flow scales with it.
  Case both = antenna;
  both.simulation->valve_stroke.value = 150.0;
  EXPECT_NEAR(
      of(both, "[drive]\nvalve_rated_flow = '80 L/min'\n").antenna.simulation->valve_stroke.value,
      75.0, 1e-9);
}

// As a case of those numbers has it.
TEST(ProposedCase, RatedFlowGoesWithDisplacementAndPressure) {
  const std::string text =
      "[motor]\ndisplacement = { factor = '1.41' }\n"
      "[drive]\nvalve_rated_flow = '320 L/min'\nsupply_pressure = { factor = '1.5' }\n";
  Case antenna = by_rated_flow();
  for (const bool simulated : {true, false}) {
    if (!simulated) {
      antenna.campaign->return_pressure = antenna.simulation->return_pressure;
      antenna.simulation.reset();
    }
    const Case after = of(antenna, text).antenna;
    EXPECT_NEAR(largest_demand(after) / rated_stroke(after).value().value, 1.0, 1e-12);
    EXPECT_NEAR(after.goals->control_effort.value / antenna.goals->control_effort.value,
                largest_demand(after) / largest_demand(antenna), 1e-12);
  }
}

TEST(ProposedCase, RefusesARatedFlowThatTheCaseHasNot) {
  const std::string flow = "[drive]\nvalve_rated_flow = '80 US_gal/min'\n";
  const std::string told = refusal(flow);
  EXPECT_THAT(told, HasSubstr("p.toml:7:20: drive.valve_rated_flow: expected a number that the "
                              "case has, found none of it in "));
  EXPECT_THAT(told, testing::EndsWith(": change simulation.valve_stroke instead"));
  Case linear = as_is();
  linear.simulation.reset();
  EXPECT_THAT(reference::Call([&] { of(linear, flow); }),
              testing::ThrowsMessage<InvalidInput>(
                  testing::EndsWith(": state it there, with valve_rated_pressure_drop")));
  EXPECT_THAT(
      reference::Call([&] { of(by_rated_flow(), "[drive]\nvalve_rated_flow = '160 L/min'\n"); }),
      testing::ThrowsMessage<InvalidInput>(HasSubstr("found that every change leaves")));
}

TEST(ProposedCase, SamplingSetsDeadTimeAndNoiseBandwidth) {
  const Case fast = with("[controller]\nsample_rate = '200 Hz'\n").antenna;
  EXPECT_NEAR(fast.controller->delay.value, 1.5 / 200.0, 1e-15);
  EXPECT_NEAR(fast.sensors->noise_bandwidth.value, 100.0, 1e-12);
}

TEST(ProposedCase, StatedRangesOfTheEnsembleFollow) {
  EditedCase edited;
  const Case ranged = parse_case(
      edited.text() + "[ensemble]\nleakage_rate = { lower = '0.5 1/s', upper = '1.5 1/s' }\n",
      case_path("dss14-70m"));
  const auto proposed = apply_proposal(
      ranged, parse_proposal(head + "[oil]\nbulk_modulus = { factor = '2' }\n", "p"));
  const auto before = member_ranges(ranged), after = member_ranges(proposed.antenna);
  EXPECT_NEAR(after.leakage_rate.lower / before.leakage_rate.lower, 2.0, 1e-12);
  EXPECT_NEAR(after.leakage_rate.upper / before.leakage_rate.upper, 2.0, 1e-12);
}

TEST(ProposedCase, StifferGearLeavesTheStructureOnIt) {
  for (const Case& antenna :
       {as_is(), by_motors_held(Fractions::of_inertia), by_motors_held(Fractions::effective)}) {
    const auto before = make_plant(antenna).structure;
    for (const std::string factor : {"0.5", "1.1", "5"}) {
      const auto proposed =
          of(antenna, "[structure]\ngear_stiffness = { factor = '" + factor + "' }\n");
      const auto after = make_plant(proposed.antenna).structure;
      const double times = std::stod(factor);
      EXPECT_NEAR(after.gear_stiffness / before.gear_stiffness, times, 1e-9 * times);
      EXPECT_NEAR(after.bull_gear_inertia / before.bull_gear_inertia, 1.0, 1e-9);
      ASSERT_EQ(after.modes.size(), before.modes.size());
      for (std::size_t i = 0; i < after.modes.size(); ++i) {
        EXPECT_NEAR(after.modes[i].stiffness / before.modes[i].stiffness, 1.0, 1e-9);
        EXPECT_NEAR(after.modes[i].inertia / before.modes[i].inertia, 1.0, 1e-9);
        EXPECT_NEAR(after.modes[i].damping / before.modes[i].damping, 1.0, 1e-9);
        EXPECT_DOUBLE_EQ(after.modes[i].wind_fraction, before.modes[i].wind_fraction);
        EXPECT_DOUBLE_EQ(after.modes[i].beam_weight, before.modes[i].beam_weight);
      }
      EXPECT_DOUBLE_EQ(proposed.antenna.structure->gear_damping_ratio.value,
                       antenna.structure->gear_damping_ratio.value);
      const auto* spring = find(proposed, "gear spring Kg at the motors");
      ASSERT_NE(spring, nullptr);
      EXPECT_NEAR(spring->before, before.gear_stiffness, 1e-9 * before.gear_stiffness);
      EXPECT_NEAR(spring->after, after.gear_stiffness, 1e-9 * after.gear_stiffness);
      const auto* locked = find(proposed, "locked-rotor frequency");
      ASSERT_NE(locked, nullptr);
      EXPECT_NEAR(locked->after, plant::motors_held_modes(after).front().frequency, 1e-6);
      EXPECT_EQ(find(proposed, "lowest mode with the bull gear held"), nullptr);
      ASSERT_EQ(proposed.changes.size(), 1U);
      EXPECT_THAT(proposed.changes[0].before, HasSubstr(" N.m/rad by the locked-rotor frequency"));
    }
  }
}

TEST(ProposedCase, StifferGearComesOnTopOfWhatFollows) {
  const Case of_high_inertia =
      with(
          "[antenna]\ninertia = { factor = '1.2' }\n[structure]\ngear_stiffness = { factor = '1.1' "
          "}\n")
          .antenna;
  EXPECT_NEAR(make_plant(of_high_inertia).structure.gear_stiffness /
                  make_plant(as_is()).structure.gear_stiffness,
              1.1 * 1.2, 1e-9);
}

// In other terms a number is as uncertain for its size, and says as much of where it is from.
TEST(ProposedCase, StifferGearKeepsWhatNumbersSayOfThemselves) {
  Case antenna = by_motors_held(Fractions::effective);
  Quantity& second = antenna.structure->modes.at(1).frequency;
  second.standard_uncertainty = 0.03 * second.value;
  second.uncertainty_given = true;
  const auto& structure =
      of(antenna, "[structure]\ngear_stiffness = { factor = '1.1' }\n").antenna.structure;
  EXPECT_FALSE(structure->motors_held);
  const auto& mode = structure->modes.at(1);
  EXPECT_FALSE(mode.effective_fraction);
  EXPECT_LT(mode.frequency.value, second.value);
  EXPECT_NEAR(relative_uncertainty(mode.frequency), 0.03, 1e-12);
  EXPECT_TRUE(mode.frequency.uncertainty_given);
  EXPECT_EQ(mode.frequency.source, second.source);
  EXPECT_EQ(mode.inertia_fraction.basis, second.basis);
}

TEST(ProposedCase, SaysWhatFrequenciesDoToTheGearSpring) {
  const char* spring = "gear spring Kg at the motors";
  const char* lowest = "lowest mode with the bull gear held";
  const Case held = by_motors_held(Fractions::effective);
  for (const char* key : {"locked_rotor_frequency", "mode_frequencies"}) {
    const std::string text = std::string("[structure]\n") + key + " = { factor = '1.05' }\n";
    for (const Case& antenna : {as_is(), held}) {
      const auto proposed = of(antenna, text);
      const auto* found = find(proposed, spring);
      ASSERT_NE(found, nullptr) << key;
      EXPECT_EQ(found->unit, "N.m/rad");
      EXPECT_NEAR(found->before, make_plant(antenna).structure.gear_stiffness,
                  1e-9 * found->before);
      EXPECT_NEAR(found->after, make_plant(proposed.antenna).structure.gear_stiffness,
                  1e-9 * found->after);
      EXPECT_EQ(find(proposed, "locked-rotor frequency"), nullptr) << key;
      const auto* mode = find(proposed, lowest);
      ASSERT_EQ(mode != nullptr, antenna.structure->motors_held) << key;
      if (mode == nullptr) continue;
      EXPECT_NEAR(mode->before, 2.4, 1e-6);
      EXPECT_NEAR(mode->after,
                  structure_specification(*proposed.antenna.structure).modes.at(0).frequency, 1e-9);
    }
  }
  for (const Case& antenna : {as_is(), held}) {
    const auto proposed = of(antenna, "[antenna]\ninertia = { factor = '1.2' }\n");
    const auto* found = find(proposed, spring);
    ASSERT_NE(found, nullptr);
    EXPECT_NEAR(found->after / found->before, 1.2, 1e-9);
    EXPECT_EQ(find(proposed, lowest), nullptr);
  }
}

TEST(ProposedCase, RefusesContradictions) {
  const std::array<std::pair<const char*, const char*>, 21> refusals{{
      {"[motor]\nflywheel_disks = 12\ninertia = '0.3007 kg.m2'\n",
       "p.toml:8:11: motor.inertia: expected the 0.1524 kg.m2 that 12 disks make of the case's "
       "motor, within 1 %, found 0.3007 kg.m2: motor.flywheel_disks and its parts contradict it"},
      {"[motor]\ncount = { factor = 0.3 }\n", "motor.count: expected a whole number of motors"},
      {"[motor]\ndisplacement = { factor = 0 }\n", "motor.displacement: expected a result"},
      {"[oil]\nline_lengths = { factor = 0.1 }\n",
       "oil.line_lengths: expected line_share (the fraction of each volume that is lines) or "
       "the volumes beside it, found neither"},
      {"[oil]\nline_lengths = { factor = 0.1 }\nvolume_1 = '0.02 m3'\n",
       "expected both volumes beside it, found no oil.volume_2"},
      {"[oil]\nline_lengths = { factor = 0.5 }\nvolume_1 = '0.03 m3'\nvolume_2 = '0.02 m3'\n",
       "oil.volume_1: expected 0.01227 to 0.02455 m3, all that lines of 0.5 times the length can "
       "make of 0.02455 m3, found 0.03 m3: oil.line_lengths contradicts it"},
      {"[oil]\nline_lengths = { factor = 0.5 }\nline_share = 0.5\nvolume_1 = '0.02 m3'\n",
       "oil.line_share: expected either line_share, from which the volumes follow, or volume_1 and "
       "volume_2, found both"},
      {"[[gear_train.stage]]\nnumber = 6\ndriven_teeth = 100\n",
       "expected a stage from 1 to 5, the case's, found 6"},
      {"[[gear_train.stage]]\nnumber = 1\ndriven_teeth = { factor = 1.41 }\n",
       "expected a whole number of teeth, found 188.94"},
      {"[[gear_train.assembly]]\nname = 'J6'\ninertia = '1 kg.m2'\n",
       "expected an assembly of the case ('J1', 'J2', 'J3', 'J4', 'Jct'), found 'J6'"},
      {"[structure]\nmode_frequencies = { factor = 0.8 }\n",
       "structure.mode_frequencies: expected a locked-rotor frequency below every mode"},
      {"[structure]\nlocked_rotor_frequency = '3 Hz'\n",
       "structure.locked_rotor_frequency: expected a locked-rotor frequency below every mode"},
      {"[structure]\nmode_damping_ratios = { factor = 200 }\n",
       "structure.mode_damping_ratios: expected a result from 0 to 1, found 2"},
      {"[structure]\ngear_stiffness = { factor = 0 }\n",
       "structure.gear_stiffness: expected a factor above 0, found 0"},
      {"[structure]\ngear_stiffness = { factor = 2 }\nlocked_rotor_frequency = '2.1 Hz'\n",
       "structure.gear_stiffness: expected either gear_stiffness, from which the "
       "locked-rotor frequency follows, or locked_rotor_frequency, found both"},
      {"[controller]\nsample_rate = '10 Hz'\n",
       "controller.sample_rate: expected a sampling of at least 12.4 Hz, twice the fastest mode of "
       "the structure (6.2 Hz), found 10 Hz"},
      {"[controller]\ndelay = '0.2 s'\n",
       "controller.delay: expected a sampling of at least 12.4 Hz, twice the fastest mode of the "
       "structure (6.2 Hz), found 7.5 Hz by the delay of one and a half samples"},
      {"[controller]\nsample_rate = '20 Hz'\ndelay = '0.02 s'\n",
       "controller.delay: expected at least the 0.025 s that holding a sample takes"},
      {"[drive]\nsupply_pressure = '50 psi'\n",
       "drive.supply_pressure: expected more than simulation.return_pressure"},
      {"[friction_curve]\nbreakaway = '5 N.m'\n",
       "friction_curve.breakaway: expected friction_curve.breakaway of at least "
       "friction_curve.coulomb, found 5 N.m and 10.33 N.m"},
      {"", "name: expected a proposal that changes something, found no change and no structures"},
  }};
  for (const auto& [text, expected] : refusals) {
    EXPECT_THAT(refusal(text), HasSubstr(expected)) << text;
  }
}

TEST(ProposedCase, RefusesToChangeNothingInManyWords) {
  for (const char* text :
       {"[motor]\nflywheel_disks = 24\n", "[motor]\ndisplacement = { factor = 1 }\n",
        "[motor]\ncount = 4\n", "[drive]\nvalve_damping = 0.7\n",
        "[structure]\ngear_stiffness = { factor = 1 }\n",
        "[[gear_train.stage]]\nnumber = 1\ndriven_teeth = 134\n",
        "[controller]\nsample_rate = '50 Hz'\n"}) {
    EXPECT_THAT(refusal(text),
                HasSubstr("found that every change leaves the case's number as it is"))
        << text;
  }
}

TEST(ProposedCase, RefusesStructuresAndNumbersThatTheCaseHasNot) {
  const auto proposal = parse_proposal("structures = ['PIDD']\n" + head, "p.toml");
  try {
    apply_proposal(as_is(), proposal);
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(),
                HasSubstr("p.toml:1:14: structures: expected loop structures, found 'PIDD'"));
  }
  const Case small = read_case(case_path("dss14-64m"));
  try {
    apply_proposal(small, parse_proposal(head + "[simulation]\nvalve_stroke = '100 rad/s'\n", "p"));
    if (!small.simulation) FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(),
                HasSubstr("simulation.valve_stroke: expected a number that the case has"));
  }
}

}  // namespace
}  // namespace boresight::io
