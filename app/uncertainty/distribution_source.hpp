#pragma once

#include <string>

#include <boresight/design/ensembles/plant_distribution.hpp>

namespace boresight::app {

/// Where a distribution comes from, for reports.
std::string source_text(const design::PlantDistribution& distribution);

}  // namespace boresight::app
