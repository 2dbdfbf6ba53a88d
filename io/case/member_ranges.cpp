#include <algorithm>
#include <numbers>

#include <boresight/io/case/case_drive.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_oil.hpp>
#include <boresight/io/case/case_structure.hpp>
#include <boresight/io/case/case_tuning.hpp>
#include <boresight/io/case/member_ranges.hpp>
#include <boresight/io/case/plant_numbers.hpp>
#include <boresight/io/units/quantity.hpp>

namespace boresight::io {
namespace {

design::Ends stated(const std::optional<RangeEntry>& range, const design::Ends& usual) {
  if (!range) return usual;
  return {range->lower.value, range->upper.value};
}

design::Ends both(const design::Ends& one, const design::Ends& other) {
  return {std::min(one.lower, other.lower), std::max(one.upper, other.upper)};
}

// Of a number, `scale` times the factors about 1 that its stated uncertainty leaves.
design::Ends spread(const Quantity& quantity, double scale) {
  constexpr double minimum = 0.05;
  if (!quantity.uncertainty_given) return {scale, scale};
  const double half = std::numbers::sqrt3 * relative_uncertainty(quantity);
  return {scale * std::max(1.0 - half, minimum), scale * (1.0 + half)};
}

}  // namespace

design::MemberRanges member_ranges(const Case& antenna) {
  const EnsembleEntry& ensemble = *antenna.ensemble;
  const double leakage = antenna.drive->leakage_rate.value;
  const design::MemberRanges spread = spread_of_stated(antenna);
  return {stated(ensemble.structure_frequency, both({0.95, 1.05}, spread.structure_frequency)),
          stated(ensemble.oil_stiffness, both({0.8, 1.33}, spread.oil_stiffness)),
          stated(ensemble.leakage_rate, both({0.3 * leakage, leakage}, spread.leakage_rate)),
          stated(ensemble.viscous_friction, {0.0, largest_viscous_friction(antenna)})};
}

design::MemberRanges spread_of_stated(const Case& antenna) {
  const Quantity& leakage = antenna.drive->leakage_rate;
  const double friction = antenna.drive->viscous_friction.value;
  return {spread(antenna.structure->locked_rotor_frequency, 1.0),
          antenna.oil->bulk_modulus ? spread(*antenna.oil->bulk_modulus, 1.0) : design::Ends{},
          spread(leakage, leakage.value),
          {friction, friction}};
}

}  // namespace boresight::io
