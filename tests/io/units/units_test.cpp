#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/unit_refusal.hpp"
#include <boresight/io/units/units.hpp>

namespace boresight::io {
namespace {

using testing::HasSubstr;

constexpr double pi = std::numbers::pi;

Refusal refused_unit(std::string_view text) {
  return refusal_of([text] { io::parse_unit(text); });
}

/// Within the rounding of a few operations.
void expect_same(double found, double expected, std::string_view text) {
  EXPECT_NEAR(found, expected, 4e-16 * std::abs(expected)) << text;
}

TEST(ParseUnit, HasTheFactorsOfTheDefinitions) {
  const std::vector<std::pair<std::string_view, double>> published{
      {"in", 0.0254},
      {"ft", 0.3048},
      {"mile", 1609.344},
      {"in3", 1.6387064e-5},
      {"US_gal", 3.785411784e-3},
      {"L", 1e-3},
      {"cc", 1e-6},
      {"lbm", 0.45359237},
      {"slug", 14.593902937206364},
      {"lbf", 4.4482216152605},
      {"kip", 4448.2216152605},
      {"kgf", 9.80665},
      {"psi", 6894.757293168361},
      {"ksi", 6894757.293168361},
      {"bar", 1e5},
      {"hp", 745.69987158227022},
      {"lbf.ft", 1.3558179483314004},
      {"lbf.ft.s2", 1.3558179483314004},
      {"slug.ft2", 1.3558179483314004},
      {"lbm.ft2", 0.04214011009380480},
      {"lbf.in", 0.1129848290276167},
      {"knot", 1852.0 / 3600.0},
      {"mile/h", 0.44704},
      {"US_gal/min", 6.30901964e-5},
      {"in3/s", 1.6387064e-5},
      {"deg", pi / 180.0},
      {"mdeg", pi / 180e3},
      {"arcmin", pi / 10800.0},
      {"arcsec", pi / 648e3},
      {"rev", 2.0 * pi},
      {"rpm", pi / 30.0},
      {"Hz", 2.0 * pi},
      {"kHz", 2e3 * pi},
      {"%", 0.01},
      {"1", 1.0},
      {"mA/psi", 1e-3 / 6894.757293168361},
  };
  for (const auto& [text, factor] : published) {
    expect_same(io::parse_unit(text).factor, factor, text);
  }
}

TEST(ParseUnit, KeepsAngleAsADimension) {
  EXPECT_EQ(io::parse_unit("Hz").dimension, (io::Dimension{.time = -1, .angle = 1}));
  EXPECT_EQ(io::parse_unit("rpm").dimension, io::parse_unit("rad/s").dimension);
  EXPECT_NE(io::parse_unit("Hz").dimension, io::parse_unit("1/s").dimension);
  EXPECT_NE(io::parse_unit("N.m/rad").dimension, io::parse_unit("N.m").dimension);
  EXPECT_EQ(io::parse_unit("V").dimension,
            (io::Dimension{.length = 2, .mass = 1, .time = -3, .current = -1}));
  EXPECT_EQ(io::parse_unit("V.A").dimension, io::parse_unit("W").dimension);
}

TEST(ParseUnit, ReadsEverySpellingOfAProduct) {
  const io::Unit expected = io::parse_unit("lbf.ft.s2");
  for (const std::string_view text :
       {"lbf ft s2", "lbf*ft*s2", "lbf*ft*s^2", "lbf·ft·s²", "lbf⋅ft⋅s2", "lbf . ft * s^2",
        "(lbf.ft).s2", "(lbf.ft.s2)", "  lbf.ft.s2 ", "lbf.ft/s-2", "lbf.ft/s^-2", "lbf.ft/s⁻²",
        "lbf.(ft.s.s)", "lbf.ft/(1/s2)", "lbf.ft.(1/s)^-2", "lbf.ft.(s)2"}) {
    const io::Unit unit = io::parse_unit(text);
    EXPECT_EQ(unit.dimension, expected.dimension) << text;
    expect_same(unit.factor, expected.factor, text);
  }
  EXPECT_EQ(io::parse_unit("m⁴").dimension, (io::Dimension{.length = 4}));
  expect_same(io::parse_unit("µrad").factor, 1e-6, "micro sign");
  expect_same(io::parse_unit("μm").factor, 1e-6, "Greek mu");
  EXPECT_EQ(io::parse_unit("N.m/(rad/s)").dimension, io::parse_unit("N.m.s/rad").dimension);
}

TEST(ParseUnit, SuggestsWhatToWrite) {
  const std::vector<std::pair<std::string_view, std::string_view>> remedies{
      {"gal/min", "write US_gal"},
      {"gpm", "write US_gal/min"},
      {"oz", "mass, force or volume?"},
      {"lb", "mass or force? write lbm or lbf"},
      {"mph", "write mile/h"},
      {"psig", "write psi"},
      {"psia", "write psi"},
      {"kn", "knot or kN"},
      {"mil", "write in or mrad"},
      {"J", "energy has the dimension of torque: write N.m"},
      {"Nm", "write N.m"},
      {"lb-ft", "a product is '.', and lb is mass or force: write lbf.ft"},
      {"ft-lb", "a product is '.', and lb is mass or force: write lbf.ft"},
      {"lbf-ft", "a product is '.': write lbf.ft"},
      {"-", "the unit of a plain number is 1"},
      {"PSI", "did you mean 'psi'?"},
      {"mpa", "did you mean 'MPa'?"},
      {"arcsecs", "did you mean 'arcsec'?"},
      {"slgu", "did you mean 'slug'?"},
      {"furlong", "(unknown unit)"},
      {"x", "(unknown unit)"},
      {"N.m/rad.s", "write N.m/(rad.s) or N.m.s/rad"},
      {"N.m/rad s", "write N.m/(rad.s) or N.m.s/rad"},
      {"rad/s/V", "write rad/(s.V)"},
      {"°", "write deg"},
      {"/s", "write '1/s'"},
      {"m.", "a unit's name is missing at the end"},
      {"(N.m", "')' is missing"},
      {"N.m)", "no parenthesis is open"},
      {"s0", "from 1 to 9"},
      {"g0", "from 1 to 9"},
      {"s10", "from 1 to 9"},
      {"s^", "from 1 to 9"},
      {"s⁻", "from 1 to 9"},
      {"s 2", "an exponent follows its name directly"},
      {"2 m", "a unit holds no number"},
      {"m.1", "a unit holds no number"},
      {"m,s", "names joined by '.'"},
      {"m..s", "names joined by '.'"},
      {"s**2", "names joined by '.'"},
      {"", "found nothing (a plain number has the unit 1)"},
      {"((((((((((m))))))))))", "too many parentheses"},
      {"((m9)9)", "out of all bounds"},
      {"(GPa9.GPa9)9", "out of all bounds"},
  };
  for (const auto& [text, remedy] : remedies) {
    EXPECT_THAT(refused_unit(text).message, HasSubstr(remedy)) << text;
  }
}

TEST(ParseUnit, StatesExpectationTokenAndText) {
  const Refusal refusal = refused_unit("N.m/radd");
  EXPECT_EQ(refusal.message,
            "expected a unit (such as N.m, in3/rev, 1/s), found 'radd' in 'N.m/radd' (unknown "
            "unit, did you mean 'rad'?)");
  EXPECT_EQ(refusal.column, 5);
}

TEST(ParseUnit, CountsColumnsInCharacters) {
  const std::vector<std::pair<std::string_view, int>> columns{
      {"lb", 1},    {"  lb", 3},      {"N.lb", 3}, {"N·lb", 3},  {"s²·xyz", 4},    {"lb-ft", 3},
      {"ft-lb", 3}, {"N.m/rad.s", 8}, {"a/b", 1},  {"N/m/s", 4}, {"N.m/rad s", 9}, {"N.(m", 3},
      {"N.m)", 4},  {"s10", 2},       {"m.", 3},   {"µm·µq", 4},
  };
  for (const auto& [text, column] : columns) {
    EXPECT_EQ(refused_unit(text).column, column) << text;
  }
}

TEST(ParseUnit, QuotesNoControlCharacters) {
  const std::string message = refused_unit("m\x1b[2J\xff").message;
  EXPECT_THAT(message, HasSubstr("'m\\x1B[2J\\xFF'"));
}

TEST(ParseUnit, DoesNotDependOnTheOrderOfAProduct) {
  const std::array<std::string_view, 8> names{"lbf", "ft2", "s-1", "deg", "kg", "psi", "mA", "h"};
  std::mt19937_64 random(20240611);
  for (int round = 0; round < 500; ++round) {
    std::array<std::string_view, 8> order = names;
    std::shuffle(order.begin(), order.end(), random);
    const std::size_t count = 2 + random() % (order.size() - 1);
    std::string forward;
    std::string backward;
    for (std::size_t i = 0; i < count; ++i) {
      forward += (i == 0 ? "" : ".") + std::string(order[i]);
      backward += (i == 0 ? "" : " ") + std::string(order[count - 1 - i]);
    }
    const io::Unit one = io::parse_unit(forward);
    const io::Unit other = io::parse_unit(backward);
    EXPECT_EQ(one.dimension, other.dimension) << forward;
    expect_same(one.factor, other.factor, forward);
    const io::Unit inverse = io::parse_unit("1/(" + forward + ")");
    expect_same(inverse.factor * one.factor, 1.0, forward);
    EXPECT_EQ(inverse.dimension.angle, -one.dimension.angle) << forward;
  }
}

}  // namespace
}  // namespace boresight::io
