#include <cmath>
#include <limits>
#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reference_antenna.hpp"
#include "refused_call.hpp"
#include <boresight/identification/campaign/inertia_methods.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::identification {
namespace {

using reference::lbf_ft_s2;
using testing::HasSubstr;
using testing::ThrowsMessage;

// The paper's evidence, with usual uncertainties.
DriveEvidence evidence() {
  DriveEvidence evidence;
  evidence.stages = reference::gear_stages();
  evidence.assemblies = {{"J1", {1.5876, 0.08}, 4.0, 1},
                         {"J2", {5.2576, 0.26}, 4.0, 2},
                         {"J3", {31.294, 1.5}, 4.0, 3},
                         {"J4", {194.5418, 9.7}, 4.0, 4},
                         {"Jct", {0.01207, 0.0006}, 4.0, 0}};
  evidence.antenna = {{"Table 3", {0.356047, 0.036}},
                      {"section II", {reference::antenna_inertia(), 0.04}}};
  evidence.motor_count = 4.0;
  evidence.motor_inertia = {0.3007, 0.003};
  evidence.displacement = {38.329e-6 / two_pi, 1.2e-8};
  evidence.torque_efficiency = {0.938, 0.003};
  evidence.volumetric_efficiency = {0.9412, 0.005};
  evidence.oil_density = {850.0, 1.7};
  evidence.lines = {{"shortest", {13.11, 0.03}, {46.3, 0.2}},
                    {"longest", {15.60, 0.03}, {38.3, 0.2}}};
  evidence.bulk_modulus = numerics::Uncertain{1229e6, 18e6};
  evidence.volume_1 = {0.02455, 2.5e-4};
  evidence.volume_2 = {0.02457, 2.5e-4};
  evidence.resonance_frequency = numerics::Uncertain{0.97, 0.01};
  evidence.impulse = {{"constant-speed", {1.668, 0.083}}, {"slow-ramp", {1.45, 0.07}}};
  return evidence;
}

// The 64-m antenna: Table 2 in the paper's own unit, gear rows as for the 70-m.
DriveEvidence evidence_64m() {
  DriveEvidence old = evidence();
  old.assemblies[0].inertia = {1.1710, 0.0};
  old.assemblies[1].inertia = {3.8779, 0.0};
  old.assemblies[2].inertia = {23.0816, 0.0};
  old.assemblies[3].inertia = {143.4886, 0.0};
  old.assemblies[4].inertia = {0.0357 / 4.0, 0.0};
  old.antenna = {{"64-m", {1e8 / std::pow(reference::gear_ratio(), 2), 0.0}}};
  old.motor_inertia = {0.13064, 0.0};
  return old;
}

TEST(MassProperties, OfThe64MetreAntennaAreThePapers) {
  const auto method = identify_inertia(evidence_64m()).methods.at(0);
  EXPECT_NEAR(method.reflected_inertia.value, 0.804, 5e-4);  // lbf ft s2
  EXPECT_NEAR(method.motor_to_load_ratio.value, 1.857, 2e-3);
}

TEST(MassProperties, OfThe70MetreAntennaAreThePapersWithTable3) {
  const auto method = identify_inertia(evidence()).methods.at(0);
  EXPECT_NEAR(method.reflected_inertia.value / lbf_ft_s2, 1.31, 5e-3);
  EXPECT_NEAR(method.reflected_inertia.value, 1.7759, 5e-4);
  EXPECT_NEAR(method.motor_to_load_ratio.value, 2.098, 2e-3);
  EXPECT_NEAR(method.antenna_remainder.value, 0.356047, 1e-9);
}

TEST(MassProperties, TakeTheAntennaOfTheTextAsAnotherMethod) {
  const auto methods = identify_inertia(evidence()).methods;
  ASSERT_EQ(methods.size(), 5u);
  EXPECT_NEAR(methods[1].antenna_remainder.value, reference::antenna_inertia(), 1e-9);
  EXPECT_NEAR(methods[1].reflected_inertia.value - methods[0].reflected_inertia.value,
              reference::antenna_inertia() - 0.356047, 1e-9);
}

TEST(HydraulicResonance, GivesTheInertiaThatEq19Gives) {
  const auto result = identify_inertia(evidence());
  const auto& method = result.methods.at(2);
  EXPECT_EQ(method.name, "hydraulic resonance");
  EXPECT_NEAR(method.reflected_inertia.value, 1.416, 5e-4);
  EXPECT_NEAR(method.motor_to_load_ratio.value, 4 * 0.3007 / (1.416 - 4 * 0.3007), 0.02);
  // J = K/w^2 with K a product: relative uncertainties add in squares; the two volumes halve.
  const double stiffness =
      std::sqrt(std::pow(2 * 1.2e-8 / evidence().displacement.value, 2) +
                std::pow(0.003 / 0.938, 2) + std::pow(0.005 / 0.9412, 2) +
                std::pow(18.0 / 1229.0, 2) + 2.0 * std::pow(0.5 * 2.5e-4 / 0.02456, 2));
  EXPECT_NEAR(result.oil_stiffness.standard_uncertainty / result.oil_stiffness.value, stiffness,
              1e-5);
  EXPECT_NEAR(method.reflected_inertia.standard_uncertainty / method.reflected_inertia.value,
              std::hypot(stiffness, 2.0 * 0.01 / 0.97), 1e-5);
}

TEST(HydraulicResonance, MakesTheRatioTwelveTimesAsUncertainAsTheFrequency) {
  // 1 % in frequency is 2 % in J and J/(J - Jm) times that in R.
  DriveEvidence only_frequency = evidence();
  only_frequency.motor_inertia.standard_uncertainty = 0.0;
  only_frequency.displacement.standard_uncertainty = 0.0;
  only_frequency.torque_efficiency.standard_uncertainty = 0.0;
  only_frequency.volumetric_efficiency.standard_uncertainty = 0.0;
  only_frequency.bulk_modulus->standard_uncertainty = 0.0;
  only_frequency.volume_1.standard_uncertainty = only_frequency.volume_2.standard_uncertainty = 0.0;
  only_frequency.resonance_frequency = numerics::Uncertain{0.97, 0.0097};
  const auto method = identify_inertia(only_frequency).methods.at(2);
  const double j = method.reflected_inertia.value;
  EXPECT_NEAR(method.reflected_inertia.standard_uncertainty / j, 0.02, 1e-6);
  const double amplification = j / (j - 4 * 0.3007);
  EXPECT_NEAR(method.motor_to_load_ratio.standard_uncertainty / method.motor_to_load_ratio.value,
              0.02 * amplification, 1e-5);
  EXPECT_GT(0.02 * amplification, 0.12);
}

TEST(IdentifyInertia, GivesTheRowsOfTable3AndTheBulkModuli) {
  const auto result = identify_inertia(evidence());
  EXPECT_NEAR(result.gear_ratio, 28723.647, 1e-3);
  ASSERT_EQ(result.load_rows.size(), 7u);
  const double rows[] = {0.14146, 0.02025, 0.004989, 0.002088, 0.0483};
  for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(result.load_rows[i].value, rows[i], 3e-5);
  EXPECT_NEAR(result.line_bulk_modulus.at(0).value, 1245.5e6, 7e-3 * 1245.5e6);
  EXPECT_NEAR(result.line_bulk_modulus.at(1).value, 1212.5e6, 2e-3 * 1212.5e6);
  EXPECT_EQ(result.bulk_modulus.value, 1229e6);
  // f = sqrt(K/J)/2 pi of the first antenna inertia.
  EXPECT_NEAR(result.oil_stiffness.value / std::pow(two_pi * result.expected_frequency.value, 2),
              result.methods[0].reflected_inertia.value, 1e-9);
}

TEST(IdentifyInertia, WithoutABulkModulusTakesTheMeanOfTheLines) {
  DriveEvidence lines_only = evidence();
  lines_only.bulk_modulus.reset();
  const auto result = identify_inertia(lines_only);
  EXPECT_NEAR(result.bulk_modulus.value,
              0.5 * (result.line_bulk_modulus[0].value + result.line_bulk_modulus[1].value), 1.0);
}

TEST(IdentifyInertia, LeavesOutMethodsWithoutEvidence) {
  DriveEvidence mass_only = evidence();
  mass_only.resonance_frequency.reset();
  mass_only.impulse.clear();
  EXPECT_EQ(identify_inertia(mass_only).methods.size(), 2u);
  mass_only.antenna.clear();
  EXPECT_THAT(reference::Call([&] { identify_inertia(mass_only); }),
              ThrowsMessage<InvalidInput>(HasSubstr("at least one antenna inertia")));
}

TEST(IdentifyInertia, BoundsTheRatioOfAnInertiaNearTheMotorsFromBelowOnly) {
  // Motors 1.2028, inertia 1.25 +- 0.06: a fifth of the samples lies below the motors' own.
  DriveEvidence near = evidence();
  near.impulse = {{"near", {1.25, 0.06}}};
  const auto ratio = identify_inertia(near).methods.back().motor_to_load_ratio;
  EXPECT_EQ(ratio.upper, std::numeric_limits<double>::infinity());
  EXPECT_GT(ratio.lower, 0.0);
  EXPECT_GT(ratio.beyond_pole, 0.15);
  EXPECT_LT(ratio.beyond_pole, 0.3);
}

TEST(IdentifyInertia, IsTheSameWithEverySeedToItsSamplingError) {
  const auto once = identify_inertia(evidence(), {20000, 1}).methods[2].reflected_inertia;
  const auto again = identify_inertia(evidence(), {20000, 1}).methods[2].reflected_inertia;
  const auto other = identify_inertia(evidence(), {20000, 2}).methods[2].reflected_inertia;
  EXPECT_EQ(once.lower, again.lower);
  EXPECT_EQ(once.upper, again.upper);
  EXPECT_NEAR(once.lower, other.lower, 0.05 * once.standard_uncertainty);
}

TEST(Combine, OfEqualUncertaintiesIsTheMeanWithTheScatterOfTheMethods) {
  // Equal variances v: the mean, Q = sum d^2/v, between = s^2 - v, standard error s/sqrt(n).
  const std::vector<numerics::Uncertain> estimates{{1.776, 0.03}, {1.416, 0.03}, {1.559, 0.03}};
  const double mean = (1.776 + 1.416 + 1.559) / 3.0;
  double squares = 0.0;
  for (const auto& e : estimates) squares += std::pow(e.value - mean, 2);
  const double scatter = squares / 2.0;
  const auto result = combine(estimates, 1.2028);
  EXPECT_NEAR(result.value, mean, 1e-12);
  EXPECT_NEAR(result.heterogeneity, squares / 9e-4, 1e-9);
  EXPECT_EQ(result.degrees_of_freedom, 2);
  EXPECT_NEAR(result.between_methods, std::sqrt(scatter - 9e-4), 1e-12);
  EXPECT_NEAR(result.standard_uncertainty, std::sqrt(scatter / 3.0), 1e-12);
  // Student's t of two degrees of freedom that 95 % lie within: 0.95 sqrt(2/(1 - 0.95^2)).
  EXPECT_NEAR(result.upper - result.value,
              0.95 * std::sqrt(2.0 / (1.0 - 0.95 * 0.95)) * result.standard_uncertainty, 1e-12);
  EXPECT_NEAR(result.lower + result.upper, 2.0 * result.value, 1e-12);
  EXPECT_NEAR(result.motor_to_load_ratio, 1.2028 / (mean - 1.2028), 1e-12);
}

TEST(Combine, OfMethodsThatAgreeIsTheInverseVarianceMean) {
  const auto result = combine({{1.0, 0.1}, {1.05, 0.2}}, 0.5);
  EXPECT_EQ(result.between_methods, 0.0);
  EXPECT_NEAR(result.value, (100.0 * 1.0 + 25.0 * 1.05) / 125.0, 1e-12);
  EXPECT_NEAR(result.standard_uncertainty, 1.0 / std::sqrt(125.0), 1e-12);
  EXPECT_LT(result.heterogeneity, 1.0);
}

TEST(Combine, IsContradictoryBeyondRealisationErrorOnly) {
  // Cochran's Q is half the square of the difference in standard uncertainties: 8 and 18, where
  // chance exceeds 10.8 on one degree of freedom once in a thousand times.
  EXPECT_FALSE(combine({{1.0, 0.1}, {1.4, 0.1}}, 0.5).contradictory());
  EXPECT_TRUE(combine({{1.0, 0.1}, {1.6, 0.1}}, 0.5).contradictory());
}

TEST(Combine, FollowsUnitsAndOrder) {
  const std::vector<numerics::Uncertain> one{{1.7, 0.05}, {1.4, 0.03}, {1.5, 0.08}};
  const std::vector<numerics::Uncertain> other{{15.0, 0.8}, {17.0, 0.5}, {14.0, 0.3}};
  const auto a = combine(one, 1.2), b = combine(other, 12.0);
  EXPECT_NEAR(10.0 * a.value, b.value, 1e-12);
  EXPECT_NEAR(10.0 * a.between_methods, b.between_methods, 1e-12);
  EXPECT_NEAR(a.motor_to_load_ratio, b.motor_to_load_ratio, 1e-12);
  EXPECT_NEAR(a.heterogeneity, b.heterogeneity, 1e-9);
}

TEST(Combine, LeavesTheRatioOpenWhereTheIntervalReachesTheMotors) {
  const auto result = combine({{1.3, 0.05}, {1.5, 0.05}}, 1.2028);
  EXPECT_LT(result.lower, 1.2028);
  EXPECT_EQ(result.ratio_upper, std::numeric_limits<double>::infinity());
  EXPECT_NEAR(result.ratio_lower, 1.2028 / (result.upper - 1.2028), 1e-12);
}

TEST(Combine, RefusesOneEstimateOrOneWithoutUncertainty) {
  EXPECT_THAT(reference::Call([] {
                combine({{1.0, 0.1}}, 1.2);
              }),
              ThrowsMessage<InvalidInput>(HasSubstr("at least 2 estimates, found 1")));
  EXPECT_THAT(reference::Call([] {
                combine({{1.0, 0.1}, {1.0, 0.0}}, 1.2);
              }),
              ThrowsMessage<InvalidInput>(HasSubstr("positive uncertainties")));
  EXPECT_THROW(combine({{1.0, 0.1}, {1.0, std::nan("")}}, 1.2), InvalidInput);
}

TEST(TachometerScale, IsThatOfEq32) {
  // 600/157 rpm a volt, 130/23 turns: 2.262 rad/(s V), of which the paper prints 2.261.
  const double scale = tachometer_scale(600.0 * reference::rpm, 157.0, 130.0 / 23.0);
  EXPECT_NEAR(scale, 2.262, 5e-4);
  EXPECT_NEAR(scale, 2.261, 2e-3);
}

TEST(FrictionAndOffset, AreThoseOfTheSlowRampTests) {
  const auto [coulomb, offset] = friction_and_offset(14.12, 25.42);
  EXPECT_NEAR(coulomb, 19.77, 1e-9);
  EXPECT_NEAR(offset, 5.65, 1e-9);
  // Friction opposes both ways, the offset helps one.
  EXPECT_NEAR(coulomb - offset, 14.12, 1e-12);
  EXPECT_NEAR(coulomb + offset, 25.42, 1e-12);
}

}  // namespace
}  // namespace boresight::identification
