#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include <boresight/io/records/column_words.hpp>
#include <boresight/io/records/recorded_unit.hpp>

namespace boresight::io {
namespace {

std::optional<Unit> unit_as_in_a_case(const std::string& text) {
  try {
    return parse_unit(text);
  } catch (const UnitError&) {
    return std::nullopt;
  }
}

}  // namespace

std::optional<Unit> recorded_unit(const std::string& text) {
  if (const auto unit = unit_as_in_a_case(text)) return unit;
  constexpr std::array<std::pair<std::string_view, std::string_view>, 52> names{
      {{"v", "V"},
       {"volt", "V"},
       {"volts", "V"},
       {"vdc", "V"},
       {"v dc", "V"},
       {"mv", "mV"},
       {"ma", "mA"},
       {"a", "A"},
       {"amp", "A"},
       {"amps", "A"},
       {"sec", "s"},
       {"secs", "s"},
       {"second", "s"},
       {"seconds", "s"},
       {"msec", "ms"},
       {"millisec", "ms"},
       {"min", "min"},
       {"psi", "psi"},
       {"psig", "psi"},
       {"psia", "psi"},
       {"psid", "psi"},
       {"lbf/in2", "psi"},
       {"lb/in2", "psi"},
       {"kpa", "kPa"},
       {"mpa", "MPa"},
       {"pa", "Pa"},
       {"bar", "bar"},
       {"barg", "bar"},
       {"rpm", "rpm"},
       {"1/min", "rpm"},
       {"rev/min", "rpm"},
       {"deg/sec", "deg/s"},
       {"degrees/s", "deg/s"},
       {"dps", "deg/s"},
       {"\xC2\xB0/s", "deg/s"},
       {"rad/sec", "rad/s"},
       {"percent", "%"},
       {"degree", "deg"},
       {"degrees", "deg"},
       {"\xC2\xB0", "deg"},
       {"mdeg", "mdeg"},
       {"millideg", "mdeg"},
       {"arcsec", "arcsec"},
       {"radian", "rad"},
       {"radians", "rad"},
       {"mps", "m/s"},
       {"m/sec", "m/s"},
       {"mph", "mile/h"},
       {"kph", "km/h"},
       {"kmh", "km/h"},
       {"km/hr", "km/h"},
       {"knots", "knot"}}};
  std::string wanted = lower(text);
  if (wanted == "s" || wanted == "ms") return parse_unit(wanted);
  if (wanted == "\xB0/s") wanted = "deg/s";  // Latin-1
  if (wanted == "deg/s" || wanted == "rad/s") return parse_unit(wanted);
  const auto* const found = std::find_if(names.begin(), names.end(),
                                         [&](const auto& name) { return name.first == wanted; });
  return found != names.end() ? std::optional(parse_unit(found->second)) : std::nullopt;
}

}  // namespace boresight::io
