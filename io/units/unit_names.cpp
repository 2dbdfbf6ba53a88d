#include <array>
#include <numbers>
#include <vector>

#include <fmt/format.h>

#include <boresight/io/units/unit_names.hpp>
#include <boresight/io/units/wording.hpp>

namespace boresight::io {
namespace {

constexpr Dimension none{};
constexpr Dimension length{.length = 1};
constexpr Dimension volume{.length = 3};
constexpr Dimension mass{.mass = 1};
constexpr Dimension time{.time = 1};
constexpr Dimension angle{.angle = 1};
constexpr Dimension cycles_per_time{.time = -1, .angle = 1};
constexpr Dimension speed{.length = 1, .time = -1};
constexpr Dimension force{.length = 1, .mass = 1, .time = -2};
constexpr Dimension pressure{.length = -1, .mass = 1, .time = -2};
constexpr Dimension power{.length = 2, .mass = 1, .time = -3};
constexpr Dimension voltage{.length = 2, .mass = 1, .time = -3, .current = -1};
constexpr Dimension current{.current = 1};
constexpr Dimension level{.level = 1};

// Exact by definition: international yard and pound (1959), standard gravity (CGPM 1901).
constexpr long double inch = 0.0254L;
constexpr long double foot = 0.3048L;
constexpr long double pound = 0.45359237L;
constexpr long double gravity = 9.80665L;
constexpr long double pound_force = pound * gravity;
constexpr long double psi = pound_force / (inch * inch);
constexpr long double cycle = 2.0L * std::numbers::pi_v<long double>;
constexpr long double degree = cycle / 360.0L;

struct NamedUnit {
  std::string_view name;
  ExactUnit unit;
};

constexpr std::array unit_list{
    NamedUnit{"%", {0.01L, none}},
    NamedUnit{"m", {1.0L, length}},
    NamedUnit{"km", {1e3L, length}},
    NamedUnit{"cm", {1e-2L, length}},
    NamedUnit{"mm", {1e-3L, length}},
    NamedUnit{"um", {1e-6L, length}},
    NamedUnit{"in", {inch, length}},
    NamedUnit{"ft", {foot, length}},
    NamedUnit{"mile", {5280.0L * foot, length}},
    NamedUnit{"L", {1e-3L, volume}},
    NamedUnit{"mL", {1e-6L, volume}},
    NamedUnit{"cc", {1e-6L, volume}},
    NamedUnit{"US_gal", {231.0L * inch * inch * inch, volume}},
    NamedUnit{"kg", {1.0L, mass}},
    NamedUnit{"g", {1e-3L, mass}},
    NamedUnit{"t", {1e3L, mass}},
    NamedUnit{"lbm", {pound, mass}},
    NamedUnit{"slug", {pound_force / foot, mass}},
    NamedUnit{"s", {1.0L, time}},
    NamedUnit{"ms", {1e-3L, time}},
    NamedUnit{"us", {1e-6L, time}},
    NamedUnit{"min", {60.0L, time}},
    NamedUnit{"h", {3600.0L, time}},
    NamedUnit{"hour", {3600.0L, time}},
    NamedUnit{"rad", {1.0L, angle}},
    NamedUnit{"mrad", {1e-3L, angle}},
    NamedUnit{"urad", {1e-6L, angle}},
    NamedUnit{"deg", {degree, angle}},
    NamedUnit{"mdeg", {degree / 1e3L, angle}},
    NamedUnit{"arcmin", {degree / 60.0L, angle}},
    NamedUnit{"arcsec", {degree / 3600.0L, angle}},
    NamedUnit{"rev", {cycle, angle}},
    NamedUnit{"cycle", {cycle, angle}},
    NamedUnit{"Hz", {cycle, cycles_per_time}},
    NamedUnit{"kHz", {1e3L * cycle, cycles_per_time}},
    NamedUnit{"MHz", {1e6L * cycle, cycles_per_time}},
    NamedUnit{"GHz", {1e9L * cycle, cycles_per_time}},
    NamedUnit{"rpm", {cycle / 60.0L, cycles_per_time}},
    NamedUnit{"knot", {1852.0L / 3600.0L, speed}},
    NamedUnit{"N", {1.0L, force}},
    NamedUnit{"kN", {1e3L, force}},
    NamedUnit{"MN", {1e6L, force}},
    NamedUnit{"lbf", {pound_force, force}},
    NamedUnit{"kip", {1e3L * pound_force, force}},
    NamedUnit{"kgf", {gravity, force}},
    NamedUnit{"Pa", {1.0L, pressure}},
    NamedUnit{"kPa", {1e3L, pressure}},
    NamedUnit{"MPa", {1e6L, pressure}},
    NamedUnit{"GPa", {1e9L, pressure}},
    NamedUnit{"bar", {1e5L, pressure}},
    NamedUnit{"psi", {psi, pressure}},
    NamedUnit{"ksi", {1e3L * psi, pressure}},
    NamedUnit{"W", {1.0L, power}},
    NamedUnit{"kW", {1e3L, power}},
    NamedUnit{"MW", {1e6L, power}},
    NamedUnit{"hp", {550.0L * foot * pound_force, power}},
    NamedUnit{"V", {1.0L, voltage}},
    NamedUnit{"mV", {1e-3L, voltage}},
    NamedUnit{"A", {1.0L, current}},
    NamedUnit{"mA", {1e-3L, current}},
    NamedUnit{"dB", {1.0L, level}},
};

struct RefusedName {
  std::string_view name;
  std::string_view remedy;
};

// Names people do write, which mean several things or nothing exact.
constexpr std::array refused_names{
    RefusedName{"gal", "US, imperial or galileo? write US_gal for 231 in3"},
    RefusedName{"gallon", "US or imperial? write US_gal for 231 in3"},
    RefusedName{"gpm", "US or imperial gallon? write US_gal/min"},
    RefusedName{"oz", "mass, force or volume? convert to lbm, lbf or in3"},
    RefusedName{"ozf", "convert to lbf: 1/16"},
    RefusedName{"ozm", "convert to lbm: 1/16"},
    RefusedName{"lb", "mass or force? write lbm or lbf"},
    RefusedName{"lbs", "mass or force? write lbm or lbf"},
    RefusedName{"pound", "mass or force? write lbm or lbf"},
    RefusedName{"mph", "write mile/h"},
    RefusedName{"kph", "write km/h"},
    RefusedName{"kmh", "write km/h"},
    RefusedName{"kmph", "write km/h"},
    RefusedName{"fps", "write ft/s"},
    RefusedName{"mps", "write m/s"},
    RefusedName{"kn", "speed or force? write knot or kN"},
    RefusedName{"kt", "write knot"},
    RefusedName{"kts", "write knot"},
    RefusedName{"knots", "write knot"},
    RefusedName{"miles", "write mile"},
    RefusedName{"mil", "a thousandth of an inch or of a radian? write in or mrad"},
    RefusedName{"gn", "gravity is no unit here: write the acceleration in m/s2"},
    RefusedName{"gee", "gravity is no unit here: write the acceleration in m/s2"},
    RefusedName{"psig", "gauge or absolute is no part of a unit: write psi"},
    RefusedName{"psia", "gauge or absolute is no part of a unit: write psi"},
    RefusedName{"psid", "gauge or absolute is no part of a unit: write psi"},
    RefusedName{"barg", "gauge or absolute is no part of a unit: write bar"},
    RefusedName{"bara", "gauge or absolute is no part of a unit: write bar"},
    RefusedName{"kpsi", "write ksi"},
    RefusedName{"cis", "write in3/s"},
    RefusedName{"cfm", "write ft3/min"},
    RefusedName{"lpm", "write L/min"},
    RefusedName{"liter", "write L"},
    RefusedName{"litre", "write L"},
    RefusedName{"l", "write L"},
    RefusedName{"ccm", "write cm3"},
    RefusedName{"rps", "revolutions or radians? write rev/s or rad/s"},
    RefusedName{"cps", "write Hz"},
    RefusedName{"turn", "write rev"},
    RefusedName{"degree", "write deg"},
    RefusedName{"degrees", "write deg"},
    RefusedName{"radian", "write rad"},
    RefusedName{"radians", "write rad"},
    RefusedName{"sec", "a time or an angle? write s or arcsec"},
    RefusedName{"second", "write s"},
    RefusedName{"seconds", "write s"},
    RefusedName{"minute", "a time or an angle? write min or arcmin"},
    RefusedName{"minutes", "a time or an angle? write min or arcmin"},
    RefusedName{"hr", "write h"},
    RefusedName{"hours", "write h"},
    RefusedName{"inch", "write in"},
    RefusedName{"inches", "write in"},
    RefusedName{"foot", "write ft"},
    RefusedName{"feet", "write ft"},
    RefusedName{"meter", "write m"},
    RefusedName{"metre", "write m"},
    RefusedName{"micron", "write um"},
    RefusedName{"ton", "metric, short or long? write t, or convert to lbm"},
    RefusedName{"tonne", "write t"},
    RefusedName{"tonnes", "write t"},
    RefusedName{"newton", "write N"},
    RefusedName{"volt", "write V"},
    RefusedName{"watt", "write W"},
    RefusedName{"J", "energy has the dimension of torque: write N.m"},
    RefusedName{"kJ", "energy has the dimension of torque: write kN.m"},
    RefusedName{"Nm", "write N.m"},
    RefusedName{"Nms", "write N.m.s"},
    RefusedName{"kNm", "write kN.m"},
    RefusedName{"ftlb", "a product is '.', and lb is mass or force: write lbf.ft"},
    RefusedName{"ftlbf", "a product is '.': write lbf.ft"},
    RefusedName{"lbft", "a product is '.', and lb is mass or force: write lbf.ft"},
    RefusedName{"lbfft", "a product is '.': write lbf.ft"},
    RefusedName{"inlb", "a product is '.', and lb is mass or force: write lbf.in"},
    RefusedName{"inlbf", "a product is '.': write lbf.in"},
    RefusedName{"lbin", "a product is '.', and lb is mass or force: write lbf.in"},
    RefusedName{"lbfin", "a product is '.': write lbf.in"},
};

}  // namespace

std::optional<ExactUnit> find_unit(std::string_view name) {
  for (const NamedUnit& known : unit_list) {
    if (known.name == name) {
      return known.unit;
    }
  }
  return std::nullopt;
}

std::string unit_name_remedy(std::string_view name) {
  for (const RefusedName& refused : refused_names) {
    if (refused.name == name) {
      return std::string(refused.remedy);
    }
  }
  std::vector<std::string_view> names;
  for (const NamedUnit& known : unit_list) {
    names.push_back(known.name);
  }
  const std::string_view nearest = nearest_name(name, names);
  return nearest.empty() ? "unknown unit"
                         : fmt::format("unknown unit, did you mean '{}'?", nearest);
}

}  // namespace boresight::io
