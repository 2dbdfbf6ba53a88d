#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <variant>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/edited_case.hpp"
#include <boresight/design/problem/wind_climate.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_wind.hpp>

namespace boresight::io {
namespace {

using testing::HasSubstr;

constexpr double mile_per_hour = 0.44704;

// The 70-m case with one entry of a climate, or more, behind it.
std::string with_climate(const std::string& lines) {
  return EditedCase().text() + "\n[[wind.climate]]\n" + lines;
}

const std::string exceedance =
    "mean = \"9 mile/h\"\nexceeded = \"30 mile/h\"\nexceeded_share = \"2 %\"\n";
const std::string highest = "highest = \"30 mile/h\"\n";

TEST(CaseClimate, TakesAMeanAndOneExceedance) {
  const io::Case antenna = io::parse_case(with_climate(exceedance + highest), "case.toml");
  ASSERT_EQ(antenna.wind->climate_parts.size(), 1U);
  const auto& controller = std::get<design::WeibullClimate>(antenna.wind->climate_parts[0].winds);
  EXPECT_NEAR(controller.scale * std::tgamma(1.0 + 1.0 / controller.shape), 9.0 * mile_per_hour,
              1e-9);
  EXPECT_NEAR(std::exp(-std::pow(30.0 * mile_per_hour / controller.scale, controller.shape)), 0.02,
              1e-9);
  EXPECT_NEAR(controller.shape, 1.19173678, 1e-8);
  EXPECT_NEAR(controller.highest, 30.0 * mile_per_hour, 1e-12);
  // What lies above `highest` does not count.
  EXPECT_EQ(design::fraction_of_time(antenna.wind->climate_parts, 30.0 * mile_per_hour), 1.0);
  for (const auto& one : antenna.wind->climate) EXPECT_LE(one.speed, controller.highest);
  for (const char* key : {"mean", "exceeded", "exceeded_share", "highest"}) {
    const std::string path = std::string("wind.climate[0].") + key;
    EXPECT_TRUE(std::ranges::any_of(antenna.quantities, [&](const io::Quantity& one) {
      return one.key == path;
    })) << path;
  }
}

TEST(CaseClimate, RaisesAMeanAndAnExceedanceFromTheMast) {
  EditedCase edited;
  edited.replace("design_speed = {",
                 "mast_height = \"10 m\"\nheight = \"40 m\"\n"
                 "design_speed = {");
  const io::Case antenna =
      io::parse_case(edited.text() + "\n[[wind.climate]]\n" + exceedance + highest, "case.toml");
  const double ratio = std::pow(4.0, 0.14);
  const auto& controller =
      std::get<design::WeibullClimate>(antenna.wind->climate_parts.at(0).winds);
  EXPECT_NEAR(controller.scale * std::tgamma(1.0 + 1.0 / controller.shape),
              ratio * 9.0 * mile_per_hour, 1e-9);
  EXPECT_NEAR(controller.shape, 1.19173678, 1e-8);
  EXPECT_NEAR(controller.highest, ratio * 30.0 * mile_per_hour, 1e-12);
}

TEST(CaseClimate, RefusesKeysOfTwoWaysAndControllersThatAreNone) {
  const std::string entry = "wind.climate[0].";
  const std::pair<std::string, std::string> wrong[] = {
      {highest,
       "speed: expected either a speed, or of a Weibull distribution scale and shape, or its mean, "
       "exceeded and exceeded_share, found none of them"},
      {exceedance + highest + "scale = \"4 m/s\"\n", "found scale and mean"},
      {exceedance + highest + "shape = \"2\"\n",
       "shape: expected it beside a scale, found it beside a mean"},
      {"scale = \"4 m/s\"\nshape = \"2\"\nexceeded = \"9 m/s\"\n" + highest,
       "exceeded: expected it beside a mean, found it beside a scale"},
      {"speed = \"4 m/s\"\nexceeded_share = \"2 %\"\n",
       "exceeded_share: expected it beside a mean, found it beside a speed"},
      {"speed = \"4 m/s\"\n" + highest,
       "highest: expected it beside a scale or a mean, found it beside a speed"},
      {exceedance,
       "highest: expected mean, exceeded, exceeded_share and highest together, found not all"},
      {"mean = \"9 mile/h\"\n" + highest, "exceeded: expected mean, exceeded, exceeded_share and"},
      {"mean = \"9 mile/h\"\nexceeded = \"30 mile/h\"\n" + highest,
       "exceeded_share: expected mean, exceeded, exceeded_share and"},
      {"mean = \"9 mile/h\"\nexceeded = \"30 mile/h\"\nexceeded_share = \"8 %\"\n" + highest,
       "exceeded_share: expected a fraction of at most 5.52845 %, which of Weibull distributions "
       "with shapes "
       "from "
       "0.8 to 10 lies above 3.333 times the mean, found '8 %'"},
      {"mean = \"9 mile/h\"\nexceeded = \"30 mile/h\"\nexceeded_share = \"1\"\n" + highest,
       "exceeded_share: expected a fraction of at most 5.52845 %"},
      {"mean = \"10 m/s\"\nexceeded = \"3 m/s\"\nexceeded_share = \"50 %\"\n" + highest,
       "exceeded_share: expected a fraction of at least 65.5881 %"},
      {"mean = \"10 m/s\"\nexceeded = \"12 m/s\"\nexceeded_share = \"31 %\"\n" + highest,
       "exceeded: expected a speed further above the mean, found '12 m/s', which is exceeded as "
       "often with a shape of 1.118 as with one of 2.514"}};
  for (const auto& [lines, message] : wrong) {
    EXPECT_THAT(refusal_of(with_climate(lines)), HasSubstr(message)) << lines;
    EXPECT_THAT(refusal_of(with_climate(lines)), HasSubstr(entry));
  }
}

}  // namespace
}  // namespace boresight::io
