#include <boresight/app/uncertainty/distribution_source.hpp>

namespace boresight::app {

std::string source_text(const design::PlantDistribution& distribution) {
  std::string text =
      distribution.source() == design::EnsembleSource::records
          ? "sampled from the identified distribution, with its correlations"
          : "sampled independently (structure frequencies, oil stiffness, leakage and friction "
            "slope from the [ensemble] ranges, inertias by their uncertainties)";
  if (distribution.varies(design::UncertainInput::wind_torque)) {
    text += "; wind torque by the uncertainties of its coefficient and of the air density";
  }
  return text;
}

}  // namespace boresight::app
