#include <algorithm>
#include <cmath>

#include <boresight/numerics/error.hpp>
#include <boresight/plant/antenna/motors_held_modes.hpp>
#include <boresight/plant/antenna/moved_held_modes.hpp>

namespace boresight::plant {
namespace {

constexpr double reached = 1e-10;  // relative
constexpr int max_rounds = 200;

// Moves each mode by what its frequency with the motors held is off; the largest ratio it was off
// by, less 1.
double move_once(StructureSpecification& antenna,
                 const std::vector<std::optional<double>>& frequencies) {
  const auto held = motors_held_modes(make_structure(antenna));
  double farthest = 0.0;
  const std::size_t count = std::min({antenna.modes.size(), frequencies.size(), held.size()});
  for (std::size_t j = 1; j < count; ++j) {
    if (!frequencies[j]) continue;
    const double ratio = *frequencies[j] / held[j].frequency;
    antenna.modes[j].frequency *= ratio;
    farthest = std::max(farthest, std::abs(ratio - 1.0));
  }
  return farthest;
}

}  // namespace

std::optional<StructureSpecification> with_motors_held_frequencies(
    StructureSpecification antenna, const std::vector<std::optional<double>>& frequencies) {
  if (frequencies.empty() || !frequencies.front()) return std::nullopt;
  const double scale = *frequencies.front() / antenna.locked_rotor_frequency;
  antenna.locked_rotor_frequency = *frequencies.front();
  for (auto& mode : antenna.modes) mode.frequency *= scale;
  try {
    for (int round = 0; round < max_rounds; ++round) {
      if (move_once(antenna, frequencies) <= reached) return antenna;
    }
  } catch (const InvalidInput&) {
    // A mode went below the lowest frequency with the motors held.
    return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace boresight::plant
