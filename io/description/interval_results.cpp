#include <boresight/io/description/interval_results.hpp>

namespace boresight::io {
namespace {

void describe_members(Visitor& v, const numerics::Interval& interval, std::string_view unit) {
  const KeyUnit as_named{.suffix = "si"};
  v.defined_as("interval",
               "A result with its central 95 % interval, in the SI unit named (Hz for "
               "frequencies).");
  v.text("unit", unit.empty() ? "1" : unit, "The unit; 1 for none.");
  v.number("value", interval.value, as_named, "The value.");
  v.number("standard_uncertainty", interval.standard_uncertainty, as_named, "1 sigma.",
           {.minimum = 0.0});
  v.number("lower_95", interval.lower, as_named, "Lower end.");
  v.number("upper_95", interval.upper, as_named, "Upper end; null where it has none.");
}

}  // namespace

void describe_interval(Visitor& v, std::string_view key, const numerics::Interval& interval,
                       std::string_view unit, std::string_view meaning) {
  v.group(key, meaning, [&] { describe_members(v, interval, unit); });
}

void describe_interval(Visitor& v, std::string_view key,
                       const std::optional<numerics::Interval>& interval, std::string_view unit,
                       std::string_view meaning) {
  v.optional_group(key, interval, meaning,
                   [&](const numerics::Interval& there) { describe_members(v, there, unit); });
}

}  // namespace boresight::io
