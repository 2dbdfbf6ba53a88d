#pragma once

#include <cstdint>
#include <vector>

#include <boresight/design/problem/mission.hpp>

namespace boresight::design {

/// Where an ensemble comes from.
enum class EnsembleSource {
  ranges,   // drawn from the ranges of AntennaUncertainty
  records,  // drawn from the posterior of an identification
};
/// "sampled from the ranges of the case", "sampled from the identified distribution".
std::string_view to_string(EnsembleSource source);

/// The perturbed models that controllers are held against.
struct PlantEnsemble {
  EnsembleSource source = EnsembleSource::ranges;
  std::vector<EnsembleMember> members;
};

/// The mission's own plant ("nominal"), five corners with one end of one range each (both of
/// structure and oil, the lower of leakage) and a Latin hypercube of AntennaUncertainty::draws over
/// all four ranges, the same for a seed.
/// @throws InvalidInput as plant::changed and plant::linear_plant.
std::vector<EnsembleMember> plant_members(const Mission& mission, std::uint64_t seed);

}  // namespace boresight::design
