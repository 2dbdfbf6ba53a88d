// The measured hydraulic frequency against that of the flexible antenna.
#include <gtest/gtest.h>

#include "io/oil_case.hpp"
#include <boresight/io/audit/resonance_verdict.hpp>
#include <boresight/io/case/antenna_of.hpp>
#include <boresight/io/case/case_structure.hpp>
#include <boresight/io/case/case_tests.hpp>
#include <boresight/io/case/member_ranges.hpp>
#include <boresight/io/case/plant_numbers.hpp>

namespace boresight::io {
namespace {

double hydraulic_frequency(const Case& antenna) {
  return plant::hydraulic_mode(plant::plant_modes(make_plant(antenna))).frequency;
}

TEST(BulkModulusFor, MakesTheFrequencyOfTheFlexibleAntenna) {
  const Case antenna = with_oil(1.229e9);
  for (const double frequency : {0.5, 0.97, 1.1}) {
    const auto modulus = bulk_modulus_for(antenna, frequency);
    ASSERT_TRUE(modulus);
    // Read anew: with that modulus the leakage rate is another too.
    EXPECT_NEAR(hydraulic_frequency(with_oil(*modulus)), frequency, 2e-6);
  }
}

TEST(BulkModulusFor, IsNoneWhereTheStructureIsSofter) {
  EXPECT_FALSE(bulk_modulus_for(with_oil(1.229e9), 20.0));
}

TEST(ResonanceVerdict, ContradictsBeyondThreeStandardUncertainties) {
  const Case antenna = with_oil(1.229e9);
  const auto verdict = resonance_verdict(antenna);
  ASSERT_TRUE(verdict);
  EXPECT_EQ(verdict->measured, 0.97);
  EXPECT_NEAR(verdict->expected, hydraulic_frequency(antenna), 1e-12);
  EXPECT_TRUE(verdict->contradicts());
  EXPECT_NEAR(verdict->stated_bulk_modulus, 1.229e9, 1.0);
  EXPECT_EQ(verdict->min_oil, member_ranges(antenna).oil_stiffness.lower);
  const auto agreeing = resonance_verdict(with_oil(verdict->bulk_modulus.value()));
  ASSERT_TRUE(agreeing);
  EXPECT_LT(agreeing->deviation(), 0.01);
  EXPECT_FALSE(agreeing->contradicts());
  const ResonanceVerdict below{.measured = 2.97, .expected = 0.0, .standard_uncertainty = 1.0};
  const ResonanceVerdict above{.measured = 3.02, .expected = 0.0, .standard_uncertainty = 1.0};
  EXPECT_FALSE(below.contradicts());
  EXPECT_TRUE(above.contradicts());
}

// A gear spring far softer than the oil.
TEST(ResonanceVerdict, IsOfTheModeThatTheCaseNames) {
  Case antenna = with_oil(1.229e9);
  antenna.structure->locked_rotor_frequency.value = 0.2;
  const auto verdict = resonance_verdict(antenna);
  ASSERT_TRUE(verdict);
  EXPECT_LT(verdict->mode.oil_fraction, 0.1);
  EXPECT_GT(verdict->oil_mode.oil_fraction, 0.9);
  EXPECT_FALSE(verdict->rigid);
  antenna.resonance->of_oil = true;
  const auto of_oil = resonance_verdict(antenna);
  ASSERT_TRUE(of_oil);
  EXPECT_EQ(of_oil->expected, verdict->oil_mode.frequency);
  antenna.resonance->frequency.reset();
  EXPECT_FALSE(resonance_verdict(antenna));
}

}  // namespace
}  // namespace boresight::io
