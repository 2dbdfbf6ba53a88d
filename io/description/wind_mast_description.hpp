#pragma once

#include <boresight/io/case/case_file.hpp>
#include <boresight/io/description/visitor.hpp>

namespace boresight::io {

/// The mast that the case's wind speeds are from.
void describe(Visitor& v, const WindMast& mast);

}  // namespace boresight::io
