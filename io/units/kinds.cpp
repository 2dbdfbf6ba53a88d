#include <array>
#include <cstddef>
#include <cstdlib>
#include <utility>

#include <fmt/format.h>

#include <boresight/io/units/kinds.hpp>
#include <boresight/io/units/wording.hpp>

namespace boresight::io {
namespace {

struct KindEntry {
  Kind kind = Kind::number;
  Dimension dimension;
  KindDescription description;
};

// A dimension that several kinds share is named after the first of them in a message.
constexpr std::array kinds{
    KindEntry{Kind::number, {}, {"number", "1", "0.5, 5 %"}},
    KindEntry{Kind::length, {.length = 1}, {"length", "m", "m, in"}},
    KindEntry{Kind::area, {.length = 2}, {"area", "m2", "m2, in2"}},
    KindEntry{Kind::volume, {.length = 3}, {"volume", "m3", "L, in3"}},
    KindEntry{Kind::mass, {.mass = 1}, {"mass", "kg", "kg, lbm"}},
    KindEntry{Kind::time, {.time = 1}, {"time", "s", "s, ms"}},
    KindEntry{Kind::angle, {.angle = 1}, {"angle", "rad", "deg, rad, rev"}},
    KindEntry{Kind::angular_rate,
              {.time = -1, .angle = 1},
              {"angular rate", "rad/s", "rad/s, deg/s, rpm"}},
    KindEntry{Kind::angular_acceleration,
              {.time = -2, .angle = 1},
              {"angular acceleration", "rad/s2", "rad/s2, deg/s2"}},
    KindEntry{Kind::frequency, {.time = -1, .angle = 1}, {"frequency", "Hz", "Hz, rad/s"}},
    KindEntry{Kind::rate_constant, {.time = -1}, {"rate constant", "1/s", "1/s, 1/min"}},
    KindEntry{Kind::speed, {.length = 1, .time = -1}, {"speed", "m/s", "m/s, mile/h"}},
    KindEntry{Kind::density, {.length = -3, .mass = 1}, {"density", "kg/m3", "kg/m3, lbm/ft3"}},
    KindEntry{Kind::inertia, {.length = 2, .mass = 1}, {"inertia", "kg.m2", "kg.m2, lbf.ft.s2"}},
    KindEntry{Kind::torque, {.length = 2, .mass = 1, .time = -2}, {"torque", "N.m", "N.m, lbf.ft"}},
    KindEntry{Kind::force, {.length = 1, .mass = 1, .time = -2}, {"force", "N", "N, lbf"}},
    KindEntry{
        Kind::pressure, {.length = -1, .mass = 1, .time = -2}, {"pressure", "Pa", "MPa, bar, psi"}},
    KindEntry{Kind::power, {.length = 2, .mass = 1, .time = -3}, {"power", "W", "kW, hp"}},
    KindEntry{Kind::flow, {.length = 3, .time = -1}, {"flow", "m3/s", "L/min, in3/s, US_gal/min"}},
    KindEntry{Kind::displacement,
              {.length = 3, .angle = -1},
              {"displacement", "m3/rad", "cm3/rev, in3/rev"}},
    KindEntry{Kind::stiffness,
              {.length = 2, .mass = 1, .time = -2, .angle = -1},
              {"stiffness", "N.m/rad", "N.m/rad, lbf.ft/deg"}},
    KindEntry{Kind::viscous_friction,
              {.length = 2, .mass = 1, .time = -1, .angle = -1},
              {"viscous friction", "N.m.s/rad", "N.m.s/rad, N.m/rpm"}},
    KindEntry{Kind::compliance,
              {.length = -2, .mass = -1, .time = 2, .angle = 1},
              {"compliance", "rad/(N.m)", "rad/(N.m), deg/(kN.m)"}},
    KindEntry{Kind::voltage,
              {.length = 2, .mass = 1, .time = -3, .current = -1},
              {"voltage", "V", "V, mV"}},
    KindEntry{Kind::current, {.current = 1}, {"current", "A", "A, mA"}},
    KindEntry{Kind::tachometer_scale,
              {.length = -2, .mass = -1, .time = 2, .angle = 1, .current = 1},
              {"tachometer scale", "rad/(s.V)", "rpm/V, deg/(s.V)"}},
    KindEntry{Kind::rate_per_current,
              {.time = -1, .angle = 1, .current = -1},
              {"rate per current", "rad/(s.A)", "rad/(s.A), rad/(s.mA)"}},
    KindEntry{Kind::rate_per_torque,
              {.length = -2, .mass = -1, .time = 1, .angle = 1},
              {"rate per torque", "rad/(s.N.m)", "rad/(s.N.m), rpm/(N.m)"}},
    KindEntry{
        Kind::proportional_gain, {.time = -1}, {"proportional gain", "1/s", "1/s, (rad/s)/rad"}},
    KindEntry{
        Kind::bandwidth_frequency, {.time = -1, .angle = 1}, {"bandwidth", "rad/s", "rad/s, Hz"}},
    KindEntry{Kind::level, {.level = 1}, {"level", "dB", "dB"}},
};

constexpr bool stand_in_order_of_the_enumeration() {
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    if (static_cast<std::size_t>(kinds[i].kind) != i) {
      return false;
    }
  }
  return kinds.back().kind == Kind::level;
}
static_assert(stand_in_order_of_the_enumeration());

const KindEntry& entry(Kind kind) {
  return kinds[static_cast<std::size_t>(kind)];
}

Dimension ratio(const Dimension& a, const Dimension& b) {
  return {a.length - b.length, a.mass - b.mass,       a.time - b.time,
          a.angle - b.angle,   a.current - b.current, a.level - b.level};
}

void append_factor(std::string& product, std::string_view name, int exponent) {
  if (!product.empty()) {
    product += '.';
  }
  product += name;
  if (exponent > 1) {
    product += fmt::format("{}", exponent);
  }
}

std::string in_base_units(const Dimension& dimension) {
  std::string above;
  std::string below;
  int divisors = 0;
  for (const auto& [name, exponent] :
       {std::pair{"kg", dimension.mass}, std::pair{"m", dimension.length},
        std::pair{"rad", dimension.angle}, std::pair{"s", dimension.time},
        std::pair{"A", dimension.current}, std::pair{"dB", dimension.level}}) {
    if (exponent > 0) {
      append_factor(above, name, exponent);
    } else if (exponent < 0) {
      append_factor(below, name, std::abs(exponent));
      ++divisors;
    }
  }
  if (above.empty()) {
    above.push_back('1');
  }
  if (divisors == 0) {
    return above;
  }
  return divisors == 1 ? fmt::format("{}/{}", above, below) : fmt::format("{}/({})", above, below);
}

}  // namespace

const KindDescription& describe(Kind kind) {
  return entry(kind).description;
}

std::string_view usual_unit(Kind kind) {
  if (kind == Kind::number) return "";
  const std::string_view examples = describe(kind).examples;
  return examples.substr(0, examples.find(','));
}

std::string expectation(Kind kind) {
  const KindDescription& description = describe(kind);
  return fmt::format("{} (such as {})", with_article(description.name), description.examples);
}

const Dimension& dimension_of(Kind kind) {
  return entry(kind).dimension;
}

std::string measured_by(const Dimension& dimension) {
  if (dimension == dimension_of(Kind::frequency)) return "a frequency or angular rate";
  for (const KindEntry& known : kinds) {
    if (known.dimension == dimension) {
      return with_article(known.description.name);
    }
  }
  return in_base_units(dimension);
}

std::string dimension_remedy(Kind kind, const Dimension& found) {
  constexpr Dimension acceleration{.length = 1, .time = -2};
  constexpr Dimension per_acceleration{.length = -1, .time = 2};
  const Dimension surplus = ratio(found, dimension_of(kind));
  const std::string_view examples = describe(kind).examples;
  if (kind == Kind::frequency && surplus == Dimension{.angle = -1}) {
    return "it does not tell cycles from radians: write Hz or rad/s";
  }
  if (surplus == Dimension{.angle = surplus.angle}) {
    return fmt::format("the two differ by an angle, which is a dimension: write {}{}", examples,
                       kind == Kind::bandwidth_frequency
                           ? "; a corner is an integral gain over its proportional gain, in rad/s"
                           : "");
  }
  if (kind == Kind::rate_constant && found == dimension_of(Kind::flow)) {
    return fmt::format(
        "write {}; leakage known as a flow is drive.leakage_flow with drive.leakage_pressure",
        examples);
  }
  if (surplus == acceleration) {
    return "a force stands where a mass belongs: write lbm for lbf, or divide by ft/s2";
  }
  if (surplus == per_acceleration) {
    return "a mass stands where a force belongs: write lbf for lbm, kgf for kg";
  }
  return fmt::format("write {}", examples);
}

}  // namespace boresight::io
