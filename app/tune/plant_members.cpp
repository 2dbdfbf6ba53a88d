#include <algorithm>
#include <array>
#include <numbers>
#include <numeric>

#include <fmt/format.h>

#include <boresight/app/tune/plant_members.hpp>
#include <boresight/io/case/antenna_of.hpp>
#include <boresight/io/case/plant_numbers.hpp>
#include <boresight/numerics/normal_numbers.hpp>
#include <boresight/plant/antenna/antenna_change.hpp>

namespace boresight::app {
namespace {

constexpr long reference_draws = 24;

// What one member has in the place of the case's numbers, in the order of MemberRanges.
struct Draw {
  double structure_frequency = 1.0, oil_stiffness = 1.0, leakage_rate = 0.0, viscous_friction = 0.0;
};

plant::AntennaPlant plant_of(const plant::Antenna& antenna, const Draw& draw) {
  return linear_plant(
      changed(antenna, {plant::set_to("drive.viscous_friction", draw.viscous_friction),
                        plant::scaled_by("at_shaft.oil_stiffness", draw.oil_stiffness),
                        plant::set_to("drive.leakage_rate", draw.leakage_rate),
                        plant::scaled_by("structure.frequencies", draw.structure_frequency)}));
}

// Uniform within [0, 1), number `index` of a stream.
double uniform(std::uint64_t state, std::size_t index) {
  constexpr double unit = 0x1p-53;
  return static_cast<double>(numerics::splitmix64(state, index) >> 11U) * unit;
}

// One number in each of `count` equal parts of [0, 1), the parts in a random order.
std::vector<double> stratified(std::size_t count, std::uint64_t state) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t i = count; i > 1; --i) {
    const auto other = static_cast<std::size_t>(uniform(state, i) * static_cast<double>(i));
    std::swap(order[i - 1], order[other]);
  }
  std::vector<double> numbers;
  numbers.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    numbers.push_back((static_cast<double>(order[i]) + uniform(state, count + 1 + i)) /
                      static_cast<double>(count));
  }
  return numbers;
}

double between(const MemberRanges::Ends& ends, double share) {
  return ends.lower + share * (ends.upper - ends.lower);
}

MemberRanges::Ends stated(const std::optional<io::RangeEntry>& range,
                          const MemberRanges::Ends& usual) {
  if (!range) return usual;
  return {range->lower.value, range->upper.value};
}

MemberRanges::Ends both(const MemberRanges::Ends& one, const MemberRanges::Ends& other) {
  return {std::min(one.lower, other.lower), std::max(one.upper, other.upper)};
}

// Of a number, `scale` times the factors about 1 that its stated uncertainty leaves.
MemberRanges::Ends spread(const io::Quantity& quantity, double scale) {
  constexpr double least = 0.05;
  if (!quantity.uncertainty_given) return {scale, scale};
  const double half = std::numbers::sqrt3 * relative_uncertainty(quantity);
  return {scale * std::max(1.0 - half, least), scale * (1.0 + half)};
}

}  // namespace

MemberRanges member_ranges(const io::Case& antenna) {
  const io::EnsembleEntry& ensemble = antenna.ensemble;
  const double leakage = antenna.drive.leakage_rate.value;
  const MemberRanges spread = spread_of_stated(antenna);
  return {stated(ensemble.structure_frequency, both({0.95, 1.05}, spread.structure_frequency)),
          stated(ensemble.oil_stiffness, both({0.8, 1.33}, spread.oil_stiffness)),
          stated(ensemble.leakage_rate, both({0.3 * leakage, leakage}, spread.leakage_rate)),
          stated(ensemble.viscous_friction, {0.0, largest_viscous_friction(antenna)})};
}

MemberRanges spread_of_stated(const io::Case& antenna) {
  const io::Quantity& leakage = antenna.drive.leakage_rate;
  const double friction = antenna.drive.viscous_friction.value;
  return {spread(antenna.structure.locked_rotor_frequency, 1.0),
          antenna.oil.bulk_modulus ? spread(*antenna.oil.bulk_modulus, 1.0) : MemberRanges::Ends{},
          spread(leakage, leakage.value),
          {friction, friction}};
}

std::vector<design::EnsembleMember> plant_members(const io::Case& antenna, std::uint64_t seed) {
  const MemberRanges ranges = member_ranges(antenna);
  const Draw own{1.0, 1.0, antenna.drive.leakage_rate.value, antenna.drive.viscous_friction.value};
  const plant::Antenna stated = antenna_of(antenna);
  std::vector<design::EnsembleMember> members;
  const auto add = [&](std::string name, const Draw& draw) {
    members.push_back({std::move(name), plant_of(stated, draw)});
  };
  add("nominal", own);
  Draw corner = own;
  corner.structure_frequency = ranges.structure_frequency.lower;
  add(fmt::format("structure frequencies x {:g}", corner.structure_frequency), corner);
  corner.structure_frequency = ranges.structure_frequency.upper;
  add(fmt::format("structure frequencies x {:g}", corner.structure_frequency), corner);
  corner = own;
  corner.oil_stiffness = ranges.oil_stiffness.lower;
  add(fmt::format("oil stiffness x {:g}", corner.oil_stiffness), corner);
  corner.oil_stiffness = ranges.oil_stiffness.upper;
  add(fmt::format("oil stiffness x {:g}", corner.oil_stiffness), corner);
  corner = own;
  corner.leakage_rate = ranges.leakage_rate.lower;
  add(fmt::format("leakage rate {:.4g} 1/s", corner.leakage_rate), corner);

  const long stated_draws = antenna.ensemble.draws;
  const auto draws = static_cast<std::size_t>(stated_draws > 0 ? stated_draws : reference_draws);
  std::array<std::vector<double>, 4> shares;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    shares.at(i) = stratified(draws, numerics::splitmix64(seed, i));
  }
  for (std::size_t i = 0; i < draws; ++i) {
    add(fmt::format("draw {}", i + 1),
        {between(ranges.structure_frequency, shares[0][i]),
         between(ranges.oil_stiffness, shares[1][i]), between(ranges.leakage_rate, shares[2][i]),
         between(ranges.viscous_friction, shares[3][i])});
  }
  return members;
}

}  // namespace boresight::app
