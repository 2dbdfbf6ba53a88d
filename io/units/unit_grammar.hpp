#pragma once

#include <string>
#include <string_view>

#include <boresight/io/units/unit_names.hpp>

namespace boresight::io {

/// Context of a unit, for messages.
struct UnitPlace {
  /// "an inertia (such as kg.m2, lbf.ft.s2)"
  std::string expected;
  /// The text as its writer sees it, and where in it the unit begins (characters, from 1).
  std::string_view whole;
  int column = 1;
};

/// Reads a unit by the grammar of parse_unit. @throws UnitError, its column within place.whole
ExactUnit read_unit(std::string_view text, const UnitPlace& place);

/// "expected EXPECTED, found 'TOKEN' in 'WHOLE' (REMEDY)". @throws UnitError always
[[noreturn]] void refuse_token(const UnitPlace& place, int column, std::string_view token,
                               std::string_view remedy);

}  // namespace boresight::io
