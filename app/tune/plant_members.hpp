#pragma once

#include <cstdint>
#include <vector>

#include <boresight/design/problem/tracking_problem.hpp>
#include <boresight/io/case/case_file.hpp>

namespace boresight::app {

/// The ends of what the plant is drawn from; factors on the case's structure frequencies (modes and
/// locked rotor) and oil stiffness, the rest SI.
struct MemberRanges {
  struct Ends {
    double lower = 1.0, upper = 1.0;
  };
  Ends structure_frequency, oil_stiffness, leakage_rate, viscous_friction;
};

/// Those of the case's [ensemble]; what it leaves out: 0.95 to 1.05, 0.8 to 1.33, 0.3 times to once
/// the case's leakage rate, and 0 to largest_viscous_friction, the first three at least as wide as
/// spread_of_stated.
MemberRanges member_ranges(const io::Case& antenna);

/// The uniform laws that have the standard uncertainties u which the case states of
/// structure.locked_rotor_frequency, oil.bulk_modulus and drive.leakage_rate: 1 -+ sqrt(3) u about
/// the number, its lower end a twentieth of it at least. Both ends at the number where the case
/// states no uncertainty; that of viscous friction always.
MemberRanges spread_of_stated(const io::Case& antenna);

/// Plants that may be the true one: the case's own ("nominal"), five corners with one end of one
/// range each (both of structure and oil, the lower of leakage) and a Latin hypercube of
/// ensemble.draws (24 unless stated) over all four ranges, the same for a seed.
std::vector<design::EnsembleMember> plant_members(const io::Case& antenna, std::uint64_t seed);

}  // namespace boresight::app
