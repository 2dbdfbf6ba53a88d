#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace boresight::design {

/// An open end of an admissible range.
inline constexpr double unbounded = std::numeric_limits<double>::infinity();

/// A number that a physical check compared, or that its result uses. SI; frequencies in Hz.
struct CheckedNumber {
  std::string name;
  double value = 0.0;
  std::string unit;
  /// Admissible range; open where the check sets no bound. If several numbers have bounds, the
  /// check tests all of them.
  double lower = -unbounded;
  double upper = unbounded;
};

/// An entry of the antenna's data concerned by a check, where several are possible.
struct CheckedEntry {
  std::string id;        // "friction_curve.viscous"
  std::string text;      // as written; empty where it is derived
  double value = 0.0;    // SI; frequencies in Hz
  bool assumed = false;  // neither measured nor published
};

/// Result of one comparison of an input or result with physics or with the other data.
struct PhysicalCheck {
  /// What is checked, snake_case: "wave_speed".
  std::string id;
  /// The id of the quantity that the check concerns.
  std::string quantity;
  bool holds = true;
  std::vector<CheckedNumber> numbers = {};
  std::vector<CheckedEntry> entries = {};
  /// Explanation of a failure, snake_case; empty where the check gives none.
  std::string explanation = {};

  /// Adds a number; the check fails if it is outside its bounds.
  void add(std::string name, double value, std::string unit, double lower = -unbounded,
           double upper = unbounded);

  /// The first number with that name. @throws InvalidInput if there is none.
  const CheckedNumber& number(std::string_view name) const;
};

}  // namespace boresight::design
