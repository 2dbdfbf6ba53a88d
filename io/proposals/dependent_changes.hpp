#pragma once

#include <string>

#include <boresight/io/case/case_declaration.hpp>
#include <boresight/io/proposals/proposal.hpp>

namespace boresight::io {

/// "FILE:LINE:COLUMN: KEY: MESSAGE" of a change. @throws InvalidInput always
[[noreturn]] void refuse_change(const ProposedChange& change, const std::string& message);

/// What a change makes of a number.
double changed(const ProposedChange& change, double before);
Quantity changed(const ProposedChange& change, const Quantity& before);
/// Refuses a number that a change has taken out of its range.
void check_changed_range(const ProposedChange& change, Kind kind, const Range& range, double value);

/// The same structure on a gear spring stiffer by a factor. Sets the locked-rotor frequency
/// accordingly, and every mode by its bull-gear-locked values.
/// @throws InvalidInput for a factor that is not positive, one that takes the frequency beyond 1
/// kHz, and as structure_specification
void stiffen_gear(const ProposedChange& change, StructureEntry& structure);

/// Dead time and noise bandwidth after the sampling rate; refuses a delay that contradicts it, and
/// a sampling slower than before that is too slow for the structure's modes, as the case states
/// them or as the proposal leaves them (stiffen_gear states them anew, and lower).
void follow_sampling(const Case& before, const Proposal& proposal, Case& after);
/// Dependent changes of gear ratio, displacement, count, volumes, bulk modulus, supply pressure and
/// the valve's rated flow, as listed in proposed_case.hpp; ranges of the ensemble.
void follow_drive(const Case& before, const Proposal& proposal, Case& after);

}  // namespace boresight::io
