#pragma once

#include <array>
#include <string_view>
#include <vector>

#include <boresight/io/case/case_declaration.hpp>
#include <boresight/io/units/quantity.hpp>
#include <boresight/plant/antenna/antenna_change.hpp>
#include <boresight/plant/antenna/antenna_plant.hpp>

namespace boresight::io {

/// True for an assumed number without a stated uncertainty.
bool is_unbounded_guess(const Quantity& quantity);

/// True for a wind fraction or beam weight that is such an assumption. One below 0 is not: the
/// author must know of a part that turns the boresight backwards. One above 1 is: it balances such
/// parts.
bool is_guessed_fraction(const Quantity& fraction);

/// Placement of the assumed wind fractions and beam weights, which sum to 1 less the stated ones.
/// as_stated: as in the case. as_inertia: in proportion to the inertia fractions, as if wind and
/// boresight acted on all masses alike. all_at_heaviest: all at the body of largest inertia, as if
/// that were the dish.
enum class GuessedFractions { as_stated, as_inertia, all_at_heaviest };
inline constexpr std::array other_guesses{GuessedFractions::as_inertia,
                                          GuessedFractions::all_at_heaviest};

/// Name in reports, with the words of the case file.
std::string_view to_string(GuessedFractions place);

/// The changes that place the assumed fractions of the case's antenna (antenna_of) accordingly;
/// each set keeps its sum.
std::vector<plant::AntennaChange> guessed_fraction_changes(const StructureEntry& structure,
                                                           GuessedFractions place);

/// True if that changes a fraction by more than 0.02.
bool moves_guessed_fractions(const StructureEntry& structure, GuessedFractions place);

}  // namespace boresight::io
