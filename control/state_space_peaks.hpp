#pragma once

#include <array>

#include <boresight/control/loop_evaluator.hpp>

namespace boresight::control {

/// Peaks of |S| at the three breaks by a route of its own: the plant's state space, diagonalised
/// (poles and residues instead of dynamic stiffnesses), the law's state space, exact dead time, on
/// a grid refined at the closed loop's own lightly damped poles, each local maximum polished by
/// golden section. Order of loop_breaks. O(states) a frequency.
/// @throws NumericalFailure if the plant has no independent eigenvectors.
std::array<SensitivityPeak, 3> state_space_peaks(const plant::AntennaPlant& plant,
                                                 const ControlLaw& law, double delay,
                                                 double lowest_frequency, double highest_frequency);

}  // namespace boresight::control
