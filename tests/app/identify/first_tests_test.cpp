#include <string>

#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/edited_case.hpp"
#include <boresight/app/identify/first_tests.hpp>
#include <boresight/io/case/case_oil.hpp>

namespace boresight::app {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string advice(const io::Case& antenna) {
  return fmt::format("{}", fmt::join(first_tests(antenna), " "));
}

TEST(FirstTests, GoByWhatTheCaseTakesForGranted) {
  const io::Case antenna = io::read_case(case_path("dss14-70m"));
  EXPECT_THAT(advice(antenna), HasSubstr("valve-steps"));
  EXPECT_THAT(advice(antenna), HasSubstr("so far not measured"));
  EXPECT_THAT(advice(antenna), Not(HasSubstr("slosh"))) << "its lines were measured";
  EXPECT_THAT(advice(antenna), Not(HasSubstr("the case lacks")));
  io::Case bare = io::read_case(case_path("dss14-64m"));
  EXPECT_THAT(advice(bare), HasSubstr("the case lacks [simulation], [recorder], [tachometer], "
                                      "[[oil.line]]"));
  EXPECT_THAT(advice(bare), HasSubstr("slosh"));
  bare.oil->bulk_modulus->basis = io::Basis::measured;
  EXPECT_THAT(advice(bare), Not(HasSubstr("slosh")));
}

}  // namespace
}  // namespace boresight::app
