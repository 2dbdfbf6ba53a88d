#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace boresight::design {

/// An open end of what a number is held to.
inline constexpr double unbounded = std::numeric_limits<double>::infinity();

/// A number that a physical check compared, or that its result rests on. SI; frequencies in Hz.
struct CheckedNumber {
  std::string name;
  double value = 0.0;
  std::string unit;
  /// What the check holds it to; open where it bounds nothing. Where several numbers have bounds it
  /// takes all of them.
  double lower = -unbounded;
  double upper = unbounded;
};

/// An entry of the antenna's data that a check is about, where there are several that it may be.
struct CheckedEntry {
  std::string id;        // "friction_curve.viscous"
  std::string text;      // as written; empty where it follows from others
  double value = 0.0;    // SI; frequencies in Hz
  bool assumed = false;  // nobody measured or published it
};

/// What came of one comparison of an input or result with physics or with the rest of the data.
struct PhysicalCheck {
  /// What is checked, snake_case: "wave_speed".
  std::string id;
  /// The quantity, by id, that the check is about.
  std::string quantity;
  bool holds = true;
  std::vector<CheckedNumber> numbers = {};
  std::vector<CheckedEntry> entries = {};
  /// What explains a failure, snake_case; empty where the check tells nothing of it.
  std::string explanation = {};

  /// Adds a number, and fails where it is outside its bounds.
  void add(std::string name, double value, std::string unit, double lower = -unbounded,
           double upper = unbounded);

  /// The first number of that name. @throws InvalidInput if there is none.
  const CheckedNumber& number(std::string_view name) const;
};

}  // namespace boresight::design
