#pragma once

#include <vector>

#include <boresight/io/case/case_declaration.hpp>
#include <boresight/numerics/statistics/uncertain.hpp>
#include <boresight/plant/antenna/antenna_change.hpp>

namespace boresight::io {

/// The antenna that a case describes, in SI and without what the case says about its numbers. Of
/// several antennas that have the stated frequencies (structure_specifications) the one with the
/// softest gear spring. Where the case names fewer lines than motors, those between have lengths
/// evenly between the shortest and the longest.
/// @throws InvalidInput as structure_specifications, and for an assembly with neither inertia nor
/// dimensions.
plant::Antenna antenna_of(const Case& stated);

/// The same without its structure, whose modes may take time to solve for: motors, gear train, oil,
/// valve, friction, sensors.
plant::Antenna drive_of(const Case& stated);

/// All those antennas, the softest gear spring first.
std::vector<plant::Antenna> antennas_of(const Case& stated);

/// The linear plant of antenna_of(stated), so changed.
/// @throws InvalidInput as antenna_of, plant::changed and plant::linear_plant.
plant::AntennaPlant make_plant(const Case& stated,
                               const std::vector<plant::AntennaChange>& changes = {});

/// Inertia of one assembly about its own axis (kg m2), with its standard uncertainty: as stated for
/// the whole, else the sum of its parts' inertias or disks.
/// @throws InvalidInput for a part with neither inertia nor dimensions.
numerics::Uncertain assembly_inertia(const Case& stated, const RotatingAssembly& assembly);

}  // namespace boresight::io
