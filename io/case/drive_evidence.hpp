#pragma once

#include <boresight/identification/campaign/inertia_methods.hpp>
#include <boresight/io/case/case_declaration.hpp>

namespace boresight::io {

/// What a case states for identification::identify_inertia: the resonance only where
/// rings_as_rigid, the antenna's alternatives only where they are of the same attitude.
/// @throws InvalidInput and NumericalFailure as make_plant and plant::plant_modes, with a
/// resonance.
identification::DriveEvidence make_evidence(const Case& antenna);

}  // namespace boresight::io
