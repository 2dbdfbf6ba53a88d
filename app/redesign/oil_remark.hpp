#pragma once

#include <string>

#include <boresight/plant/antenna/antenna_plant.hpp>

namespace boresight::app {

/// To follow a sentence on a mode: that it is io::little_of_oil, where it is. Else empty.
std::string oil_remark(const plant::PlantMode& mode, const plant::PlantMode& mode_of_oil);

}  // namespace boresight::app
