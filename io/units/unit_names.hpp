#pragma once

#include <optional>
#include <string>
#include <string_view>

#include <boresight/io/units/units.hpp>

namespace boresight::io {

/// A unit before its factor is rounded to double, so that "psi" or "kHz" is rounded once only.
struct ExactUnit {
  long double factor = 1.0L;
  Dimension dimension;
};

/// A name of the closed list, prefix included; case sensitive.
std::optional<ExactUnit> find_unit(std::string_view name);

/// What to write instead of a name that is not in the list: "mass or force? write lbm or lbf",
/// "unknown unit, did you mean 'kPa'?".
std::string unit_name_remedy(std::string_view name);

}  // namespace boresight::io
