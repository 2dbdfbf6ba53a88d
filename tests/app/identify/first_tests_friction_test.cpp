#include <string>

#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/edited_case.hpp"
#include <boresight/app/identify/first_tests.hpp>

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
  io::FrictionCurveEntry& curve = antenna.friction_curve;
  EXPECT_THAT(advice(antenna), HasSubstr("the friction curve, which the case does not have as "
                                         "measured"));
  curve.coulomb.basis = io::Basis::measured;
  curve.breakaway.basis = io::Basis::measured;
  EXPECT_THAT(advice(antenna),
              AllOf(HasSubstr("does not have as measured (stribeck_rate, saturating, "
                              "saturating_rate, viscous)"),
                    Not(HasSubstr("the friction curve, which"))));
  curve.stribeck_rate.basis = io::Basis::measured;
  curve.saturating.basis = io::Basis::measured;
  curve.saturating.value = 0.0;
  EXPECT_THAT(advice(antenna), HasSubstr("does not have as measured (viscous), and check the rest"))
      << "saturating_rate is of no effect";
  curve.viscous.basis = io::Basis::measured;
  EXPECT_THAT(advice(antenna), HasSubstr("they check the friction curve, which the case has as "
                                         "measured"));
}

}  // namespace
}  // namespace boresight::app
