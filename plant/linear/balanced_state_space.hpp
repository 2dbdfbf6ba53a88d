#pragma once

#include <boresight/plant/linear/state_space.hpp>

namespace boresight::plant {

/// The same system in balanced states x/s: the same response, to be preferred before any reduction
/// to Hessenberg, Schur or modal form.
StateSpace balanced(const StateSpace& system);

}  // namespace boresight::plant
