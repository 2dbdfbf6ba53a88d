#include "coverage_table.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

namespace boresight::coverage {
namespace {

double median(std::vector<double> numbers) {
  if (numbers.empty()) return 0.0;
  std::sort(numbers.begin(), numbers.end());
  const std::size_t middle = numbers.size() / 2;
  return numbers.size() % 2 == 1 ? numbers[middle] : 0.5 * (numbers[middle - 1] + numbers[middle]);
}

bool covers(const numerics::Interval& interval, double truth) {
  return interval.lower <= truth && truth <= interval.upper;
}

CoverageRow row_of(const std::vector<CoverageCase>& cases, std::size_t index) {
  const Evaluated& first = cases.front().rows[index];
  CoverageRow row;
  row.quantity = first.quantity;
  row.method = first.method;
  row.campaigns = cases.size();
  std::vector<double> half_widths, biases, errors;
  double squares = 0.0;
  for (const auto& one : cases) {
    const Evaluated& evaluated = one.rows[index];
    if (!evaluated.interval) continue;
    const auto& interval = *evaluated.interval;
    ++row.given;
    if (covers(interval, evaluated.truth)) ++row.covered;
    const double size = std::abs(evaluated.truth);
    const double error = interval.value - evaluated.truth;
    half_widths.push_back(0.5 * (interval.upper - interval.lower) / size);
    biases.push_back(error / size);
    errors.push_back(error / interval.standard_uncertainty);
    squares += errors.back() * errors.back();
  }
  row.half_width = median(half_widths);
  row.bias = median(biases);
  row.median_error = median(errors);
  if (row.given > 0) row.rms_error = std::sqrt(squares / static_cast<double>(row.given));
  return row;
}

}  // namespace

double CoverageRow::fraction_uncertainty() const {
  return std::sqrt(fraction() * (1.0 - fraction()) / static_cast<double>(campaigns));
}

std::vector<CoverageRow> coverage_rows(const std::vector<CoverageCase>& cases) {
  std::vector<CoverageRow> rows;
  for (std::size_t i = 0; i < cases.front().rows.size(); ++i) rows.push_back(row_of(cases, i));
  return rows;
}

std::string markdown(const std::vector<CoverageCase>& cases) {
  std::string text =
      "| quantity | method | given | covered | half-width | bias | normalised |\n"
      "|---|---|---|---|---|---|---|\n";
  for (const auto& row : coverage_rows(cases)) {
    text += fmt::format(
        "| {} | {} | {} of {} | {:.1f} +- {:.1f} % | {:.2f} % | {:+.2f} % | "
        "{:+.2f}, {:.2f} |\n",
        row.quantity, row.method, row.given, row.campaigns, 100.0 * row.fraction(),
        100.0 * row.fraction_uncertainty(), 100.0 * row.half_width, 100.0 * row.bias,
        row.median_error, row.rms_error);
  }
  std::string failures;
  for (const auto& one : cases) {
    for (const auto& failure : one.failures) {
      failures += fmt::format("- campaign {} of seed {}: {}\n", one.number, one.seed, failure);
    }
  }
  text += failures.empty() ? "\nEvery method gave a result in every campaign.\n"
                           : "\nMethods that gave nothing (not covered):\n\n" + failures;
  return text;
}

std::string details(const std::vector<CoverageCase>& cases) {
  std::string text =
      "seed,campaign,quantity,method,truth,value,standard_uncertainty,lower,upper,covered,"
      "largest_departure\n";
  for (const auto& one : cases) {
    for (const auto& row : one.rows) {
      if (!row.interval) continue;
      const auto& i = *row.interval;
      fmt::format_to(std::back_inserter(text),
                     "{},{},{},\"{}\",{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{},{:.3g}\n", one.seed,
                     one.number, row.quantity, row.method, row.truth, i.value,
                     i.standard_uncertainty, i.lower, i.upper, covers(i, row.truth) ? 1 : 0,
                     one.largest_departure);
    }
  }
  return text;
}

}  // namespace boresight::coverage
