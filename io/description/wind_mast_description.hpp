#pragma once

#include <boresight/io/description/visitor.hpp>
#include <boresight/plant/wind/wind_mast.hpp>

namespace boresight::io {

/// The mast that the case's wind speeds are from.
void describe(Visitor& v, const plant::WindMast& mast);

}  // namespace boresight::io
