#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "io/one_record.hpp"
#include <boresight/design/ensembles/fixed_gain_evaluator.hpp>
#include <boresight/design/tuning/tuner.hpp>
#include <boresight/io/campaign/campaign_identification.hpp>
#include <boresight/io/campaign/designed_antenna.hpp>
#include <boresight/io/campaign/recommended_values.hpp>
#include <boresight/io/case/antenna_of.hpp>
#include <boresight/io/case/case_campaign.hpp>
#include <boresight/io/case/case_drive.hpp>
#include <boresight/io/case/case_structure.hpp>
#include <boresight/io/case/case_tuning.hpp>
#include <boresight/io/case/mission_of.hpp>
#include <boresight/plant/antenna/motors_held_modes.hpp>
#include <boresight/plant/antenna/moved_held_modes.hpp>
#include <boresight/plant/nonlinear/drive_capability.hpp>

namespace boresight::io {
namespace {

using plant::set_to;

nlohmann::json truth() {
  std::ifstream file(folder_of("full") + "/truth.json");
  return nlohmann::json::parse(file);
}

double true_slope(double rate) {
  const auto friction = truth()["friction"];
  const plant::FrictionCurve curve{friction["Fc"], friction["Fs"], friction["vs"],
                                   friction["A"],  friction["v1"], friction["b"]};
  return plant::friction_slope(curve, rate);
}

// A case that guesses leakage, friction, valve and structure otherwise than the antenna has them,
// with four of its records.
struct Designed {
  Case stated = [] {
    Case full = case_of("full");
    std::erase_if(full.campaign->records, [](const RecordEntry& entry) {
      return entry.name != "constant_speed_0.5V" && entry.name != "constant_speed_4V" &&
             entry.name != "valve_steps" && entry.name != "valve_chirp";
    });
    return full;
  }();
  CampaignSection section = identify_campaign(stated, {});
  DesignedAntenna antenna = designed_antenna(stated, section, 1);
};

const Designed& designed() {
  static const Designed antenna;
  return antenna;
}

const SupersededInput& superseded(const std::string& key) {
  const auto& inputs = designed().antenna.superseded;
  const auto found = std::ranges::find(inputs, key, &SupersededInput::key);
  if (found == inputs.end()) throw InvalidInput("not superseded: " + key);
  return *found;
}

// Within three standard uncertainties, which are to be small.
void expect_superseded(const std::string& key, double value, double largest_fraction) {
  const SupersededInput& input = superseded(key);
  EXPECT_TRUE(input.assumed) << key;
  EXPECT_GT(input.standard_uncertainty, 0.0) << key;
  EXPECT_LT(input.standard_uncertainty, largest_fraction * value) << key;
  EXPECT_NEAR(input.value, value, 3.0 * input.standard_uncertainty) << key;
}

TEST(IdentifiedPlant, HasTheSlopeLeakageAndValveOfTheRecords) {
  const plant::Antenna& antenna = designed().antenna.mission.antenna;
  const double slope = true_slope(designed().section.knowledge.tracking_rate);
  EXPECT_GT(slope, 10.0 * designed().stated.drive->viscous_friction.value);
  expect_superseded("drive.viscous_friction", slope, 0.02);
  expect_superseded("drive.leakage_rate", truth()["leakage_rate_1_per_s"], 0.1);
  expect_superseded("drive.valve_frequency", truth()["valve"]["frequency_Hz"], 0.3);
  EXPECT_EQ(antenna.drive.viscous_friction, superseded("drive.viscous_friction").value);
  EXPECT_EQ(antenna.drive.valve_frequency, superseded("drive.valve_frequency").value);
  // The linear plant has the slope of the nonlinear antenna's curve.
  EXPECT_NEAR(plant::tracking_friction(antenna), antenna.drive.viscous_friction, 1e-9);
}

TEST(IdentifiedPlant, HasEachLockedRotorFrequencyOfTheRecords) {
  const auto plant = linear_plant(designed().antenna.mission.antenna);
  const auto held = plant::motors_held_modes(plant.structure);
  const std::vector<double> frequencies = truth()["locked_rotor_frequencies_Hz"];
  for (std::size_t j = 0; j < 3; ++j) {
    EXPECT_NEAR(held.at(j).frequency, frequencies.at(j), 0.005 * frequencies.at(j)) << j;
    EXPECT_GT(std::abs(designed().section.knowledge.locked_rotor_frequencies.at(j).value -
                       frequencies.at(j)),
              0.01 * frequencies.at(j));
  }
}

TEST(IdentifiedPlant, IsDrawnFromWhatTheRecordsLeaveOpen) {
  const auto& antenna = designed().antenna;
  ASSERT_EQ(antenna.ensemble.members.size(), 30U);
  const double slope = true_slope(designed().section.knowledge.tracking_rate);
  double minimum = slope, largest = slope;
  const auto& slewing = antenna.ensemble.members.back();
  EXPECT_EQ(slewing.name, "friction slope at the slew rate");
  const plant::Antenna& nominal = antenna.mission.antenna;
  const double at_slew = true_slope(plant::sky_to_motor(nominal, nominal.drive.slew_rate));
  EXPECT_NEAR(slewing.plant.drive.viscous_friction, at_slew, 0.05 * at_slew);
  for (const auto& member : antenna.ensemble.members) {
    if (&member == &slewing) continue;
    minimum = std::min(minimum, member.plant.drive.viscous_friction);
    largest = std::max(largest, member.plant.drive.viscous_friction);
  }
  EXPECT_GT(minimum, 0.93 * slope);
  EXPECT_LT(largest, 1.07 * slope);
  EXPECT_LT(minimum, largest);
  EXPECT_TRUE(antenna.distribution.varies(design::UncertainInput::valve_frequency));
}

// The plant of guessed friction and valve is farther from it.
TEST(IdentifiedPlant, PredictsTheRmsOfTheTrueAntenna) {
  const design::Mission& mission = designed().antenna.mission;
  const design::Mission guessed = mission_of(designed().stated);
  plant::Antenna antenna = changed(
      mission.antenna,
      {set_to("at_shaft.motor_inertia", truth()["inertia_motors_and_flywheels"]),
       set_to("at_shaft.gear_train_inertia", truth()["inertia_gears"]),
       set_to("at_shaft.antenna_inertia", truth()["inertia_antenna_reflected"]),
       set_to("at_shaft.oil_stiffness", truth()["hydraulic_stiffness"]),
       set_to("drive.leakage_rate", truth()["leakage_rate_1_per_s"]),
       set_to("drive.viscous_friction", true_slope(designed().section.knowledge.tracking_rate)),
       set_to("drive.valve_frequency", truth()["valve"]["frequency_Hz"])});

  // The records show three; the others keep their proportion to the lowest.
  std::vector<std::optional<double>> frequencies;
  for (std::size_t j = 0; j < 3; ++j) {
    frequencies.emplace_back(truth()["locked_rotor_frequencies_Hz"][j]);
  }
  const auto moved =
      plant::with_motors_held_frequencies(structure_specification(guessed.antenna), frequencies);
  ASSERT_TRUE(moved);
  antenna.structure.locked_rotor_frequency = moved->locked_rotor_frequency;
  antenna.structure.modes = moved->modes;

  const design::TrackingProblem problem = tracking_problem(mission);
  const design::Constraints goals = constraints(mission);
  design::TuningOptions options;
  options.starts = 4;
  const auto tuned = design::tune(problem, loop_structure(designed().stated, "PI"), goals, options);
  ASSERT_EQ(tuned.status, design::TuningStatus::optimal);
  design::FixedGainEvaluator evaluator(problem, tuned.controller, goals);
  const auto rms = [&](const plant::Antenna& one) {
    const auto values = evaluator.evaluate(linear_plant(one));
    return std::sqrt(values.wind_variance + values.noise_variance);
  };
  const double expected = rms(antenna);
  EXPECT_NEAR(rms(mission.antenna), expected, 0.04 * expected);
  EXPECT_GT(std::abs(rms(guessed.antenna) - expected), 0.05 * expected);
}

TEST(IdentifiedPlant, LeavesWhatTheRecordsDoNotSayToTheCase) {
  for (const auto* key : {"structure.mode[0].damping_ratio", "wind.torque_coefficient",
                          "structure.mode[0].wind_fraction", "sensors.encoder_noise"}) {
    EXPECT_FALSE(is_superseded(designed().antenna.superseded, key)) << key;
  }
  const Case& antenna = designed().antenna.antenna;
  EXPECT_EQ(antenna.structure->modes[0].wind_fraction.value,
            designed().stated.structure->modes[0].wind_fraction.value);
  // A number that the case vouches for better than the records stays.
  Case vouched = designed().stated;
  vouched.drive->leakage_rate.basis = Basis::measured;
  vouched.drive->leakage_rate.uncertainty_given = true;
  vouched.drive->leakage_rate.standard_uncertainty = 1e-3;
  const auto parts = taken_parts(vouched, *designed().section.grey_box);
  EXPECT_FALSE(parts.leakage_rate);
  EXPECT_TRUE(parts.friction_slope);
  EXPECT_TRUE(taken_parts(designed().stated, *designed().section.grey_box).leakage_rate);
}

}  // namespace
}  // namespace boresight::io
