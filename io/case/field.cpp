#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include <fmt/format.h>

#include <boresight/io/case/field.hpp>
#include <boresight/io/units/wording.hpp>

namespace boresight::io {
namespace {

// A whole number that stands in quotation marks.
bool is_quoted_integer(const TomlNode& node) {
  return node.type == TomlType::text && !node.text.empty() &&
         node.text.find_first_not_of("0123456789") == std::string::npos;
}

// What `boresight new` writes where something is to be filled in.
bool is_blank(const TomlNode& node) {
  return node.type == TomlType::text && node.text == "?";
}

std::string found_text(const TomlNode& node) {
  switch (node.type) {
    case TomlType::text:
      return is_blank(node) ? "'?', a blank to fill in" : in_quotes(node.text);
    case TomlType::integer:
      return "the integer " + node.text;
    case TomlType::number:
      return "the number " + node.text;
    case TomlType::boolean:
      return node.boolean ? "true" : "false";
    case TomlType::date:
      return "a date or time";
    case TomlType::list:
      return node.elements.empty() ? "an empty list" : "a list";
    case TomlType::table:
      break;
  }
  return "a table";
}

/// "from 1 to 9", "above 0", "at least 0", "at most 5"; nothing without bounds.
std::string bounds(const std::string& minimum, bool minimum_excluded, const std::string& maximum) {
  if (minimum.empty()) {
    return maximum.empty() ? "" : "at most " + maximum;
  }
  if (maximum.empty()) {
    return (minimum_excluded ? "above " : "at least ") + minimum;
  }
  return minimum_excluded ? fmt::format("above {} and at most {}", minimum, maximum)
                          : fmt::format("from {} to {}", minimum, maximum);
}

Field element(const Field& list, std::size_t index) {
  return {list.node.elements[index], fmt::format("{}[{}]", list.path, index), list.file};
}

}  // namespace

void refuse_at(const Location& location, std::string_view path, std::string_view message) {
  throw InvalidInput(fmt::format("{}:{}:{}: {}{}{}", location.file, location.line, location.column,
                                 path, path.empty() ? "" : ": ", message));
}

void refuse_field(const Field& field, std::string_view expected, std::string_view remedy) {
  refuse_at(field.location(), field.path,
            fmt::format("expected {}, found {}{}", expected, found_text(field.node), remedy));
}

std::string did_you_mean(std::string_view misspelt, const std::vector<std::string_view>& known) {
  const std::string_view nearest = nearest_name(misspelt, known);
  return nearest.empty() ? "" : fmt::format(" (did you mean {}?)", in_quotes(nearest));
}

std::string quoted_list(const std::vector<std::string_view>& names) {
  std::string list;
  for (const std::string_view name : names) {
    list += (list.empty() ? "" : ", ") + in_quotes(name);
  }
  return list;
}

std::string read_text(const Field& field) {
  if (is_blank(field.node)) refuse_field(field, "a text");
  if (field.node.type != TomlType::text) {
    refuse_field(field, "a text", " (a text stands in quotes)");
  }
  return field.node.text;
}

std::vector<std::string> read_texts(const Field& field) {
  if (field.node.type != TomlType::list) {
    refuse_field(field, "a list of texts", " (a list stands in brackets)");
  }
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < field.node.elements.size(); ++i) {
    texts.push_back(read_text(element(field, i)));
  }
  return texts;
}

std::string read_choice(const Field& field, const std::vector<std::string>& choices) {
  const std::vector<std::string_view> names(choices.begin(), choices.end());
  const std::string expected = "one of " + quoted_list(names);
  if (field.node.type != TomlType::text || is_blank(field.node)) {
    refuse_field(field, expected);
  }
  if (std::find(choices.begin(), choices.end(), field.node.text) == choices.end()) {
    refuse_field(field, expected, did_you_mean(field.node.text, names));
  }
  return field.node.text;
}

long read_integer(const Field& field, long minimum, long maximum) {
  const std::int64_t value = field.node.integer;
  if (field.node.type == TomlType::integer && value >= minimum && value <= maximum) {
    return static_cast<long>(value);
  }
  using Limits = std::numeric_limits<long>;
  const std::string range = bounds(minimum > Limits::min() ? fmt::format("{}", minimum) : "", false,
                                   maximum < Limits::max() ? fmt::format("{}", maximum) : "");
  refuse_field(field, range.empty() ? "an integer" : "an integer " + range,
               is_quoted_integer(field.node)
                   ? fmt::format(" (write {}, without quotation marks)", field.node.text)
                   : "");
}

bool read_boolean(const Field& field) {
  if (field.node.type != TomlType::boolean) {
    refuse_field(field, "true or false");
  }
  return field.node.boolean;
}

PrintedNumber read_printed(const Field& field, Kind kind) {
  const TomlNode& node = field.node;
  const bool bare = node.type == TomlType::integer || node.type == TomlType::number;
  if ((!bare && node.type != TomlType::text) || is_blank(node)) {
    refuse_field(field, expectation(kind));
  }
  if (bare && kind != Kind::number) {
    refuse_field(field, expectation(kind),
                 fmt::format(", which has no unit (write \"{} {}\")", node.text, usual_unit(kind)));
  }
  std::string number = node.text;
  if (bare) {
    // TOML's own digit separator, read correctly by TOML.
    number.erase(std::remove(number.begin(), number.end(), '_'), number.end());
  }
  try {
    return parse_quantity(number, kind);
  } catch (const UnitError& error) {
    Location where = field.location();
    where.column += node.verbatim ? error.column : 0;
    refuse_at(where, field.path, error.what());
  }
}

std::vector<PrintedNumber> read_printed_list(const Field& field, Kind kind) {
  if (field.node.type != TomlType::list) {
    return {read_printed(field, kind)};
  }
  std::vector<PrintedNumber> numbers;
  for (std::size_t i = 0; i < field.node.elements.size(); ++i) {
    numbers.push_back(read_printed(element(field, i), kind));
  }
  return numbers;
}

double read_uncertainty(const Field& field, const Quantity& of) {
  const std::string& text = field.node.text;
  const std::size_t last = text.find_last_not_of(' ');
  const bool relative =
      field.node.type == TomlType::text && last != std::string::npos && text[last] == '%';
  const PrintedNumber number = read_printed(field, relative ? Kind::number : of.kind);
  if (number.value < 0.0) {
    refuse_field(field, "an uncertainty of at least 0");
  }
  if (relative && of.value == 0.0) {
    refuse_field(field, expectation(of.kind), ", relative to a value of 0");
  }
  return relative ? number.value * std::abs(of.value) : number.value;
}

void check_range(const Field& field, const PrintedNumber& number, Kind kind, const Range& range) {
  const bool too_small =
      number.value < range.minimum || (range.minimum_excluded && number.value == range.minimum);
  if (!too_small && number.value <= range.maximum) {
    return;
  }
  const auto& [name, si_unit, examples] = describe(kind);
  const std::string unit = kind == Kind::number ? "" : fmt::format(" {}", si_unit);
  const auto bound = [&unit](double value, double open) {
    return value == open ? "" : fmt::format("{}{}", value, unit);
  };
  const bool converted = !number.text.ends_with(unit) || number.text.ends_with('%');
  refuse_at(field.location(), field.path,
            fmt::format("expected {} {}, found {}{}", with_article(name),
                        bounds(bound(range.minimum, Range::any().minimum), range.minimum_excluded,
                               bound(range.maximum, Range::any().maximum)),
                        in_quotes(number.text),
                        converted ? fmt::format(", which is {:.6g}{}", number.value, unit) : ""));
}

}  // namespace boresight::io
