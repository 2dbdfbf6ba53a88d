#include <cmath>

#include <gtest/gtest.h>

#include "design/studies/demo_mission.hpp"
#include <boresight/design/studies/measured_tuning_study.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/normal_numbers.hpp>
#include <boresight/plant/linear/sampling.hpp>

namespace boresight::design {
namespace {

using Eigen::Index;

// The sweep, with steady motion before and behind it.
constexpr double step = 0.01, settle = 8.0, sweep = 90.0, length = 100.0;
constexpr Index samples = 10000;

identification::DriveKnowledge drawings_of(const plant::Antenna& antenna) {
  identification::DriveKnowledge k;
  const auto& oil = antenna.hydraulics;
  const auto within = [](double value) { return numerics::Uncertain{value, 0.005 * value}; };
  k.motor_count = oil.motor_count;
  k.motor_inertia = within(antenna.flywheels.motor_inertia);
  k.gear_inertia = within(gear_train_inertia(antenna));
  k.antenna_inertia = within(antenna_inertia(antenna));
  k.displacement = within(oil.displacement);
  k.torque_efficiency = within(oil.torque_efficiency);
  k.volumetric_efficiency = within(oil.volumetric_efficiency);
  k.oil_density = within(850.0);
  k.volume_1 = within(oil.volume_1);
  k.volume_2 = within(oil.volume_2);
  k.locked_rotor_frequencies = {within(antenna.structure.locked_rotor_frequency)};
  k.supply_pressure = antenna.drive.supply_pressure;
  k.return_pressure = 0.4e6;
  k.tracking_rate = plant::sky_to_motor(antenna, antenna.drive.tracking_rate);
  return k;
}

struct Chirp {
  identification::Campaign campaign;
  Eigen::VectorXd encoder;  // rad of motor
  identification::DriveRecord record;
};

// The linear antenna turning steadily, its valve swept from 0.1 Hz to 8 Hz: sampled exactly, as the
// valve is held from sample to sample, with a tenth of the sensors' noise.
Chirp chirp_of(const plant::Antenna& antenna) {
  const auto system = plant::sample(to_state_space(linear_plant(antenna)), step);
  const Index tachometer = output_index(system, "tachometer"),
              torque = output_index(system, "motor_torque"),
              encoder = output_index(system, "encoder");
  constexpr double bias = 14.0, lowest = 0.1, highest = 8.0;
  const double octaves = std::log(highest / lowest);
  Eigen::VectorXd state = Eigen::VectorXd::Zero(system.a.rows());
  for (int k = 0; k < 3000; ++k) state = (system.a * state + system.b.col(0) * bias).eval();
  Eigen::VectorXd command(samples), rate(samples), pressure(samples);
  Chirp chirp;
  chirp.campaign = {drawings_of(antenna), {}, {}};
  chirp.encoder.resize(samples);
  const auto& knowledge = chirp.campaign.knowledge;
  const double per_torque =
      1.0 / (identification::torque_per_pressure(knowledge) * knowledge.motor_count);
  const numerics::NormalNumbers numbers(3);
  for (Index k = 0; k < samples; ++k) {
    const double into = step * static_cast<double>(k) - settle;
    const double cycles = lowest * sweep / octaves * std::expm1(octaves * into / sweep);
    command[k] = bias + (into >= 0.0 && into < sweep ? 2.0 * std::sin(two_pi * cycles) : 0.0);
    const Eigen::VectorXd seen = system.c * state + system.d.col(0) * command[k];
    const auto noise = numbers.pair(static_cast<std::uint64_t>(k));
    rate[k] = seen[tachometer] + 0.1 * antenna.sensors.tachometer_noise * noise.real();
    pressure[k] = per_torque * (seen[torque] + 0.1 * antenna.sensors.torque_noise * noise.imag());
    chirp.encoder[k] = seen[encoder];
    state = (system.a * state + system.b.col(0) * command[k]).eval();
  }
  auto& record = chirp.record;
  record.name = "chirp";
  record.test = identification::TestKind::valve_chirp;
  record.sample_time = step;
  const auto motors = static_cast<std::size_t>(knowledge.motor_count);
  const double middle = 0.5 * (knowledge.supply_pressure + knowledge.return_pressure);
  record.inlet_pressure.assign(motors, {(middle + 0.5 * pressure.array()).matrix(), {}});
  record.outlet_pressure.assign(motors, {(middle - 0.5 * pressure.array()).matrix(), {}});
  record.motor_rate = {rate, {}};
  record.valve_command = identification::Signal{command, {}};
  return chirp;
}

MeasuredTuningOptions at_most(int starts) {
  MeasuredTuningOptions options;
  options.starts = starts;
  if (starts == 1) options.stop = [] { return true; };
  return options;
}

TEST(StudyMeasuredTuning, AControllerOfAChirpHoldsOnThePlantThatWasRecorded) {
  const Mission mission = reference::demo_mission();
  const Chirp chirp = chirp_of(mission.antenna);
  const auto study =
      study_measured_tuning(mission, chirp.campaign, chirp.record, chirp.encoder,
                            {{"PI", control::LoopStructure::named("PI")}}, at_most(4));
  EXPECT_TRUE(study.encoder_recorded);
  // The oil gives way to the friction's torque: a little slower than asked for.
  EXPECT_LT(study.mean_rate, 14.0);
  EXPECT_GT(study.mean_rate, 13.0);
  EXPECT_LT(study.start + study.length, length + step);
  EXPECT_LT(study.lowest_excited, 0.15);
  EXPECT_NEAR(study.highest_excited, 8.0, 0.5);
  EXPECT_EQ(study.gear_ratio, gear_ratio(mission.antenna));
  EXPECT_EQ(study.wind_speed, mission.wind.mean_speed);
  EXPECT_FALSE(study.other_goals);
  const double stiffness = oil_stiffness(mission.antenna);
  EXPECT_NEAR(study.oil.stiffness, stiffness, 0.1 * stiffness);
  ASSERT_TRUE(study.channels.has_value());
  EXPECT_NEAR(study.channels->low_end_inertia(), reflected_inertia(linear_plant(mission.antenna)),
              0.1);

  ASSERT_EQ(study.controllers.size(), 1U);
  EXPECT_TRUE(study.any_confident());
  EXPECT_EQ(study.controllers[0].structure, "PI");
  EXPECT_TRUE(study.controllers[0].stable_on_case);
  for (const double peak : study.controllers[0].peaks_on_case) EXPECT_LT(peak, 2.1);
}

TEST(StudyMeasuredTuning, TakesTheEncodersAngleFromTheStructureWhereNoneIsRecorded) {
  Mission mission = reference::demo_mission();
  mission.stated_constraints.bandwidth = 0.1;
  const Chirp chirp = chirp_of(mission.antenna);
  const auto at = [&](const std::optional<Eigen::VectorXd>& encoder) {
    return study_measured_tuning(mission, chirp.campaign, chirp.record, encoder, {}, at_most(1));
  };
  const auto recorded = at(chirp.encoder), assumed = at(std::nullopt);
  EXPECT_FALSE(assumed.encoder_recorded);
  EXPECT_TRUE(assumed.other_goals);
  // Of the same structure, so it is the same angle.
  for (const double hertz : {0.3, 0.7, 1.5}) {
    const auto measured = recorded.channels->at(two_pi * hertz).encoder_command;
    const auto by_structure = assumed.channels->at(two_pi * hertz).encoder_command;
    EXPECT_LT(std::abs(by_structure - measured), 0.1 * std::abs(measured)) << hertz;
  }
}

TEST(StudyMeasuredTuning, ReturnsWhatItHasOnceItIsStopped) {
  const Mission mission = reference::demo_mission();
  const Chirp chirp = chirp_of(mission.antenna);
  const auto study = study_measured_tuning(mission, chirp.campaign, chirp.record, chirp.encoder,
                                           mission.structures.loops, at_most(1));
  EXPECT_TRUE(study.controllers.empty());
  EXPECT_FALSE(study.any_confident());
  EXPECT_TRUE(study.channels.has_value());
}

TEST(StudyMeasuredTuning, RefusesWhatShowsNoResponse) {
  const Mission mission = reference::demo_mission();
  const Chirp chirp = chirp_of(mission.antenna);
  const auto study_of = [&](const identification::DriveRecord& record,
                            const std::optional<Eigen::VectorXd>& encoder) {
    return study_measured_tuning(mission, chirp.campaign, record, encoder, {}, at_most(1));
  };
  auto closed = chirp.record;
  closed.rate_loop_closed = true;
  EXPECT_THROW(study_of(closed, std::nullopt), InvalidInput);
  auto without = chirp.record;
  without.valve_command.reset();
  EXPECT_THROW(study_of(without, std::nullopt), InvalidInput);
  EXPECT_THROW(study_of(chirp.record, chirp.encoder.head(100)), InvalidInput);
  // Nine seconds one way at most, of which the first two do not count.
  auto turning = chirp.record;
  for (Index k = 0; k < samples; ++k) {
    if (k % 1800 >= 900) turning.motor_rate.values[k] *= -1.0;
  }
  EXPECT_THROW(study_of(turning, std::nullopt), NumericalFailure);
}

}  // namespace
}  // namespace boresight::design
