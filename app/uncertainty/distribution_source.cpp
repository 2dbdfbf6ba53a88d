#include <boresight/app/uncertainty/distribution_source.hpp>

namespace boresight::app {

std::string source_text(const design::PlantDistribution& distribution) {
  std::string text =
      distribution.source() == design::EnsembleSource::records
          ? "draws from what the records leave open, with their correlations"
          : "independent draws of structure frequencies, oil stiffness, leakage and friction slope "
            "from the [ensemble]'s ranges and of the inertias by their uncertainties";
  if (distribution.varies(design::UncertainInput::wind_torque)) {
    text += "; the wind torque by the uncertainties stated of its coefficient and of the air";
  }
  return text;
}

}  // namespace boresight::app
