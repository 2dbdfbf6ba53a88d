#pragma once

#include <string>
#include <utility>
#include <vector>

#include <boresight/design/decisions/confidence.hpp>
#include <boresight/design/decisions/negligible_change.hpp>

namespace boresight::app {

using design::negligible_change;

/// A change of the rms above this fraction is reported whatever its cause.
inline constexpr double telling_change = design::telling_effect;

/// What moves the rms, beside what a study is about.
class Influences {
 public:
  /// Input `what` changes the rms by the fraction `change`; negligible and undefined changes do not
  /// count.
  void add(double change, std::string what);
  /// The three largest as a sentence with a leading blank, " The rms depends more on the wind model
  /// (by 97 %), the loop structure (by 31 %)."; empty if there is none.
  std::string sentence() const;

 private:
  std::vector<std::pair<double, std::string>> changes_;
};

}  // namespace boresight::app
