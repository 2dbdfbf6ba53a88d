#pragma once

#include <vector>

#include <boresight/identification/grey_box/grey_box.hpp>
#include <boresight/plant/antenna/antenna_change.hpp>

namespace boresight::identification {

/// What makes an antenna the one that its records show: inertias, oil, leakage, friction curve and,
/// where the records show the structure, all its frequencies in one proportion. Motors and antenna
/// by the estimate, the gear train as stated. The volumes of oil make up for what the convention
/// about efficiencies makes of the estimated stiffness; nonlinear numbers only where the antenna
/// has a nonlinear drive.
/// @throws NumericalFailure for an estimate that is contradicted, or that leaves the antenna no
/// inertia beside motors and gear train.
std::vector<plant::AntennaChange> identified_changes(const plant::Antenna& antenna,
                                                     const DriveEstimate& estimate);

}  // namespace boresight::identification
