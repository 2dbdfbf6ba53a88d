#pragma once

#include <vector>

#include <boresight/plant/antenna/antenna.hpp>

namespace boresight::design {

/// Friction slopes (N m s/rad) for Standstill: what the friction curve amounts to
/// (plant::equivalent_friction) in the smallest oscillation that matters, and a third and a sixth
/// of it for larger ones. That oscillation has an amplitude of half an encoder step, below which
/// the loop sees no motion, and a sixth of the hydraulic mode's frequency. Limit cycles of a
/// position loop lie there or below. Slopes not above the antenna's own viscous friction are left
/// out, so that a drive without dry friction has none.
///
/// A condition on the linear loop, and necessary only: a simulation with bristles, backlash and
/// quantisation decides (limit_cycle_search.hpp).
/// @throws InvalidInput as plant::linear_plant; NumericalFailure as plant::hydraulic_mode.
std::vector<double> standstill_friction(const plant::Antenna& antenna);

}  // namespace boresight::design
