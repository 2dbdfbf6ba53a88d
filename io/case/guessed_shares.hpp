#pragma once

#include <array>
#include <string_view>
#include <vector>

#include <boresight/io/case/case_file.hpp>
#include <boresight/plant/antenna/antenna_change.hpp>
#include <boresight/plant/antenna/antenna_plant.hpp>

namespace boresight::io {

/// Whether a number is assumed without saying how far it may be off.
bool is_unbounded_guess(const Quantity& quantity);

/// Whether a share of wind or beam is such a guess. One below 0 is none: a part that turns the beam
/// against itself is known to. One above 1 is: it has what balances such parts.
bool is_guessed_share(const Quantity& share);

/// Where the guessed shares of wind and of beam are, of what the stated ones leave of 1: as the
/// case says; in proportion to the inertia fractions, as if both belonged to all masses alike; all
/// at the heaviest of those bodies, as if that were the dish.
enum class GuessedShares { as_stated, as_inertia, all_at_heaviest };
inline constexpr std::array other_guesses{GuessedShares::as_inertia,
                                          GuessedShares::all_at_heaviest};

/// "wind and beam shares as inertia".
std::string_view to_string(GuessedShares place);

/// The changes that place the guessed shares of the case's antenna (antenna_of) so; each set of
/// shares sums to what it did.
std::vector<plant::AntennaChange> guessed_share_changes(const StructureEntry& structure,
                                                        GuessedShares place);

/// Whether that changes a share by more than 0.02.
bool moves_guessed_shares(const StructureEntry& structure, GuessedShares place);

}  // namespace boresight::io
