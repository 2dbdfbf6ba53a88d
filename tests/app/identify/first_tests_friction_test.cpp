#include <string>

#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/edited_case.hpp"
#include <boresight/app/identify/first_tests.hpp>
#include <boresight/io/case/case_friction.hpp>

namespace boresight::app {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

std::string advice(const io::Case& antenna) {
  return fmt::format("{}", fmt::join(first_tests(antenna), " "));
}

TEST(FirstTests, NameWhatOfTheFrictionCurveIsNotMeasured) {
  io::Case antenna = io::read_case(case_path("dss14-64m"));
  io::FrictionCurveEntry& curve = *antenna.friction_curve;
  EXPECT_THAT(advice(antenna), HasSubstr("they give the friction curve, so far not measured"));
  curve.coulomb.basis = io::Basis::measured;
  curve.breakaway.basis = io::Basis::measured;
  EXPECT_THAT(
      advice(antenna),
      AllOf(HasSubstr("not yet measured (stribeck_rate, saturating, saturating_rate, viscous)"),
            Not(HasSubstr("so far not measured"))));
  curve.stribeck_rate.basis = io::Basis::measured;
  curve.saturating.basis = io::Basis::measured;
  curve.saturating.value = 0.0;
  EXPECT_THAT(advice(antenna), HasSubstr("not yet measured (viscous) and check the rest"))
      << "saturating_rate is of no effect";
  curve.viscous.basis = io::Basis::measured;
  EXPECT_THAT(advice(antenna), HasSubstr("they check the measured friction curve"));
}

}  // namespace
}  // namespace boresight::app
