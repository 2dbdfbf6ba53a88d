#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include <boresight/control/controllers/control_law.hpp>

namespace boresight::design {

/// Whether one structure has every gain of another, by symbol, and more: it can do what that does.
bool extends(const control::LoopStructure& whole, const control::LoopStructure& part);

/// Of each structure the places of those of the others that it extends directly, with none of the
/// list between the two.
std::vector<std::vector<std::size_t>> parts_of(
    const std::vector<control::LoopStructure>& structures);

/// The usual structures that are not in a list and that one of the list extends directly: what is
/// worth tuning first. `usual`: with lag (LoopStructure::named), searched within the same bounds as
/// those in the list.
std::vector<control::LoopStructure> missing_parts(
    const std::vector<control::LoopStructure>& structures,
    const std::vector<control::LoopStructure>& usual);

/// Tunes a list of structures of which some start from the laws of others: `search` of each place,
/// then `improve` of each that has parts (parts_of), after that of all its parts. On up to
/// `threads` threads; the result does not depend on how many, where `improve` reads its place and
/// its parts.
void search_then_improve(const std::vector<std::vector<std::size_t>>& parts, unsigned threads,
                         const std::function<void(std::size_t)>& search,
                         const std::function<void(std::size_t)>& improve);

/// How many steps search_then_improve takes: calls of `search` and of `improve`.
std::size_t steps_of_search(const std::vector<std::vector<std::size_t>>& parts);

/// A law of one structure as a start for another: gains of the same symbol are kept, others set
/// where they do the least: corners of lag and lead far up, notches flat, paths added with their
/// least gain.
std::vector<double> transferred_gains(const control::ControlLaw& law,
                                      const control::LoopStructure& structure);

/// Random starts that are enough for a structure that is tuned only to start others from.
inline constexpr int starts_of_a_part = 6;

/// Starts for a structure from a law of one that it extends: transferred_gains, then `random` more
/// with the added gains log-uniform within their bounds, since from their neutral setting a search
/// may find only the nearest of several optima. Deterministic by seed.
std::vector<std::vector<double>> starts_from_part(const control::ControlLaw& law,
                                                  const control::LoopStructure& structure,
                                                  std::uint64_t seed, int random = 5);

}  // namespace boresight::design
