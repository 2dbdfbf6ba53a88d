#include "accuracy_table.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include <fmt/format.h>

namespace boresight::reference {

namespace {

std::string text_of(const std::vector<double>& numbers) {
  if (numbers.size() > 4) return fmt::format("{} numbers", numbers.size());
  std::string text;
  for (const double number : numbers) {
    text += (text.empty() ? "" : ", ") + fmt::format("{:.12g}", number);
  }
  return numbers.empty() ? "none" : text;
}

std::string text_of(const Eigen::MatrixXd& matrix) {
  return fmt::format("{} x {} matrix", matrix.rows(), matrix.cols());
}

double largest(const std::vector<double>& numbers) {
  double result = 0.0;
  for (const double number : numbers) result = std::max(result, std::abs(number));
  return result;
}

/// The largest error relative to `scale` or, where that is 0, to each number itself (to 1 where it
/// is 0 too). Equal infinities are no error.
double error_of(const std::vector<double>& found, const std::vector<double>& reference,
                double scale = 0.0) {
  if (found.size() != reference.size()) return HUGE_VAL;
  double worst = 0.0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (found[i] == reference[i]) continue;
    const double own = reference[i] == 0.0 ? 1.0 : std::abs(reference[i]);
    const double off = std::abs(found[i] - reference[i]) / (scale > 0.0 ? scale : own);
    worst = std::isfinite(off) ? std::max(worst, off) : HUGE_VAL;
  }
  return worst;
}

/// One digit where the digits of the reference decide the error; where rounding does, the power of
/// ten above.
std::string text_of_error(double error, int digits) {
  if (!std::isfinite(error)) return "infinite";
  if (error > 1e-9 && error < std::pow(10.0, 1 - digits)) return fmt::format("{:.0e}", error);
  return fmt::format("< {:.0e}", std::max(std::pow(10.0, std::ceil(std::log10(error))), 1e-15));
}

/// In lines of at most a hundred characters.
std::string wrapped(const std::string& text) {
  std::istringstream words(text);
  std::string result, line;
  for (std::string word; words >> word;) {
    if (!line.empty() && line.size() + 1 + word.size() > 100) {
      result += line + "\n";
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
  }
  return result + line;
}

int digits_of(const PrintedNumber& number) {
  if (number.value == 0.0) return 1;
  return 1 + static_cast<int>(std::floor(std::log10(std::abs(number.value)) -
                                         std::log10(2.0 * number.half_unit) + 1e-9));
}

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream text(line);
  for (std::string cell; std::getline(text, cell, '|');) cells.push_back(cell);
  return cells;
}

constexpr std::size_t error_column = 5;  // of a row's cells, the first being before the first bar

/// log10 of "< 1e-12" or "3e-05", or nan.
double decade_of(std::string cell) {
  cell.erase(0, cell.find_first_of("0123456789"));
  const auto number = std::strtod(cell.c_str(), nullptr);
  return number > 0.0 ? std::log10(number) : std::nan("");
}

/// Whether the rows differ at most in an error by up to a factor of ten.
bool same_row(const std::string& found, const std::string& expected) {
  auto left = cells_of(found), right = cells_of(expected);
  if (left.size() != right.size() || left.size() <= error_column) return found == expected;
  auto& error = left[error_column];
  if (std::abs(decade_of(error) - decade_of(right[error_column])) <= 1.0) {
    error = right[error_column];
  }
  return left == right;
}

}  // namespace

std::vector<PrintedNumber> flattened(const std::vector<std::vector<PrintedNumber>>& rows) {
  std::vector<PrintedNumber> result;
  for (const auto& row : rows) result.insert(result.end(), row.begin(), row.end());
  return result;
}

std::vector<double> flattened(const Eigen::MatrixXd& matrix) {
  std::vector<double> result;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) result.push_back(matrix(i, j));
  }
  return result;
}

void AccuracySection::numbers(const std::string& name, const std::string& quantity,
                              const std::vector<double>& found,
                              const std::vector<double>& reference, int digits, double tolerance,
                              const std::string& remark) {
  if (reference.empty()) {
    stated(name, quantity, "none", found.empty(), remark);
    return;
  }
  const double error = error_of(found, reference);
  rows_.push_back({name, quantity, text_of(reference), digits, error,
                   fmt::format("{:.0e}", tolerance), error <= tolerance, remark});
}

void AccuracySection::matrix(const std::string& name, const std::string& quantity,
                             const Eigen::MatrixXd& found, const Eigen::MatrixXd& reference,
                             int digits, double tolerance, const std::string& remark) {
  const auto values = flattened(reference);
  const double error = error_of(flattened(found), values, largest(values));
  rows_.push_back({name, quantity, reference.size() > 4 ? text_of(reference) : text_of(values),
                   digits, error, fmt::format("{:.0e}", tolerance),
                   error <= tolerance && found.rows() == reference.rows(), remark});
}

void AccuracySection::printed(const std::string& name, const std::string& quantity,
                              const std::vector<double>& found,
                              const std::vector<PrintedNumber>& reference,
                              const std::string& remark) {
  std::vector<double> values;
  int digits = 0;
  bool holds = found.size() == reference.size();
  for (std::size_t i = 0; i < reference.size(); ++i) {
    const auto& [value, half_unit] = reference[i];
    values.push_back(value);
    digits = std::max(digits, digits_of(reference[i]));
    if (!holds) continue;
    // The printed decimal is itself rounded to binary: a tie is within half a unit.
    const double allowed = std::max(half_unit * (1.0 + 1e-9), 1e-9 * std::abs(value));
    holds = std::abs(found[i] - value) <= allowed;
  }
  rows_.push_back({name, quantity, text_of(values), digits,
                   error_of(found, values, largest(values)), "last digit", holds, remark});
}

void AccuracySection::stated(const std::string& name, const std::string& quantity,
                             const std::string& reference, bool holds, const std::string& remark) {
  rows_.push_back({name, quantity, reference, 0, 0.0, "", holds, remark});
}

bool AccuracySection::holds() const {
  return std::all_of(rows_.begin(), rows_.end(), [](const AccuracyRow& row) { return row.holds; });
}

std::string AccuracySection::markdown() const {
  std::string text = fmt::format("## {}\n\n{}\n\n", title_, wrapped(text_));
  text += "| case | quantity | reference | digits | error | asked | verdict |\n";
  text += "|---|---|---|---|---|---|---|\n";
  for (const AccuracyRow& row : rows_) {
    const std::string digits = row.digits > 0 ? fmt::format("{}", row.digits) : "";
    const std::string error = row.asked.empty() ? "" : text_of_error(row.error, row.digits);
    const std::string verdict = row.holds ? "holds" : "FAILS";
    text += fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n", row.name, row.quantity,
                        row.reference, digits, error, row.asked,
                        row.remark.empty() ? verdict : verdict + "; " + row.remark);
  }
  return text;
}

bool same_table(const std::string& found, const std::string& expected, std::string& difference) {
  std::istringstream left(found), right(expected);
  for (int number = 1;; ++number) {
    std::string a, b;
    const bool more_a = static_cast<bool>(std::getline(left, a));
    const bool more_b = static_cast<bool>(std::getline(right, b));
    if (!more_a && !more_b) return true;
    if (more_a != more_b || !same_row(a, b)) {
      difference = fmt::format("line {}:\n  found    {}\n  expected {}", number, a, b);
      return false;
    }
  }
}

}  // namespace boresight::reference
