#pragma once

#include <boresight/plant/antenna/antenna_plant.hpp>
#include <boresight/plant/modal/modal_system.hpp>

namespace boresight::plant {

/// The vibration modes of a free antenna (as StructureModel takes them, about the axis or at the
/// motor shaft) as masses on springs from the bull gear: the same motion in the other form. Each
/// mass keeps its own share of the free modes' damping; what couples masses through the damping is
/// left out, which is of second order in the damping ratios. The masses are the modes with the bull
/// gear held (R. R. Craig, M. C. C. Bampton, Coupling of substructures for dynamic analyses, AIAA
/// Journal 6(7), 1968): n modes, the free turn among them, give n - 1 in order of frequency; wind
/// fractions and beam weights are per turn of the whole antenna and sum to 1 with those of the bull
/// gear. Several wind forces count as one, their sum. The gear spring is no part of the free
/// antenna: locked_rotor_frequency is left at 0.
///
/// A mass that the bull gear's motion does not move (inertia below 1e-9 of the whole) is left out.
/// @throws InvalidInput for modes as structure_dynamics, without a wind force, if a turn of the
/// whole antenna does not turn encoder and beam by the same angle or does not take the whole wind
/// torque (within 1 %), if the encoder does not follow the bull gear in every mode (within 1e-6),
/// and if a mass that would be left out moves the beam in wind; NumericalFailure if the eigenvalues
/// do not converge.
StructureSpecification hold_bull_gear(const VibrationModes& modes);

}  // namespace boresight::plant
