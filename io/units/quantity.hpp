#pragma once

#include <string>
#include <vector>

#include <boresight/io/units/units.hpp>

namespace boresight::io {

/// The basis of a number.
enum class Basis { unstated, measured, published, inferred, assumed };
std::string_view to_string(Basis basis);

/// A location in a file; line and column count from 1.
struct Location {
  std::string file;
  int line = 0;
  int column = 0;
};

/// One number of a case file with its author's annotations. SI; frequencies in Hz.
struct Quantity {
  double value = 0.0;
  /// Standard uncertainty (1 sigma): as given, else the printed rounding's, half_unit / sqrt(3).
  double standard_uncertainty = 0.0;
  bool uncertainty_given = false;
  /// Half a unit of the last printed digit.
  double half_unit = 0.0;
  /// As written, "0.22177 lbf.ft.s2".
  std::string text;
  /// The same number printed again in other units, for the audit.
  std::vector<PrintedNumber> also;
  Kind kind = Kind::number;
  Basis basis = Basis::unstated;
  std::string source;
  /// Source of the uncertainty ("assumed: usual for ...").
  std::string uncertainty_source;
  /// Full key path, "oil.line[0].length".
  std::string key;
  Location location;
};

/// Standard uncertainty over the value's size; 0 where the value is 0.
double relative_uncertainty(const Quantity& quantity);

/// A number computed from `from`, and possibly others: with the same location and source. The
/// caller sets its uncertainty.
Quantity derived_quantity(const Quantity& from, Kind kind, double value, std::string_view unit);

/// Physical range of a field, SI. Open ends by default.
struct Range {
  double minimum = -1e300;
  double maximum = 1e300;
  bool minimum_excluded = false;

  static constexpr Range any() noexcept { return {}; }
  static constexpr Range positive(double maximum = 1e300) noexcept { return {0.0, maximum, true}; }
  static constexpr Range not_negative(double maximum = 1e300) noexcept {
    return {0.0, maximum, false};
  }
  static constexpr Range between(double minimum, double maximum) noexcept {
    return {minimum, maximum, false};
  }
};

}  // namespace boresight::io
