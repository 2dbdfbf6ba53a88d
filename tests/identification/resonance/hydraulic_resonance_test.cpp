#include <cmath>
#include <complex>
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "refused_call.hpp"
#include <boresight/identification/resonance/hydraulic_resonance.hpp>
#include <boresight/identification/resonance/ring_inertia.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/normal_numbers.hpp>
#include <boresight/plant/antenna/hydraulics.hpp>

namespace boresight::identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using testing::HasSubstr;
using testing::ThrowsMessage;

// A linear drive: oil spring and loss, motors, a load of one mode behind a spring.
//   dT/dt = K (q - w) - lambda T,  Jm dw/dt = T - B w - c (w - v) - k x,  dx/dt = w - v,
//   Jl dv/dt = c (w - v) + k x.
struct LinearDrive {
  double stiffness = 52.0, loss = 1.1, friction = 2.3;
  double motor_side = 1.4, load = 0.38, locked = 2.05, load_damping = 0.012;

  double inertia() const { return motor_side + load; }
  double spring() const { return load * std::pow(two_pi * locked, 2); }
  double damper() const { return 2.0 * load_damping * load * two_pi * locked; }

  MatrixXd matrix() const {
    MatrixXd a(4, 4);
    const double k = spring(), c = damper();
    a << -loss, -stiffness, 0.0, 0.0,                                                     //
        1.0 / motor_side, -(friction + c) / motor_side, -k / motor_side, c / motor_side,  //
        0.0, 1.0, 0.0, -1.0,                                                              //
        0.0, c / load, k / load, -c / load;
    return a;
  }

  // Undamped natural frequency (Hz) of the lowest oscillation.
  double frequency() const {
    double lowest = 1e300;
    const auto values = numerics::eigenvalues(matrix());
    for (const auto& value : values) {
      if (value.imag() > 0.0) lowest = std::min(lowest, std::abs(value) / two_pi);
    }
    return lowest;
  }

  DriveRecord record(const std::function<double(double)>& flow, double length, double noise) const {
    constexpr double dt = 0.005;
    constexpr int inner = 4;
    const auto samples = static_cast<Index>(length / dt);
    const numerics::NormalNumbers numbers(31);
    DriveRecord result;
    result.sample_time = dt;
    Signal inlet, outlet, command;
    inlet.values.resize(samples);
    outlet.values.resize(samples);
    command.values.resize(samples);
    result.motor_rate.values.resize(samples);
    const MatrixXd a = matrix();
    VectorXd x = VectorXd::Zero(4);
    const auto slope = [&](const VectorXd& state, double t) {
      VectorXd change = a * state;
      change(0) += stiffness * flow(t);
      return change;
    };
    for (Index i = 0; i < samples; ++i) {
      const auto pair = numbers.pair(static_cast<std::uint64_t>(i));
      const double per_port = (x(0) + 0.3 * noise * pair.real()) / (2.0 * torque_per_difference);
      inlet.values(i) = 10.2e6 + per_port;
      outlet.values(i) = 10.2e6 - per_port;
      result.motor_rate.values(i) = x(1) + 0.02 * noise * pair.imag();
      command.values(i) = flow(static_cast<double>(i) * dt);
      for (int step = 0; step < inner; ++step) {
        const double h = dt / inner, t = static_cast<double>(i) * dt + h * step;
        const VectorXd k1 = slope(x, t), k2 = slope(x + 0.5 * h * k1, t + 0.5 * h),
                       k3 = slope(x + 0.5 * h * k2, t + 0.5 * h), k4 = slope(x + h * k3, t + h);
        x += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
      }
    }
    result.inlet_pressure = {inlet};
    result.outlet_pressure = {outlet};
    result.valve_command = command;
    return result;
  }

  static constexpr double torque_per_difference = 2.0e-5;

  Campaign campaign() const {
    Campaign result;
    auto& knowledge = result.knowledge;
    knowledge.motor_count = 1.0;
    knowledge.motor_inertia = {motor_side - 0.2, 0.005};
    knowledge.gear_inertia = {0.2, 0.01};
    knowledge.antenna_inertia = {load, 0.05};
    knowledge.displacement = {torque_per_difference, 0.002 * torque_per_difference};
    knowledge.torque_efficiency = {1.0, 0.003};
    knowledge.volumetric_efficiency = {1.0, 0.003};
    knowledge.volume_1 = {0.02, 0.0002};
    knowledge.volume_2 = {0.02, 0.0002};
    knowledge.locked_rotor_frequencies = {{locked, 0.03 * locked}};
    knowledge.supply_pressure = 20e6;
    knowledge.return_pressure = 0.4e6;
    result.instruments = {0.006, 2e4, 0.003, 0.03};
    return result;
  }

  // That makes the drive's stiffness: K = beta D^2 (1/V1 + 1/V2).
  numerics::Interval bulk_modulus() const {
    const double beta = stiffness / (std::pow(torque_per_difference, 2) * 100.0);
    return numerics::normal_interval(beta, 0.003 * beta);
  }
};

double steps(double t) {
  if (t < 2.0) return 4.5 * t;
  return std::fmod(t, 11.0) < 5.5 ? 9.0 : 10.0;
}

double chirp(double t) {
  const double start = 10.0 * std::min(t / 2.0, 1.0);
  const double phase = two_pi * 0.1 * 25.0 * (std::exp(t / 25.0) - 1.0);
  return start + (t > 4.0 ? 2.0 * std::sin(phase) : 0.0);
}

double triangle(double t) {
  const double phase = std::fmod(t / 8.0, 1.0);
  return 30.0 * (phase < 0.25 ? 4.0 * phase : phase < 0.75 ? 2.0 - 4.0 * phase : 4.0 * phase - 4.0);
}

TEST(DriveResponse, OfAChirpGivesInertiaStructureAndOil) {
  const LinearDrive drive;
  auto record = drive.record(chirp, 90.0, 1.0);
  record.test = TestKind::valve_chirp;
  const auto response = drive_response(record, drive.campaign());
  const auto& impedance = response.impedance;
  EXPECT_NEAR(impedance.inertia.value, drive.inertia(), 0.006 * drive.inertia());
  EXPECT_NEAR(impedance.rigid_inertia.value, 1.4, 0.02);
  EXPECT_NEAR(impedance.friction_slope.value, 2.3, 0.05);
  ASSERT_EQ(impedance.modes.size(), 1U);
  EXPECT_NEAR(impedance.modes[0].frequency.value, 2.05, 0.01);
  EXPECT_NEAR(impedance.modes[0].inertia.value, 0.38, 0.02);
  EXPECT_LT(impedance.inertia.lower, drive.inertia());
  EXPECT_GT(impedance.inertia.upper, drive.inertia());
  ASSERT_TRUE(response.oil.has_value());
  const OilRelation oil = response.oil.value_or(OilRelation{});
  EXPECT_NEAR(oil.stiffness.value, 52.0, 0.3);
  EXPECT_NEAR(oil.total_loss_rate.value, 1.1, 0.05);
  EXPECT_NEAR(oil.valve_gain.value, 1.0, 0.01);
  EXPECT_NEAR(oil.leakage_rate.value, 1.1 - oil.orifice_loss_rate, 0.05);
  EXPECT_NEAR(response.hydraulic_frequency.value_or(numerics::Interval{}).value, drive.frequency(),
              0.005);
  EXPECT_GT(response.frequency.size(), 50);
  EXPECT_EQ(response.measured.size(), response.fitted.size());
}

TEST(DriveResponse, DoesNotRestOnTheValvesCommand) {
  const LinearDrive drive;
  auto record = drive.record(chirp, 90.0, 1.0);
  const double with = drive_response(record, drive.campaign()).impedance.inertia.value;
  record.valve_command.reset();
  const auto without = drive_response(record, drive.campaign());
  EXPECT_EQ(without.impedance.inertia.value, with);
  EXPECT_FALSE(without.oil.has_value());
}

TEST(DriveResponse, LeavesTheOilOutWhereASweepBeginsAboveTheHydraulicMode) {
  const LinearDrive drive;
  // From 1.9 Hz on, less than the structure's lowest mode is: room for the impedance alone.
  auto record = drive.record(
      [](double t) {
        const double start = 10.0 * std::min(t / 2.0, 1.0);
        const double phase = two_pi * 1.9 * 40.0 * (std::exp(t / 40.0) - 1.0);
        return start + (t > 4.0 ? 2.0 * std::sin(phase) : 0.0);
      },
      60.0, 1.0);
  record.test = TestKind::valve_chirp;
  DriveResponseOptions options;
  options.lowest_frequency = 1.9;
  options.highest_frequency = 6.0;
  const auto response = drive_response(record, drive.campaign(), options);
  EXPECT_FALSE(response.oil.has_value());
  EXPECT_FALSE(response.hydraulic_frequency.has_value());
  EXPECT_THAT(response.notes, testing::Contains(HasSubstr("too narrow to tell the oil's")));
  EXPECT_NEAR(response.impedance.inertia.value, drive.inertia(), 0.2 * drive.inertia());
}

TEST(DriveResponse, OfSignsThatDoNotBelongTogetherIsRefused) {
  const LinearDrive drive;
  auto record = drive.record(chirp, 60.0, 1.0);
  std::swap(record.inlet_pressure, record.outlet_pressure);
  EXPECT_THAT(reference::Call([&] { drive_response(record, drive.campaign()); }),
              ThrowsMessage<NumericalFailure>(HasSubstr("torque and rate do not belong together")));
  record.motor_rate.values.setZero();
  EXPECT_THAT(reference::Call([&] { drive_response(record, drive.campaign()); }),
              ThrowsMessage<NumericalFailure>(HasSubstr("moves one way for")));
  record.outlet_pressure.clear();
  EXPECT_THAT(reference::Call([&] { drive_response(record, drive.campaign()); }),
              ThrowsMessage<InvalidInput>(HasSubstr("found 1 and 0")));
}

TEST(OrificeLossRate, IsThatOfTwoOrificesInSeries) {
  // Symmetric: K q/(2 (T_supply - T)).
  const LinearDrive drive;
  const auto record = drive.record([](double) { return 8.0; }, 60.0, 0.0);
  const double torque = recorded_torque(record, drive.campaign().knowledge)(11000);
  EXPECT_NEAR(orifice_loss_rate(record, drive.campaign().knowledge, 52.0, 9.0, 11000, 500),
              52.0 * 9.0 / (2.0 * (19.6e6 * 2e-5 - torque)), 1e-6);
}

TEST(StepRings, GiveFrequencyStiffnessAndLossWithoutOilData) {
  const LinearDrive drive;
  auto record = drive.record(steps, 60.0, 1.0);
  StepRingOptions options;
  options.expected_frequency = 0.86;
  for (const bool commanded : {true, false}) {
    if (!commanded) record.valve_command.reset();
    const auto rings = fit_step_rings(record, drive.campaign(), 52.0, options);
    EXPECT_GE(rings.rings.size(), 6U);
    EXPECT_NEAR(rings.frequency.value, drive.frequency(), 0.003);
    EXPECT_NEAR(rings.stiffness.value, 52.0, 0.4);
    EXPECT_NEAR(rings.total_loss_rate.value, 1.1, 0.04);
    EXPECT_EQ(rings.plot_fitted.cols(), 2);
    if (!commanded) continue;
    for (const auto& ring : rings.rings) {
      EXPECT_NEAR(std::remainder(ring.time, 5.5), 0.0, 0.06);
    }
  }
}

TEST(StepRings, LeaveOutStepsWhereTheDriveTurnsOrIsNotMeasured) {
  const LinearDrive drive;
  auto record =
      drive.record([](double t) { return std::fmod(t, 11.0) < 5.5 ? 9.0 : -9.0; }, 40.0, 1.0);
  StepRingOptions options;
  options.expected_frequency = 0.86;
  EXPECT_THAT(reference::Call([&] { fit_step_rings(record, drive.campaign(), 52.0, options); }),
              ThrowsMessage<NumericalFailure>(HasSubstr("the drive is not moving one way")));
  record = drive.record(steps, 40.0, 1.0);
  record.motor_rate.valid.assign(static_cast<std::size_t>(record.samples()), true);
  record.motor_rate.valid[2300] = false;
  const auto rings = fit_step_rings(record, drive.campaign(), 52.0, options);
  EXPECT_THAT(rings.notes, testing::Contains(HasSubstr("the rate is not valid throughout")));
  options.expected_frequency = 0.0;
  EXPECT_THAT(reference::Call([&] { fit_step_rings(record, drive.campaign(), 52.0, options); }),
              ThrowsMessage<InvalidInput>(HasSubstr("found 0 Hz and 52 N m/rad")));
}

TEST(RingInertia, TellsApartWhatTheSimpleFormulaMixes) {
  const LinearDrive drive;
  const auto record = drive.record(steps, 60.0, 0.3);
  const auto campaign = drive.campaign();
  StepRingOptions ring;
  ring.expected_frequency = 0.86;
  const auto rings = fit_step_rings(record, campaign, 52.0, ring).rings;
  const numerics::Interval stiffness = numerics::normal_interval(52.0, 0.3);
  ResonanceOptions options;
  options.lowest_mode_fraction = {1.0, 0.05};
  const auto by = [&](ResonanceReading reading) {
    return ring_inertia(reading, rings, stiffness, record, campaign, options);
  };
  const double truth = drive.inertia();
  EXPECT_NEAR(by(ResonanceReading::ring_flexible).value, truth, 0.004 * truth);
  EXPECT_NEAR(by(ResonanceReading::ring_shape).value, truth, 0.004 * truth);
  // Friction times leakage lowers what the simple formula returns, flexibility raises it.
  const double losses = by(ResonanceReading::ring_with_losses).value;
  EXPECT_GT(losses, 1.025 * truth);
  EXPECT_LT(by(ResonanceReading::ring_single_mass).value, 0.97 * losses);
  const auto interval = by(ResonanceReading::ring_flexible);
  EXPECT_LT(interval.lower, truth);
  EXPECT_GT(interval.upper, truth);
  EXPECT_GT(interval.standard_uncertainty, 0.005 * truth);  // the stiffness alone is 0.6 %
  EXPECT_THAT(reference::Call([&] { by(ResonanceReading::impedance); }),
              ThrowsMessage<InvalidInput>(HasSubstr("a reading of rings")));

  options.friction_slope = numerics::Uncertain{2.3, 0.1};
  const auto leakage = leakage_from_damping(rings, stiffness, campaign.knowledge, options);
  const double orifices = rings[0].total_loss_rate - rings[0].leakage_rate;
  EXPECT_NEAR(leakage.value, 1.1 - orifices, 0.08);
  options.friction_slope.reset();
  EXPECT_THAT(
      reference::Call([&] { leakage_from_damping(rings, stiffness, campaign.knowledge, options); }),
      ThrowsMessage<InvalidInput>(HasSubstr("and no slope")));
}

TEST(TorqueSpectrum, KnowsAHarmonicOfTheExcitation) {
  const LinearDrive drive;
  auto record = drive.record(triangle, 60.0, 1.0);
  record.name = "fast";
  TorqueSpectrumOptions options;
  options.expected_frequency = 0.86;
  for (const bool commanded : {true, false}) {
    if (!commanded) record.valve_command.reset();
    const auto spectrum = torque_spectrum(record, drive.campaign().knowledge, options);
    EXPECT_NEAR(spectrum.period.value_or(0.0), 8.0, 0.01);
    ASSERT_TRUE(spectrum.chosen.has_value());
    const SpectralPeak chosen = spectrum.chosen.value_or(SpectralPeak{});
    EXPECT_TRUE(spectrum.on_harmonic);
    EXPECT_EQ(chosen.harmonic, 7);
    EXPECT_NEAR(chosen.frequency, 0.875, 0.002);
    EXPECT_NEAR(spectrum.harmonic_spacing, 0.25, 0.001);
    EXPECT_GT(spectrum.reading_uncertainty, 0.1);
    EXPECT_THAT(spectrum.notes, testing::Contains(HasSubstr("is harmonic 7 of the 8.00 s")));
  }
}

TEST(TorqueSpectrum, DoesNotCallAPeakBetweenHarmonicsOne) {
  LinearDrive drive;
  drive.loss = 0.02;
  drive.friction = 0.05;
  // Rings for long at its own frequency beside the triangle's lines.
  auto record =
      drive.record([](double t) { return 0.05 * triangle(t) + (t > 1.0 ? 3.0 : 0.0); }, 60.0, 1.0);
  record.rate_command = record.valve_command;
  record.rate_command->values = VectorXd::NullaryExpr(
      record.samples(), [](Index i) { return triangle(0.005 * static_cast<double>(i)); });
  TorqueSpectrumOptions options;
  options.expected_frequency = 0.8;
  const auto spectrum = torque_spectrum(record, drive.campaign().knowledge, options);
  ASSERT_TRUE(spectrum.chosen.has_value());
  EXPECT_FALSE(spectrum.on_harmonic);
  EXPECT_NEAR(spectrum.chosen.value_or(SpectralPeak{}).frequency, drive.frequency(), 0.01);
  EXPECT_LT(spectrum.reading_uncertainty, 0.01);
  // A mode of the structure there is no hydraulic mode.
  auto knowledge = drive.campaign().knowledge;
  knowledge.locked_rotor_frequencies.push_back({drive.frequency(), 0.01});
  const auto excluded = torque_spectrum(record, knowledge, options);
  EXPECT_THAT(excluded.notes, testing::Contains(HasSubstr("the structure has a mode at")));
  EXPECT_THAT(reference::Call([&] { torque_spectrum(record, knowledge, {}); }),
              ThrowsMessage<InvalidInput>(HasSubstr("found 0 Hz and 60 s")));
}

TEST(IdentifyResonance, UsesEveryRecordAndChoosesWhatTheDriveDoesNotContradict) {
  const LinearDrive drive;
  auto campaign = drive.campaign();
  const auto add = [&](const char* name, TestKind kind, const std::function<double(double)>& flow) {
    campaign.records.push_back(drive.record(flow, 60.0, 1.0));
    campaign.records.back().name = name;
    campaign.records.back().test = kind;
  };
  add("fast", TestKind::fast_ramp, triangle);
  const auto little = identify_resonance(campaign, drive.bulk_modulus());
  EXPECT_NEAR(little.stiffness.value, 52.0, 1e-9);
  ASSERT_TRUE(little.best.has_value());
  const InertiaReading by_peak = little.best.value_or(InertiaReading{});
  EXPECT_EQ(by_peak.kind, ResonanceReading::spectrum_peak);
  EXPECT_NEAR(by_peak.inertia.value, plant::inertia_from_resonance(52.0, 0.875), 0.02);
  EXPECT_LT(by_peak.inertia.lower, 0.6 * drive.inertia());
  EXPECT_GT(by_peak.inertia.upper, 1.6 * drive.inertia());
  EXPECT_FALSE(little.leakage_rate.has_value());
  EXPECT_THAT(little.notes, testing::Contains(HasSubstr("not identifiable from the records")));
  EXPECT_THAT(little.notes, testing::Contains(HasSubstr("the procedure can return no value")));

  add("steps", TestKind::valve_steps, steps);
  add("chirp", TestKind::valve_chirp, chirp);
  const auto result = identify_resonance(campaign, drive.bulk_modulus());
  ASSERT_TRUE(result.best.has_value());
  const InertiaReading best = result.best.value_or(InertiaReading{});
  EXPECT_NE(best.kind, ResonanceReading::spectrum_peak);
  EXPECT_NEAR(best.inertia.value, drive.inertia(), 0.01 * drive.inertia());
  const numerics::Interval ratio = result.motor_to_load_ratio.value_or(numerics::Interval{});
  EXPECT_NEAR(ratio.value, 1.2 / (best.inertia.value - 1.2), 1e-9);
  EXPECT_LT(ratio.lower, ratio.value);
  EXPECT_GT(ratio.upper, ratio.value);
  EXPECT_NEAR(result.stiffness_from_motion.value_or(numerics::Interval{}).value, 52.0, 0.4);
  EXPECT_LT(result.coupled_over_rigid, 0.99);
  EXPECT_GT(result.coupled_over_rigid, 0.97);
  EXPECT_EQ(result.readings.size(), 7U);
}

TEST(OilStiffness, AddsTheUncertaintiesOfItsFactors) {
  const LinearDrive drive;
  const auto knowledge = drive.campaign().knowledge;
  const auto both = oil_stiffness(knowledge, drive.bulk_modulus());
  // beta 0.3 %, displacement 0.2 % squared, volumes 1 % each at half weight, efficiencies 0.3 %.
  const double volumes = std::sqrt(0.5) * 0.01;
  const double rest = std::hypot(0.003, 0.004, volumes);
  EXPECT_NEAR(both.standard_uncertainty / both.value, std::hypot(rest, 0.003, 0.003), 1e-9);
  auto none = knowledge;
  none.efficiency_in_stiffness = plant::EfficiencyInStiffness::none;
  const auto without = oil_stiffness(none, drive.bulk_modulus());
  EXPECT_NEAR(without.standard_uncertainty / without.value, rest, 1e-9);
}

TEST(OilStiffness, InMotionCountsBothEfficienciesWhateverTheConvention) {
  auto knowledge = LinearDrive{}.campaign().knowledge;
  knowledge.torque_efficiency = {0.94, 0.003};
  knowledge.volumetric_efficiency = {0.95, 0.003};
  const numerics::Interval modulus = LinearDrive{}.bulk_modulus();
  const double with = oil_stiffness(knowledge, modulus).value;
  knowledge.efficiency_in_stiffness = plant::EfficiencyInStiffness::none;
  EXPECT_NEAR(oil_stiffness(knowledge, modulus).value, with / (0.94 * 0.95), 1e-9 * with);
  EXPECT_NEAR(oil_stiffness_in_motion(knowledge, modulus).value, with, 1e-12 * with);
  // Rings of the drive read alike by either convention, the paper's formula alone does not.
  const LinearDrive drive;
  auto campaign = drive.campaign();
  campaign.knowledge.torque_efficiency = {0.94, 0.003};
  campaign.knowledge.volumetric_efficiency = {0.95, 0.003};
  campaign.records = {drive.record(steps, 60.0, 1.0)};
  campaign.records[0].test = TestKind::valve_steps;
  const auto both = identify_resonance(campaign, modulus);
  campaign.knowledge.efficiency_in_stiffness = plant::EfficiencyInStiffness::none;
  const auto none = identify_resonance(campaign, modulus);
  EXPECT_EQ(none.best->inertia.value, both.best->inertia.value);
  EXPECT_EQ(none.stiffness.value, both.stiffness.value);
  EXPECT_GT(none.conventional_stiffness.value, 1.1 * both.conventional_stiffness.value);
}

TEST(StepRings, OfASlowRecorderCostNoOtherReading) {
  const LinearDrive drive;
  auto campaign = drive.campaign();
  const auto thinned = [](DriveRecord record, Index by) {
    const auto thin = [by](VectorXd& values) {
      const VectorXd all = values;
      values = VectorXd::NullaryExpr(all.size() / by, [&](Index i) { return all(i * by); });
    };
    thin(record.inlet_pressure[0].values);
    thin(record.outlet_pressure[0].values);
    thin(record.motor_rate.values);
    thin(record.valve_command->values);
    record.sample_time *= static_cast<double>(by);
    return record;
  };
  // 10 and 1 samples/s: too few for a fit of two modes, and for any.
  for (const Index by : {20, 200}) {
    campaign.records = {thinned(drive.record(steps, 60.0, 1.0), by),
                        drive.record(chirp, 90.0, 1.0)};
    campaign.records[0].test = TestKind::valve_steps;
    campaign.records[1].test = TestKind::valve_chirp;
    const auto result = identify_resonance(campaign, drive.bulk_modulus());
    ASSERT_TRUE(result.best) << by;
    EXPECT_NEAR(result.best->inertia.value, drive.inertia(), 0.02 * drive.inertia()) << by;
  }
}

TEST(FlexibleAmplification, IsOneWhenSlowAndGrowsTowardsTheMode) {
  const std::vector<numerics::Uncertain> locked{{2.0, 0.1}, {5.0, 0.1}};
  EXPECT_NEAR(std::abs(flexible_amplification({0.0, 0.0}, locked, 0.8) - 1.0), 0.0, 1e-12);
  const double w = two_pi * 1.0;
  EXPECT_NEAR(flexible_amplification({0.0, w}, locked, 0.8).real(), 0.8 / 0.75 + 0.2 / (1.0 - 0.04),
              1e-12);
  EXPECT_EQ(flexible_amplification({0.0, w}, {}, 0.8), std::complex<double>(1.0));
}

TEST(IdentifyResonance, RefusesDrawingsWithoutAnInertia) {
  const LinearDrive drive;
  auto campaign = drive.campaign();
  campaign.knowledge.motor_inertia.value = -10.0;
  EXPECT_THAT(reference::Call([&] { identify_resonance(campaign, drive.bulk_modulus()); }),
              ThrowsMessage<InvalidInput>(HasSubstr("inertias above 0")));
}

}  // namespace
}  // namespace boresight::identification
