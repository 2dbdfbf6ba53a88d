#pragma once

#include <cstdint>
#include <vector>

#include <boresight/design/problem/mission.hpp>

namespace boresight::design {

/// Source of an ensemble.
enum class EnsembleSource {
  ranges,   // sampled from the ranges of AntennaUncertainty
  records,  // sampled from the posterior of an identification
};
/// "sampled from the ranges of the case", "sampled from the identified distribution".
std::string_view to_string(EnsembleSource source);

/// The perturbed models on which controllers are evaluated.
struct PlantEnsemble {
  EnsembleSource source = EnsembleSource::ranges;
  std::vector<EnsembleMember> members;
};

/// Samples the ensemble: the mission's own plant ("nominal"), five with one input at an end of its
/// range (both ends for structure and oil, the lower for leakage), and a Latin hypercube of
/// AntennaUncertainty::random_samples over all four ranges. The same seed gives the same members.
/// @throws InvalidInput as plant::changed and plant::linear_plant.
std::vector<EnsembleMember> plant_members(const Mission& mission, std::uint64_t seed);

/// Plants with several inputs of PlantDistribution::of_ranges at an end: every combination of both
/// ends of structure frequency, oil stiffness and antenna inertia, of those that vary: 1 to 8
/// plants. Leakage and friction are at their lower ends, which damp least, other inputs at their
/// medians. The ends are the 5 % and 95 % quantiles.
/// @throws InvalidInput as plant::changed and plant::linear_plant.
std::vector<EnsembleMember> corner_members(const Mission& mission);

}  // namespace boresight::design
