#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>

#include <fmt/format.h>

#include <boresight/io/units/kinds.hpp>
#include <boresight/io/units/unit_grammar.hpp>
#include <boresight/io/units/units.hpp>
#include <boresight/io/units/wording.hpp>

namespace boresight::io {
namespace {

constexpr std::size_t nowhere = std::string_view::npos;

/// A number as written: how much of the text it is, and the value of half its last digit.
struct WrittenNumber {
  double value = 0.0;
  double half_unit = 0.0;
  std::size_t length = 0;
};

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

std::size_t digits_from(std::string_view text, std::size_t begin) {
  return std::min(text.find_first_not_of("0123456789", begin), text.size()) - begin;
}

template <typename Number>
std::optional<Number> whole_number(std::string_view text) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size()) {
    return std::nullopt;
  }
  return number;
}

/// "1,5", "1,500", "1'500", "1.234.5": reads as different numbers in different countries.
[[noreturn]] void refuse_separators(std::string_view text, const UnitPlace& place) {
  const std::size_t end = std::min(text.find_first_not_of("0123456789.,'_"), text.size());
  const std::string_view token = text.substr(0, end);
  const std::size_t comma = token.find(',');
  const bool single = comma != nowhere && token.find_first_of(".,'_", comma + 1) == nowhere &&
                      token.find_first_of(".'_") == nowhere;
  if (!single) {
    refuse_token(place, place.column, token,
                 "write digits without separators and one decimal point");
  }
  const std::string_view before = token.substr(0, comma);
  const std::string_view after = token.substr(comma + 1);
  std::string remedy = fmt::format("the decimal sign is a point: write {}.{}", before,
                                   after.empty() ? std::string_view("0") : after);
  if (after.size() == 3) {
    remedy += fmt::format(", or {}{} if it is thousands", before, after);
  }
  refuse_token(place, place.column, token, remedy);
}

[[noreturn]] void refuse_start(std::string_view text, const UnitPlace& place) {
  const std::string_view token = text.substr(0, std::min(text.find(' '), text.size()));
  const std::size_t sign = token.find_first_not_of("+-");
  const std::string_view bare = sign == nowhere ? std::string_view{} : token.substr(sign);
  if (bare.size() > 1 && bare[0] == '.' && is_digit(bare[1])) {
    refuse_token(place, place.column, token, "write the zero before the point");
  }
  constexpr std::array<std::string_view, 3> not_finite{"inf", "nan", "infinity"};
  const std::string_view nearest = nearest_name(bare, not_finite);
  if (!nearest.empty() && nearest.size() == bare.size()) {
    refuse_token(place, place.column, token, "a number must be finite");
  }
  refuse_token(place, place.column, token, "a number comes first, then its unit");
}

/// Reads [+-] digits [. digits] [e [+-] digits] at the start of a text, whatever the locale.
WrittenNumber read_number(std::string_view text, const UnitPlace& place) {
  const std::size_t sign = text[0] == '+' || text[0] == '-' ? 1 : 0;
  const std::size_t whole_digits = digits_from(text, sign);
  if (whole_digits == 0) {
    refuse_start(text, place);
  }
  std::size_t end = sign + whole_digits;
  std::size_t decimals = 0;
  if (end < text.size() && text[end] == '.') {
    decimals = digits_from(text, end + 1);
    end += 1 + decimals;
    if (decimals == 0) {
      refuse_token(place, place.column, text.substr(0, end),
                   "digits must follow the point, or leave it out");
    }
  }
  int exponent = 0;
  bool representable = decimals < 400;
  if (end < text.size() && (text[end] == 'e' || text[end] == 'E')) {
    const std::size_t minus = text.substr(end + 1, 1) == "-" ? 1 : 0;
    const std::size_t signs = text.substr(end + 1, 1) == "+" ? 1 : minus;
    const std::size_t digits = digits_from(text, std::min(end + 1 + signs, text.size()));
    if (digits > 0) {
      const auto size = whole_number<int>(text.substr(end + 1 + signs, digits));
      representable = representable && size && *size < 1000;
      exponent = representable ? (minus == 1 ? -*size : *size) : 0;
      end += 1 + signs + digits;
    }
  }
  if (end < text.size() && std::string_view(".,'_").find(text[end]) != nowhere) {
    refuse_separators(text, place);
  }
  if (end + 1 < text.size() && (text[end] == 'x' || text[end] == 'X') && text[end - 1] == '0') {
    refuse_token(place, place.column, text.substr(0, std::min(text.find(' '), text.size())),
                 "write a decimal number");
  }
  WrittenNumber number;
  number.length = end;
  if (representable) {
    const std::size_t begin = text[0] == '+' ? 1 : 0;  // from_chars takes no '+'
    const auto value = whole_number<double>(text.substr(begin, end - begin));
    const auto half_unit =
        whole_number<double>(fmt::format("5e{}", exponent - static_cast<int>(decimals) - 1));
    if (value && half_unit) {
      number.value = *value;
      number.half_unit = *half_unit;
      return number;
    }
  }
  refuse_token(place, place.column, text.substr(0, end), "a number must fit double precision");
}

/// The factor to what the program works in: SI, but cycles for a frequency.
long double working_factor(const ExactUnit& unit, Kind kind) {
  constexpr long double cycle = 2.0L * std::numbers::pi_v<long double>;
  return kind == Kind::frequency ? unit.factor / cycle : unit.factor;
}

ExactUnit unit_of_kind(std::string_view text, const UnitPlace& place, Kind kind) {
  const ExactUnit unit = read_unit(text, place);
  if (unit.dimension != dimension_of(kind)) {
    throw UnitError(
        fmt::format("expected {}, found {}, {} ({})", place.expected, in_quotes(place.whole),
                    measured_by(unit.dimension), dimension_remedy(kind, unit.dimension)),
        place.column);
  }
  return unit;
}

}  // namespace

Unit parse_unit(std::string_view text) {
  const ExactUnit unit = read_unit(text, {"a unit (such as N.m, in3/rev, 1/s)", text, 1});
  return {static_cast<double>(unit.factor), unit.dimension};
}

PrintedNumber parse_quantity(std::string_view text, Kind kind) {
  UnitPlace place{expectation(kind), text, 1};
  const std::size_t begin = text.find_first_not_of(' ');
  if (begin == nowhere) {
    refuse_token(place, 1, text, "write a number and its unit");
  }
  const std::string_view written = text.substr(begin, text.find_last_not_of(' ') - begin + 1);
  place.column += static_cast<int>(begin);
  const WrittenNumber number = read_number(written, place);

  const std::size_t unit_begin =
      std::min(written.find_first_not_of(' ', number.length), written.size());
  const std::string_view unit_text = written.substr(unit_begin);
  ExactUnit unit;
  if (!unit_text.empty()) {
    UnitPlace unit_place = place;
    unit_place.column += static_cast<int>(unit_begin);
    unit = unit_of_kind(unit_text, unit_place, kind);
  } else if (kind != Kind::number) {
    throw UnitError(fmt::format("expected {}, found {}, which has no unit (write '{} {}')",
                                place.expected, in_quotes(written), written, usual_unit(kind)),
                    place.column);
  }

  const long double factor = working_factor(unit, kind);
  PrintedNumber printed{static_cast<double>(number.value * factor),
                        static_cast<double>(number.half_unit * factor), std::string(written)};
  const bool lost =
      number.value != 0.0 && std::abs(printed.value) < std::numeric_limits<double>::min();
  if (!std::isfinite(printed.value) || !std::isfinite(printed.half_unit) || lost) {
    refuse_token(place, place.column, written, "a quantity must fit double precision in SI units");
  }
  return printed;
}

}  // namespace boresight::io
