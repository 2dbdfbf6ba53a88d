#pragma once

#include <optional>
#include <vector>

#include <boresight/app/report/report.hpp>

namespace boresight::app {

/// One choice among the numbers of a case, still without its design.
struct PlantInterpretation {
  InterpretationResult result;
  std::optional<plant::Antenna> antenna;  // none where the choice leaves no plant
};

/// io::antenna_readings of the case, in words.
std::vector<PlantInterpretation> plant_interpretations(const io::Case& antenna);

}  // namespace boresight::app
