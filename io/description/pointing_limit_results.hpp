#pragma once

#include <boresight/design/limits/pointing_limit.hpp>
#include <boresight/io/description/visitor.hpp>

namespace boresight::io {

/// Laws against the least any controller could do: every number that a ratio is made of stands
/// beside it.
void describe(Visitor& v, const design::PointingLimit& limit);

}  // namespace boresight::io
