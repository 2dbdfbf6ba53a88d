#include <cmath>

#include <boresight/app/report/common_description.hpp>
#include <boresight/io/description/visitor.hpp>
#include <boresight/io/files/renamed_keys.hpp>

namespace boresight::app {

void describe_origin(io::Visitor& v, std::string_view command,
                     std::span<const std::string_view> commands) {
  v.constant("program", "boresight", "Always boresight.");
  v.text("version", BORESIGHT_VERSION, "Version of the program.",
         {.pattern = R"(^[0-9]+\.[0-9]+\.[0-9]+$)"});
  if (commands.empty()) {
    v.constant("command", command, "The command.");
  } else {
    v.word("command", command, commands, "The command.");
  }
}

void describe_axis(io::Visitor& v, const io::PointingAxis& axis) {
  v.word("axis", axis.name, {"elevation", "azimuth", "X", "Y"},
         "The axis: X is the lower and Y the upper axis of an X-Y mount.");
  v.number(
      "boresight_factor", axis.boresight_factor, {.suffix = "1"},
      "Boresight error over axis error: the cosine of the elevation for an azimuth axis, of the "
      "Y angle for an X axis.");
}

void describe_case(io::Visitor& v, std::string_view path, std::string_view title,
                   const io::PointingAxis& axis) {
  v.group("case", "The case file.", [&] {
    v.text("path", path, "As given.");
    v.text("title", title, "Its title.");
    describe_axis(v, axis);
  });
}

void describe_superseded(io::Visitor& v, const std::vector<io::SupersededInput>& inputs) {
  constexpr io::KeyUnit as_named{.suffix = "si"};
  v.list("superseded_inputs", inputs, "Inputs of the case that its records have replaced.",
         [&](const io::SupersededInput& input) {
           v.text("key", input.key, "Its key in the case file.");
           v.text("unit", input.unit, "SI, of the values.");
           v.text_or_null("stated", input.stated, "As written; null: derived.");
           v.flag("assumed", input.assumed, "The case assumed it, in value or in uncertainty.");
           v.number("stated_value", input.stated_value, as_named, "Of the case.");
           v.number("value", input.value, as_named, "Of the records.");
           v.number("standard_uncertainty", input.standard_uncertainty, as_named, "1 sigma.");
         });
}

void describe_assumed(io::Visitor& v, const std::vector<io::Quantity>& assumed) {
  v.list("assumed_inputs", assumed, "Inputs whose value or uncertainty is assumed.",
         [&](const io::Quantity& quantity) {
           const bool value = quantity.basis == io::Basis::assumed;
           v.text("key", quantity.key, "Its key in the case file.");
           v.text("value", quantity.text, "As written.");
           v.word("assumed", value ? "value" : "uncertainty", {"value", "uncertainty"},
                  "What of it is assumed.");
           v.text("source", value ? quantity.source : quantity.uncertainty_source, "Why this.");
         });
}

void describe_renamed_keys(io::Visitor& v) {
  v.list("renamed_keys", io::renamed_keys(),
         "Keys that reports of version 0.1 had under other names; listed in this version only.",
         [&](const io::RenamedKey& key) {
           v.text("before", key.before, "In version 0.1; behind a dot: in that object only.");
           v.text("now", key.now, "In this report.");
         });
}

void describe_fraction_of_time(io::Visitor& v, const std::vector<design::ClimatePart>& climate,
                               double speed, std::string_view meaning) {
  const bool known = !climate.empty() && !std::isnan(speed);
  v.number("fraction_of_time",
           known ? std::optional(design::fraction_of_time(climate, speed)) : std::nullopt,
           io::key_units::ratio, meaning, {.minimum = 0.0, .maximum = 1.0});
}

}  // namespace boresight::app
