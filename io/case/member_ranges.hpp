#pragma once

#include <boresight/design/problem/mission.hpp>
#include <boresight/io/case/case_declaration.hpp>

namespace boresight::io {

/// The ranges of the case's [ensemble]; what it leaves out: 0.95 to 1.05, 0.8 to 1.33, 0.3 times to
/// once the case's leakage rate, and 0 to largest_viscous_friction, the first three at least as
/// wide as spread_of_stated.
design::MemberRanges member_ranges(const Case& antenna);

/// The uniform distributions that have the standard uncertainties u which the case states of
/// structure.locked_rotor_frequency, oil.bulk_modulus and drive.leakage_rate: 1 -+ sqrt(3) u about
/// the number, the lower end a twentieth of it at least. Both ends at the number where the case
/// states no uncertainty; that of viscous friction always.
design::MemberRanges spread_of_stated(const Case& antenna);

}  // namespace boresight::io
