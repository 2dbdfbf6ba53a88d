#pragma once

#include <boresight/design/limits/pointing_limit.hpp>
#include <boresight/io/description/visitor.hpp>

namespace boresight::io {

/// Controllers against the lower bound of any controller. Numerator and denominator are given
/// beside every ratio.
void describe(Visitor& v, const design::PointingLimit& limit);

}  // namespace boresight::io
