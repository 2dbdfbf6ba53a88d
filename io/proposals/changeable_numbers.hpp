#pragma once

#include <functional>
#include <vector>

#include <boresight/io/case/case_declaration.hpp>
#include <boresight/io/units/quantity.hpp>

namespace boresight::io {

/// A number of a case that proposals may change, in a table of the same name.
struct ChangeableNumber {
  const char* table = "";
  const char* key = "";
  Kind kind = Kind::number;
  Range range;  // of the number once changed
  /// Its location in a case; none if the case has no such table.
  Quantity* (*in)(Case& antenna) = nullptr;

  std::string path() const { return std::string(table) + "." + key; }
};

/// All of them but those that need more than a place in the case: counts, teeth, assemblies, lines,
/// the gear spring, all modes at once, the sampling rate.
const std::vector<ChangeableNumber>& changeable_numbers();

}  // namespace boresight::io
