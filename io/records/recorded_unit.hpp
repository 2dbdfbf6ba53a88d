#pragma once

#include <optional>
#include <string>

#include <boresight/io/units/units.hpp>

namespace boresight::io {

/// A unit as recorders write it: as in a case, in any case of letters and with a few names more
/// (volts, sec, psig, deg/sec, knots, mph, a degree sign). Nothing if it has no unit known.
std::optional<Unit> recorded_unit(const std::string& text);

}  // namespace boresight::io
