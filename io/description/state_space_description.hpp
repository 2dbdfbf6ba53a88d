#pragma once

#include <boresight/io/description/visitor.hpp>
#include <boresight/plant/linear/state_space.hpp>

namespace boresight::io {

/// The members of state_space_json.
void describe(Visitor& v, const plant::StateSpace& system);

}  // namespace boresight::io
