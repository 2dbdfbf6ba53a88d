#pragma once

#include <vector>

#include <boresight/identification/resonance/hydraulic_resonance.hpp>

namespace boresight::identification {

/// Inertia from rings after valve steps by one of the four ring readings: the mean over the rings.
/// Its uncertainty includes their scatter and, to first order, stiffness, motor-side inertia,
/// structure and transducers.
/// @throws InvalidInput for no ring or a reading that is not one of rings.
numerics::Interval ring_inertia(ResonanceReading reading, const std::vector<StepRing>& rings,
                                const numerics::Interval& stiffness, const DriveRecord& record,
                                const Campaign& campaign, const ResonanceOptions& options);

/// Leakage rate (1/s) from the rings' damping, with the slope of friction at their speed known
/// (`options.friction_slope`). Loss lambda and inertia satisfy (s + lambda) (Bf + s J(s)) + K = 0
/// for pole s, stiffness K and friction Bf; the orifices' part is subtracted. For a rigid load: 2
/// zeta wn = lambda + Bf/J, wn^2 = (K + Bf lambda)/J.
/// @throws InvalidInput for no ring or no friction slope; NumericalFailure if no loss above 0 fits.
numerics::Interval leakage_from_damping(const std::vector<StepRing>& rings,
                                        const numerics::Interval& stiffness,
                                        const DriveKnowledge& knowledge,
                                        const ResonanceOptions& options);

}  // namespace boresight::identification
