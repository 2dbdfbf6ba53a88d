#pragma once

#include <boresight/plant/antenna/antenna_plant.hpp>
#include <boresight/plant/modal/modal_system.hpp>

namespace boresight::plant {

/// Converts the vibration modes of a free antenna to masses on springs from the bull gear, with the
/// same motion. The modes are those of StructureModel, about the axis or at the motor shaft. Each
/// mass keeps its own part of the free modes' damping. Damping coupling between masses is
/// neglected, which is of second order in the damping ratios.
/// The masses are the modes with the bull gear locked (R. R. Craig, M. C. C. Bampton, Coupling of
/// substructures for dynamic analyses, AIAA Journal 6(7), 1968). n modes, including the free
/// rotation, give n - 1 in order of frequency. Wind fractions and beam weights are per rotation of
/// the whole antenna and sum to 1 with those of the bull gear. Several wind forces count as one,
/// their sum. The gear spring is no part of the free antenna: locked_rotor_frequency stays 0.
///
/// A mass that the bull gear's motion does not move (inertia below 1e-9 of the whole) is left out.
/// @throws InvalidInput for modes as structure_dynamics; without a wind force; if a rotation of the
/// whole antenna does not rotate encoder and boresight by the same angle or does not take the whole
/// wind torque (within 1 %). Also if the encoder does not follow the bull gear in every mode
/// (within 1e-6), or if a mass to be left out moves the boresight in wind. NumericalFailure if the
/// eigenvalues do not converge.
StructureSpecification hold_bull_gear(const VibrationModes& modes);

}  // namespace boresight::plant
