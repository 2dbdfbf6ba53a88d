#pragma once

#include <string>

#include <boresight/io/units/units.hpp>

namespace boresight::io {

/// The dimension every unit of this kind must have.
const Dimension& dimension_of(Kind kind);

/// What a dimension measures, for "found ...": "a torque", or "kg.m2/s" if no kind has it.
std::string measured_by(const Dimension& dimension);

/// How to mend a unit of the wrong dimension; falls back on the kind's examples.
std::string dimension_remedy(Kind kind, const Dimension& found);

}  // namespace boresight::io
