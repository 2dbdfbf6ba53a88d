#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/edited_case.hpp"
#include <boresight/io/exchange/gains_by_key.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::io {
namespace {

using testing::HasSubstr;

const std::vector<std::string> pi{"wip=0.02 rad/s", "kr=0.2", "wi=0.127 Hz", "kp=0.2 1/s"};

Case antenna_of_test() {
  return parse_case(EditedCase().text(), "case.toml");
}

TEST(ControllerByKey, TakesGainsInAnyOrderAndUnit) {
  const auto controller = controller_by_key(antenna_of_test(), "PI-0", pi);
  EXPECT_EQ(controller.structure, control::LoopStructure::named("PI-0"));
  EXPECT_DOUBLE_EQ(gain(controller, "kr"), 0.2);
  EXPECT_NEAR(gain(controller, "wi"), 2.0 * std::numbers::pi * 0.127, 1e-12);
  EXPECT_DOUBLE_EQ(gain(controller, "kp"), 0.2);
  EXPECT_DOUBLE_EQ(gain(controller, "wip"), 0.02);
}

// The text that the sliders of a report page give.
TEST(ControllerByKey, TakesEveryGainInItsOwnUnitToTheLastDigit) {
  const auto structure = control::LoopStructure::named("FULL+N+C");
  std::vector<std::string> texts;
  std::vector<double> values;
  for (const auto& gain : structure.gains()) {
    values.push_back(std::sqrt(gain.lower * gain.upper));
    texts.push_back(fmt::format("{}={}{}", gain.symbol, values.back(),
                                gain.unit == "1" ? "" : " " + gain.unit));
  }
  EXPECT_EQ(controller_by_key(antenna_of_test(), "FULL+N+C", texts).gains, values);
}

TEST(ControllerByKey, SaysWhichGainIsMissingOrWrong) {
  const Case antenna = antenna_of_test();
  const auto refusal = [&](const std::vector<std::string>& gains) -> std::string {
    try {
      controller_by_key(antenna, "PI-0", gains);
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "taken";
  };
  EXPECT_THAT(refusal({"kr=1.2"}), HasSubstr("expected a value for wi (rate integral corner)"));
  auto unknown = pi;
  unknown.emplace_back("kx=1");
  EXPECT_THAT(refusal(unknown), HasSubstr("with a key of kr, wi, kp, wip, found none"));
  auto wrong = pi;
  wrong[2] = "wi=2 m";
  EXPECT_THAT(refusal(wrong), HasSubstr("'wi=2 m'"));
  auto still = pi;
  still[1] = "kr=0";
  EXPECT_NE(refusal(still), "taken");
  EXPECT_THROW(controller_by_key(antenna, "XY", pi), InvalidInput);
}

}  // namespace
}  // namespace boresight::io
