#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <boresight/io/units/unit_grammar.hpp>
#include <boresight/io/units/wording.hpp>

namespace boresight::io {
namespace {

constexpr int deepest_parenthesis = 8;
constexpr int largest_exponent = 9;
constexpr int largest_dimension = 30;

constexpr std::array<std::string_view, 4> product_signs{".", "*", "\u00B7", "\u22C5"};
constexpr std::string_view superscript_minus = "\u207B";
constexpr std::array<std::string_view, 10> superscript_digits{
    "\u2070", "\u00B9", "\u00B2", "\u00B3", "\u2074",
    "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
// The micro sign and the Greek letter look alike; both are typed for the prefix.
constexpr std::array<std::string_view, 2> micro_signs{"\u00B5", "\u03BC"};

constexpr std::array<std::pair<std::string_view, std::string_view>, 5> sign_remedies{{
    {"\u00B0", "write deg"},
    {"\u2032", "write arcmin or ft"},
    {"\u2033", "write arcsec or in"},
    {"\u2212", "write '-' for a minus"},
    {"\u00B1", "an uncertainty has a key of its own"},
}};

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_name_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '%';
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(' ');
  return first == std::string_view::npos
             ? std::string_view{}
             : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

Dimension combine(const Dimension& a, const Dimension& b, int power) {
  return {a.length + power * b.length, a.mass + power * b.mass,       a.time + power * b.time,
          a.angle + power * b.angle,   a.current + power * b.current, a.level + power * b.level};
}

ExactUnit times_power(ExactUnit left, const ExactUnit& right, int power) {
  for (int i = 0; i < power; ++i) {
    left.factor *= right.factor;
  }
  for (int i = 0; i > power; --i) {
    left.factor /= right.factor;
  }
  left.dimension = combine(left.dimension, right.dimension, power);
  return left;
}

bool is_sound(const ExactUnit& unit) {
  const Dimension& d = unit.dimension;
  for (const int exponent : {d.length, d.mass, d.time, d.angle, d.current, d.level}) {
    if (exponent < -largest_dimension || exponent > largest_dimension) {
      return false;
    }
  }
  const auto factor = static_cast<double>(unit.factor);
  return factor >= std::numeric_limits<double>::min() &&
         factor <= std::numeric_limits<double>::max();
}

/// Recursive descent over one unit text.
class UnitReader {
 public:
  UnitReader(std::string_view text, const UnitPlace& place) : text_(text), place_(place) {}

  ExactUnit read() {
    if (trimmed(text_).empty()) {
      refuse(0, text_, "a plain number has the unit 1");
    }
    refuse_hyphen();
    const ExactUnit unit = quotient(0);
    if (!at_end()) {
      refuse(at_, ")", "no parenthesis is open here");
    }
    return unit;
  }

 private:
  ExactUnit quotient(int depth) {
    const std::size_t begin = at_;
    skip_blanks();
    ExactUnit result = factor(depth, true);
    while (true) {
      const bool blank = skip_blanks();
      if (at_end() || text_[at_] == ')') {
        return result;
      }
      const std::size_t separator = at_;
      if (take("/")) {
        return divide(result, begin, separator, depth);
      }
      if (!take_product() && !blank) {
        refuse(at_, character(), unexpected_remedy());
      }
      skip_blanks();
      result = checked(times_power(result, factor(depth, false), 1), begin);
    }
  }

  /// A division ends its part of the unit: what follows a divisor reads both ways.
  ExactUnit divide(const ExactUnit& dividend, std::size_t begin, std::size_t slash, int depth) {
    skip_blanks();
    const std::size_t divisor_begin = at_;
    const ExactUnit divisor = factor(depth, false);
    const std::size_t divisor_end = at_;
    skip_blanks();
    if (at_end() || text_[at_] == ')') {
      return checked(times_power(dividend, divisor, -1), begin);
    }
    const std::string_view left = trimmed(text_.substr(begin, slash - begin));
    const std::string_view below = text_.substr(divisor_begin, divisor_end - divisor_begin);
    const std::size_t separator = at_;
    const std::string_view sign = character();
    if (take("/")) {
      refuse(separator, sign,
             fmt::format("a second division reads two ways: write {}/({}.{})", left, below,
                         name_ahead()));
    }
    take_product();
    const std::string_view next = name_ahead();
    refuse(separator, separator == at_ ? next : sign,
           fmt::format("a product after a division reads two ways: write {0}/({1}.{2}) or "
                       "{0}.{2}/{1}",
                       left, below, next));
  }

  ExactUnit factor(int depth, bool first) {
    const std::size_t begin = at_;
    if (at_end()) {
      refuse(at_, "", "a unit's name is missing at the end");
    }
    if (take("(")) {
      if (depth == deepest_parenthesis) {
        refuse(begin, "(", "too many parentheses");
      }
      const ExactUnit inside = quotient(depth + 1);
      if (!take(")")) {
        refuse(begin, "(", "')' is missing");
      }
      return checked(times_power({}, inside, exponent()), begin);
    }
    if (is_digit(text_[at_])) {
      return one(first);
    }
    const std::string name = take_name();
    if (name.empty()) {
      refuse(begin, character(), unexpected_remedy());
    }
    const std::optional<ExactUnit> unit = find_unit(name);
    if (!unit) {
      refuse(begin, text_.substr(begin, at_ - begin), unit_name_remedy(name));
    }
    return checked(times_power({}, *unit, exponent()), begin);
  }

  /// The 1 of "1" and of "1/s": a number has no other place in a unit.
  ExactUnit one(bool first) {
    const std::size_t begin = at_;
    const std::string_view digits = take_digits();
    skip_blanks();
    const bool complete = at_end() || text_[at_] == '/' || text_[at_] == ')';
    if (digits != "1" || !first || !complete) {
      refuse(begin, digits,
             "a unit holds no number but the 1 of '1/s'; an exponent follows its name directly, "
             "and a number is written without gaps");
    }
    return {};
  }

  int exponent() {
    const std::size_t begin = at_;
    const bool caret = take("^");
    int sign = 1;
    std::string digits;
    if (caret || is_signed_digit()) {
      if (take("-")) {
        sign = -1;
      }
      digits = take_digits();
    } else {
      if (take(superscript_minus)) {
        sign = -1;
      }
      digits = take_superscripts();
    }
    if (at_ == begin) {
      return 1;
    }
    // One digit from 1 to 9: a longer or no exponent is a typing error in any unit of mechanics.
    if (digits.size() != 1 || digits == "0") {
      refuse(begin, text_.substr(begin, at_ - begin),
             fmt::format("an exponent is a whole number from 1 to {} or its negative",
                         largest_exponent));
    }
    return sign * (digits[0] - '0');
  }

  /// Before all else, so that "lb-ft" is told both of its errors at once.
  void refuse_hyphen() {
    for (std::size_t i = 0; i < text_.size(); ++i) {
      if (text_[i] != '-' || (i > 0 && text_[i - 1] == '^') ||
          (i + 1 < text_.size() && is_digit(text_[i + 1]))) {
        continue;
      }
      std::size_t begin = i;
      while (begin > 0 && is_name_letter(text_[begin - 1])) {
        --begin;
      }
      const std::string_view left = text_.substr(begin, i - begin);
      at_ = i + 1;
      const std::string right = take_name();
      std::string remedy =
          left.empty() && right.empty() ? "the unit of a plain number is 1" : "a product is '.'";
      if (left == "lb" || right == "lb") {
        remedy += fmt::format(", and lb is mass or force: write lbf.{}",
                              left == "lb" ? std::string_view(right) : left);
      } else if (!left.empty() && !right.empty()) {
        remedy += fmt::format(": write {}.{}", left, right);
      }
      refuse(i, "-", remedy);
    }
  }

  ExactUnit checked(const ExactUnit& unit, std::size_t begin) const {
    if (!is_sound(unit)) {
      refuse(begin, text_.substr(begin, at_ - begin), "its exponents are out of all bounds");
    }
    return unit;
  }

  std::string unexpected_remedy() const {
    const std::string_view sign = character();
    for (const auto& [known, remedy] : sign_remedies) {
      if (sign == known) {
        return std::string(remedy);
      }
    }
    if (sign == "/") {
      return "nothing stands before the division: write '1/s' for per second, a fraction as its "
             "value";
    }
    return "a unit is names joined by '.' and at most one '/'";
  }

  bool at_end() const { return at_ == text_.size(); }

  bool skip_blanks() {
    const std::size_t begin = at_;
    at_ = std::min(text_.find_first_not_of(' ', at_), text_.size());
    return at_ > begin;
  }

  bool take(std::string_view sign) {
    if (text_.substr(at_, sign.size()) != sign) {
      return false;
    }
    at_ += sign.size();
    return true;
  }

  bool take_product() {
    return std::any_of(product_signs.begin(), product_signs.end(),
                       [this](std::string_view sign) { return take(sign); });
  }

  std::string take_name() {
    const bool micro = std::any_of(micro_signs.begin(), micro_signs.end(),
                                   [this](std::string_view sign) { return take(sign); });
    std::string name = micro ? "u" : "";
    while (!at_end() && is_name_letter(text_[at_])) {
      name += text_[at_++];
    }
    return name;
  }

  std::string_view take_digits() {
    const std::size_t begin = at_;
    while (!at_end() && is_digit(text_[at_])) {
      ++at_;
    }
    return text_.substr(begin, at_ - begin);
  }

  std::string take_superscripts() {
    std::string digits;
    for (std::size_t digit = 0; digit < superscript_digits.size();) {
      if (take(superscript_digits[digit])) {
        digits += static_cast<char>('0' + digit);
        digit = 0;
      } else {
        ++digit;
      }
    }
    return digits;
  }

  bool is_signed_digit() const {
    const std::size_t digit = at_ + (text_.substr(at_, 1) == "-" ? 1 : 0);
    return digit < text_.size() && is_digit(text_[digit]);
  }

  /// The factor that follows, for a remedy that can be copied.
  std::string_view name_ahead() {
    skip_blanks();
    const std::string_view rest = text_.substr(at_);
    const std::size_t end = rest.find_first_of(" ./*()");
    return rest.empty() ? "..." : rest.substr(0, end == 0 ? 1 : end);
  }

  std::string_view character() const {
    std::size_t end = at_ + 1;
    while (end < text_.size() && (static_cast<unsigned char>(text_[end]) & 0xC0U) == 0x80U) {
      ++end;
    }
    return at_end() ? std::string_view{} : text_.substr(at_, end - at_);
  }

  [[noreturn]] void refuse(std::size_t begin, std::string_view token,
                           std::string_view remedy) const {
    refuse_token(place_, place_.column + character_count(text_.substr(0, begin)), token, remedy);
  }

  std::string_view text_;
  const UnitPlace& place_;
  std::size_t at_ = 0;
};

}  // namespace

ExactUnit read_unit(std::string_view text, const UnitPlace& place) {
  return UnitReader(text, place).read();
}

void refuse_token(const UnitPlace& place, int column, std::string_view token,
                  std::string_view remedy) {
  std::string found = token.empty() ? "nothing" : in_quotes(token);
  if (token != place.whole) {
    found += " in " + in_quotes(place.whole);
  }
  throw UnitError(fmt::format("expected {}, found {} ({})", place.expected, found, remedy), column);
}

}  // namespace boresight::io
