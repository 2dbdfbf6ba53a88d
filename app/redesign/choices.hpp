#pragma once

#include <optional>
#include <vector>

#include <boresight/app/report/report.hpp>

namespace boresight::app {

/// One choice among the numbers of a case, still without its design.
struct PlantChoice {
  ChoiceResult result;
  std::optional<plant::Antenna> antenna;  // none where the choice leaves no plant
};

/// The case's own antenna first, then what else its numbers may mean: other antenna inertias, the
/// other convention for the oil spring, other antennas of the frequencies stated with the motors
/// held, other places of the guessed shares of wind and beam (io::GuessedShares), and what
/// resonance and impulses say of oil spring or inertia: the resonance of the flexible antenna
/// (bulk_modulus_for) first, then of rigid masses.
std::vector<PlantChoice> plant_choices(const io::Case& antenna);

}  // namespace boresight::app
