#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <utility>

#include <fmt/format.h>

#include <boresight/design/audit/printed_number.hpp>

namespace boresight::design {
namespace {

bool is_digit(char character) {
  return character >= '0' && character <= '9';
}

// from_chars and not strtod: the same in every locale.
double number_at_head(const std::string& text, std::size_t* length) {
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  *length = error == std::errc{} ? static_cast<std::size_t>(end - text.data()) : 0;
  return *length == 0 ? 0.0 : number;
}

std::size_t mantissa_length(const std::string& text) {
  std::size_t length = 0;
  while (length < text.size() &&
         (is_digit(text[length]) || text[length] == '.' || text[length] == '-')) {
    ++length;
  }
  return length;
}

PrintedForm reread(const PrintedForm& original, const std::string& text) {
  std::size_t length = 0;
  PrintedForm form = original;
  form.text = text;
  form.value = number_at_head(text, &length) * unit_factor(original);
  return form;
}

double step_of_last_digit(const PrintedForm& form) {
  return 2.0 * form.half_unit / std::abs(unit_factor(form));
}

double scale_to_digits(double value, int digits) {
  return value == 0.0 ? 1.0 : std::pow(10.0, digits - 1 - std::floor(std::log10(std::abs(value))));
}

}  // namespace

double printed_value(const PrintedForm& form) {
  std::size_t length = 0;
  return number_at_head(form.text, &length);
}

double unit_factor(const PrintedForm& form) {
  const double number = printed_value(form);
  return number == 0.0 ? 1.0 : form.value / number;
}

std::string reprint(const PrintedForm& form, double value, int extra_digits) {
  std::size_t length = 0;
  number_at_head(form.text, &length);
  const std::string unit = form.text.substr(length);
  const double number = value / unit_factor(form);
  const bool scientific = form.text.substr(0, length).find_first_of("eE") != std::string::npos;
  if (scientific) {
    return fmt::format("{:.{}e}{}", number, std::max(0, printed_digits(form) - 1 + extra_digits),
                       unit);
  }
  const double step = step_of_last_digit(form);
  const int decimals =
      step > 0.0 ? static_cast<int>(std::lround(-std::log10(step))) : printed_digits(form);
  return fmt::format("{:.{}f}{}", number, std::max(0, decimals + extra_digits), unit);
}

double cut_like(const PrintedForm& form, double value) {
  const double step = 2.0 * form.half_unit;
  return step > 0.0 ? std::trunc(value / step * (1.0 + 1e-12)) * step : value;
}

double round_to_digits(double value, int digits) {
  const double scale = scale_to_digits(value, digits);
  return std::round(value * scale) / scale;
}

double cut_to_digits(double value, int digits) {
  const double scale = scale_to_digits(value, digits);
  return std::trunc(value * scale * (1.0 + 1e-12)) / scale;
}

int printed_digits(const PrintedForm& form) {
  int digits = 0;
  for (const char character : form.text.substr(0, mantissa_length(form.text))) {
    if (is_digit(character) && (digits > 0 || character != '0')) ++digits;
  }
  return digits;
}

std::vector<PrintedForm> transposed_digits(const PrintedForm& form) {
  std::vector<PrintedForm> variants;
  std::size_t previous = std::string::npos;
  for (std::size_t i = 0; i < mantissa_length(form.text); ++i) {
    if (!is_digit(form.text[i])) continue;
    if (previous != std::string::npos && form.text[previous] != form.text[i]) {
      std::string text = form.text;
      std::swap(text[previous], text[i]);
      variants.push_back(reread(form, text));
    }
    previous = i;
  }
  return variants;
}

std::vector<PrintedForm> changed_digits(const PrintedForm& form) {
  std::vector<PrintedForm> variants;
  for (std::size_t i = 0; i < mantissa_length(form.text); ++i) {
    if (!is_digit(form.text[i])) continue;
    for (char digit = '0'; digit <= '9'; ++digit) {
      if (digit == form.text[i]) continue;
      std::string text = form.text;
      text[i] = digit;
      variants.push_back(reread(form, text));
    }
  }
  return variants;
}

std::vector<PrintedForm> omitted_digits(const PrintedForm& form) {
  std::vector<PrintedForm> variants;
  for (std::size_t i = 0; i < mantissa_length(form.text); ++i) {
    if (!is_digit(form.text[i])) continue;
    std::string text = form.text;
    text.erase(i, 1);
    if (text.empty() || !is_digit(text[0])) continue;
    variants.push_back(reread(form, text));
  }
  return variants;
}

}  // namespace boresight::design
