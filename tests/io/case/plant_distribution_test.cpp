#include <cmath>

#include <gtest/gtest.h>

#include <boresight/design/ensembles/plant_distribution.hpp>
#include <boresight/io/case/antenna_of.hpp>
#include <boresight/io/case/case_drive.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_mechanics.hpp>
#include <boresight/io/case/case_motor.hpp>
#include <boresight/io/case/case_structure.hpp>
#include <boresight/io/case/case_wind.hpp>
#include <boresight/io/case/member_ranges.hpp>
#include <boresight/io/case/mission_of.hpp>
#include <boresight/io/case/plant_numbers.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/normal_numbers.hpp>

namespace boresight::io {
namespace {

const Case& reference() {
  static const Case antenna = read_case(BORESIGHT_SOURCE_DIR "/cases/dss14-70m/case.toml");
  return antenna;
}

std::size_t place(design::UncertainInput input) {
  return static_cast<std::size_t>(input);
}

TEST(PlantDistribution, OfRangesKeepsToThem) {
  const auto distribution = design::PlantDistribution::of_ranges(mission_of(reference()));
  const design::MemberRanges ranges = member_ranges(reference());
  double mean = 0.0, log_square = 0.0;
  constexpr std::uint64_t count = 20000;
  for (std::uint64_t i = 0; i < count; ++i) {
    const design::PlantSample draw = distribution.draw(7, i);
    const double oil = draw[design::UncertainInput::oil_stiffness];
    ASSERT_GE(oil, ranges.oil_stiffness.lower);
    ASSERT_LE(oil, ranges.oil_stiffness.upper);
    mean += oil / count;
    log_square += std::pow(std::log(draw[design::UncertainInput::antenna_inertia]), 2) / count;
  }
  const double width = ranges.oil_stiffness.upper - ranges.oil_stiffness.lower;
  EXPECT_NEAR(mean, 0.5 * (ranges.oil_stiffness.lower + ranges.oil_stiffness.upper),
              4.0 * width / std::sqrt(12.0 * count));
  const auto& inertia = reference().antenna->inertia;
  const double relative = inertia.standard_uncertainty / inertia.value;
  EXPECT_NEAR(std::sqrt(log_square), relative, 4.0 * relative / std::sqrt(2.0 * count));
}

TEST(PlantDistribution, FractionsAreThoseOfTheSamples) {
  // Of every input a quarter of the samples lies below the value at the fraction 0.25.
  const auto distribution = design::PlantDistribution::of_ranges(mission_of(reference()));
  const auto quarter =
      distribution.at_fractions(std::vector<double>(distribution.inputs().size(), 0.25));
  constexpr std::uint64_t count = 20000;
  for (const design::UncertainInput input : distribution.inputs()) {
    double below = 0.0;
    for (std::uint64_t i = 0; i < count; ++i) {
      below += distribution.draw(3, i)[input] < quarter[input] ? 1.0 / count : 0.0;
    }
    EXPECT_NEAR(below, 0.25, 4.0 * std::sqrt(0.1875 / count)) << to_string(input);
  }
}

// Samples of a known lognormal distribution with a correlation come back from their fit.
TEST(PlantDistribution, OfRecordsHasTheirCovariance) {
  const numerics::NormalNumbers normals(11);
  const double motors = motor_inertia(reference(), reference().motor->flywheel_disks);
  const double rest = motors + gear_train_inertia(reference());
  std::vector<identification::DriveEstimate> records;
  constexpr double of_oil = 0.02, of_inertia = 0.03, correlation = 0.8;
  for (std::uint64_t i = 0; i < 4000; ++i) {
    const auto pair = normals.pair(i);
    const double other =
        correlation * pair.real() + std::sqrt(1.0 - correlation * correlation) * pair.imag();
    identification::DriveEstimate draw;
    draw.motor_inertia = motors;
    draw.inertia = rest + antenna_inertia(reference()) * std::exp(of_inertia * other);
    draw.oil_stiffness = oil_stiffness(reference()) * std::exp(of_oil * pair.real());
    draw.leakage_rate = reference().drive->leakage_rate.value;
    draw.lowest_frequency = reference().structure->locked_rotor_frequency.value;
    records.push_back(draw);
  }
  const auto distribution = design::PlantDistribution::of_records(mission_of(reference()), records);
  EXPECT_EQ(distribution.inputs(), (std::vector{design::UncertainInput::oil_stiffness,
                                                design::UncertainInput::friction_slope,
                                                design::UncertainInput::antenna_inertia}));
  double oil = 0.0, inertia = 0.0, product = 0.0;
  constexpr std::uint64_t count = 20000;
  for (std::uint64_t i = 0; i < count; ++i) {
    const design::PlantSample draw = distribution.draw(5, i);
    const double x = std::log(draw[design::UncertainInput::oil_stiffness]);
    const double y = std::log(draw[design::UncertainInput::antenna_inertia]);
    oil += x * x / count;
    inertia += y * y / count;
    product += x * y / count;
  }
  EXPECT_NEAR(std::sqrt(oil) / of_oil, 1.0, 0.05);
  EXPECT_NEAR(std::sqrt(inertia) / of_inertia, 1.0, 0.05);
  EXPECT_NEAR(product / std::sqrt(oil * inertia), correlation, 0.03);
}

// What the records show of friction slope and valve is drawn about the identified antenna; what
// they do not is left to the ranges of the case.
TEST(PlantDistribution, OfRecordsHasTheirFrictionSlopeAndValve) {
  const numerics::NormalNumbers normals(12);
  const double motors = motor_inertia(reference(), reference().motor->flywheel_disks);
  const double slope = reference().drive->viscous_friction.value;
  std::vector<identification::DriveEstimate> records;
  constexpr double of_slope = 0.01, of_lag = 0.05;
  for (std::uint64_t i = 0; i < 4000; ++i) {
    const auto pair = normals.pair(i);
    identification::DriveEstimate draw;
    draw.motor_inertia = motors;
    draw.inertia = motors + gear_train_inertia(reference()) + antenna_inertia(reference());
    draw.oil_stiffness = oil_stiffness(reference());
    draw.leakage_rate = 5.0 * reference().drive->leakage_rate.value;  // a guess
    draw.lowest_frequency = reference().structure->locked_rotor_frequency.value;
    draw.tracking_slope = slope * std::exp(of_slope * pair.real());
    draw.valve_lag = 0.01 * std::exp(of_lag * pair.imag());
    records.push_back(draw);
  }
  identification::IdentifiedParts parts;
  parts.leakage_rate = false;
  parts.friction_slope = parts.valve_lag = true;
  const design::Mission mission = mission_of(reference());
  const auto distribution = design::PlantDistribution::of_records(mission, records, parts);
  EXPECT_EQ(distribution.inputs(), (std::vector{design::UncertainInput::leakage_rate,
                                                design::UncertainInput::friction_slope,
                                                design::UncertainInput::valve_frequency}));
  double mean = 0.0, square = 0.0, valve = 0.0;
  constexpr std::uint64_t count = 20000;
  const design::Ends& leakage = mission.uncertainty.ranges.leakage_rate;
  for (std::uint64_t i = 0; i < count; ++i) {
    const design::PlantSample draw = distribution.draw(5, i);
    const double log = std::log(draw[design::UncertainInput::friction_slope] / slope);
    mean += log / count;
    square += log * log / count;
    valve += std::pow(std::log(draw[design::UncertainInput::valve_frequency]), 2) / count;
    const double rate =
        draw[design::UncertainInput::leakage_rate] * reference().drive->leakage_rate.value;
    EXPECT_GE(rate, leakage.lower * (1.0 - 1e-12));
    EXPECT_LE(rate, leakage.upper * (1.0 + 1e-12));
  }
  EXPECT_NEAR(mean, 0.0, 0.05 * of_slope);
  EXPECT_NEAR(std::sqrt(square) / of_slope, 1.0, 0.05);
  EXPECT_NEAR(std::sqrt(valve) / of_lag, 1.0, 0.05);
  design::PlantSample draw = distribution.median();
  draw.values.at(place(design::UncertainInput::valve_frequency)) = 1.25;
  EXPECT_NEAR(make_plant(reference(), changes_of(draw)).drive.valve_corner,
              1.25 * make_plant(reference()).drive.valve_corner, 1e-9);
}

TEST(PlantDistribution, AFactorOfOneIsTheCase) {
  design::PlantSample draw;
  draw.values.at(place(design::UncertainInput::friction_slope)) =
      reference().drive->viscous_friction.value;
  const auto own = make_plant(reference());
  const auto drawn = make_plant(reference(), changes_of(draw));
  EXPECT_EQ(drawn.drive.oil_stiffness, own.drive.oil_stiffness);
  EXPECT_EQ(drawn.drive.motor_inertia, own.drive.motor_inertia);
  EXPECT_DOUBLE_EQ(plant::reflected_inertia(drawn), plant::reflected_inertia(own));
  draw.values.at(place(design::UncertainInput::structure_frequency)) = 1.1;
  EXPECT_NEAR(make_plant(reference(), changes_of(draw)).structure.gear_stiffness,
              1.21 * own.structure.gear_stiffness, 1e-12 * own.structure.gear_stiffness);
}

// Two stated uncertainties together, and no other number of a draw moves.
TEST(PlantDistribution, DrawsTheWindTorqueByItsStatedUncertainties) {
  Case windy = reference();
  windy.wind->torque_coefficient.uncertainty_given = true;
  windy.wind->torque_coefficient.standard_uncertainty = 0.2 * windy.wind->torque_coefficient.value;
  windy.wind->air_density.uncertainty_given = true;
  windy.wind->air_density.standard_uncertainty = 0.05 * windy.wind->air_density.value;
  const auto calm = design::PlantDistribution::of_ranges(mission_of(reference()));
  const auto distribution = design::PlantDistribution::of_ranges(mission_of(windy));
  EXPECT_EQ(calm.inputs().size() + 1, distribution.inputs().size());
  EXPECT_EQ(distribution.inputs().back(), design::UncertainInput::wind_torque);
  double square = 0.0;
  constexpr std::uint64_t count = 20000;
  for (std::uint64_t i = 0; i < count; ++i) {
    design::PlantSample draw = distribution.draw(7, i);
    square += std::pow(std::log(draw[design::UncertainInput::wind_torque]), 2) / count;
    draw.values.at(place(design::UncertainInput::wind_torque)) = 1.0;
    ASSERT_EQ(draw.values, calm.draw(7, i).values);
  }
  const double relative = std::hypot(0.2, 0.05);
  EXPECT_NEAR(std::sqrt(square), relative, 4.0 * relative / std::sqrt(2.0 * count));
}

// The sequence of the six inputs of the plant, whatever else is drawn.
TEST(PlantDistribution, KeepsTheSequenceOfItsSamples) {
  const auto ranges = member_ranges(reference());
  const auto distribution = design::PlantDistribution::of_ranges(mission_of(reference()));
  const std::uint64_t stream = numerics::splitmix64(7, 0x5eed0001);
  for (std::uint64_t i = 0; i < 5; ++i) {
    const double fraction =
        (static_cast<double>(numerics::splitmix64(stream, 6 * i + 1) >> 12U) + 0.5) * 0x1p-52;
    EXPECT_DOUBLE_EQ(distribution.draw(7, i)[design::UncertainInput::oil_stiffness],
                     ranges.oil_stiffness.lower +
                         fraction * (ranges.oil_stiffness.upper - ranges.oil_stiffness.lower));
  }
}

TEST(PlantDistribution, AWindTorqueIsThatOfThePlant) {
  design::PlantSample draw = design::PlantDistribution::of_ranges(mission_of(reference())).median();
  const auto calm = make_plant(reference(), changes_of(draw)).structure;
  draw.values.at(place(design::UncertainInput::wind_torque)) = 1.2;
  const auto windy = make_plant(reference(), changes_of(draw)).structure;
  EXPECT_EQ(windy.bull_gear_wind_fraction, 1.2 * calm.bull_gear_wind_fraction);
  for (std::size_t i = 0; i < calm.modes.size(); ++i) {
    EXPECT_EQ(windy.modes[i].wind_fraction, 1.2 * calm.modes[i].wind_fraction);
    EXPECT_EQ(windy.modes[i].stiffness, calm.modes[i].stiffness);
  }
}

TEST(PlantDistribution, RefusesWhatIsNoShare) {
  const auto distribution = design::PlantDistribution::of_ranges(mission_of(reference()));
  EXPECT_THROW(distribution.at_fractions({0.5}), InvalidInput);
  EXPECT_THROW(distribution.at_fractions(std::vector<double>(distribution.inputs().size(), 1.0)),
               InvalidInput);
  EXPECT_THROW(design::PlantDistribution::of_records(mission_of(reference()), {}), InvalidInput);
}

}  // namespace
}  // namespace boresight::io
