#pragma once

#include <string>
#include <vector>

#include "coverage_case.hpp"

namespace boresight::coverage {

/// What many campaigns say of one quantity by one method.
struct CoverageRow {
  std::string quantity, method;
  std::size_t campaigns = 0;
  std::size_t given = 0;    // in which the method gave an interval
  std::size_t covered = 0;  // in which it holds the truth; none given is not covered
  double half_width = 0.0;  // median, relative to the truth's size
  double bias = 0.0;        // median of estimate less truth, relative to the truth's size
  // Estimate less truth over the standard uncertainty.
  double median_error = 0.0;
  double rms_error = 0.0;
  double fraction() const { return static_cast<double>(covered) / static_cast<double>(campaigns); }
  /// Binomial standard uncertainty of the fraction.
  double fraction_uncertainty() const;
};

/// By the rows of the first case; at least one.
std::vector<CoverageRow> coverage_rows(const std::vector<CoverageCase>& cases);

/// The table and, below it, the campaigns that a method gave nothing in, and why.
std::string markdown(const std::vector<CoverageCase>& cases);

/// Every number of every campaign, as CSV.
std::string details(const std::vector<CoverageCase>& cases);

}  // namespace boresight::coverage
