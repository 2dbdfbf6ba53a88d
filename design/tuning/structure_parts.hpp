#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include <boresight/control/controllers/controller.hpp>

namespace boresight::design {

/// True if `whole` has every gain of `part`, by symbol, and at least one more: it contains `part`
/// as a special case.
bool extends(const control::LoopStructure& whole, const control::LoopStructure& part);

/// For each structure, the indices of the listed structures that it extends directly, with no
/// listed structure between the two.
std::vector<std::vector<std::size_t>> parts_of(
    const std::vector<control::LoopStructure>& structures);

/// The usual structures that are not in a list and that a listed structure extends directly. These
/// are worth tuning first. `usual`: the usual structures with lag (LoopStructure::named), searched
/// within the same bounds as those in the list.
std::vector<control::LoopStructure> missing_parts(
    const std::vector<control::LoopStructure>& structures,
    const std::vector<control::LoopStructure>& usual);

/// Tunes a list of structures, some of which start from the controllers of others. Calls `search`
/// for each index, then `improve` for each that has parts (parts_of), after all its parts are
/// improved. Uses up to `threads` threads. The result does not depend on the thread count if
/// `improve` reads only its own index and its parts.
void search_then_improve(const std::vector<std::vector<std::size_t>>& parts, unsigned threads,
                         const std::function<void(std::size_t)>& search,
                         const std::function<void(std::size_t)>& improve);

/// Number of steps of search_then_improve: calls of `search` plus calls of `improve`.
std::size_t steps_of_search(const std::vector<std::vector<std::size_t>>& parts);

/// Converts the gains of one structure's controller to a start for another structure. Gains of the
/// same symbol are kept. Others are set to have the least effect: lag and lead corners far up,
/// notches flat, added paths with their smallest gain.
std::vector<double> transferred_gains(const control::Controller& controller,
                                      const control::LoopStructure& structure);

/// Number of random starts for a structure that is tuned only to provide starts for others.
inline constexpr int starts_of_a_part = 6;

/// Starts for a structure from a controller of a structure that it extends: transferred_gains, then
/// `random` more with the added gains log-uniform within their bounds. A search from the neutral
/// setting alone may find only the nearest of several optima. Deterministic by seed.
std::vector<std::vector<double>> starts_from_part(const control::Controller& controller,
                                                  const control::LoopStructure& structure,
                                                  std::uint64_t seed, int random = 5);

}  // namespace boresight::design
