#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include <fmt/format.h>

#include <boresight/identification/grey_box/identified_antenna.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/antenna/moved_held_modes.hpp>

namespace boresight::identification {
namespace {

using plant::set_to;

constexpr std::size_t max_random_samples = 400;  // for a standard uncertainty

// Reflected to the motor shaft; not positive where motors and gear train take all of it.
double antenna_inertia_left(const plant::Antenna& antenna, const DriveEstimate& estimate) {
  return estimate.inertia - estimate.motor_inertia - plant::gear_train_inertia(antenna);
}

// About the antenna axis.
double antenna_inertia(const plant::Antenna& antenna, const DriveEstimate& estimate) {
  const double left = antenna_inertia_left(antenna, estimate);
  if (!(left > 0.0)) {
    throw NumericalFailure(
        fmt::format("identified inertia {:.4g} kg.m2 leaves none for the antenna: motors {:.4g}, "
                    "gear train {:.4g}",
                    estimate.inertia, estimate.motor_inertia, plant::gear_train_inertia(antenna)));
  }
  const double ratio = plant::gear_ratio(antenna);
  return left * (ratio * ratio);
}

void add_oil(std::vector<plant::AntennaChange>& changes, const plant::Antenna& antenna,
             const DriveEstimate& estimate) {
  plant::HydraulicDrive drive = antenna.hydraulics;
  drive.bulk_modulus = estimate.bulk_modulus;
  // The plant takes the antenna's convention about efficiencies, motion shows K with both: the
  // volumes make up for either.
  const double scale = plant::oil_stiffness(drive) / estimate.oil_stiffness;
  changes.insert(changes.end(), {set_to("oil.bulk_modulus", estimate.bulk_modulus),
                                 plant::scaled_by("oil.volume_1", scale),
                                 plant::scaled_by("oil.volume_2", scale)});
}

void add_friction(std::vector<plant::AntennaChange>& changes, const DriveEstimate& estimate,
                  const IdentifiedParts& parts) {
  if (parts.friction_curve) {
    const plant::FrictionCurve& curve = estimate.friction;
    changes.insert(changes.end(), {set_to("friction_curve.coulomb", curve.coulomb_torque),
                                   set_to("friction_curve.breakaway", curve.breakaway_torque),
                                   set_to("friction_curve.stribeck_rate", curve.stribeck_rate),
                                   set_to("friction_curve.saturating", curve.saturating_torque),
                                   set_to("friction_curve.saturating_rate", curve.saturating_rate),
                                   set_to("friction_curve.viscous", curve.viscous_friction)});
  }
  if (parts.friction_slope) {
    // A linear plant has no friction that drives.
    changes.push_back(set_to("drive.viscous_friction", std::max(0.0, estimate.tracking_slope)));
  }
}

void add_contacts(std::vector<plant::AntennaChange>& changes, const DriveEstimate& estimate,
                  const IdentifiedParts& parts) {
  if (parts.offset_torque) {
    changes.push_back(set_to("simulation.offset_torque", estimate.offset_as_recorded));
  }
  if (!parts.bristles) return;
  changes.insert(changes.end(), {set_to("simulation.bristle_stiffness", estimate.bristle_stiffness),
                                 set_to("simulation.bristle_damping", estimate.bristle_damping)});
}

// Of a valve of second order with the damping ratio whose phase lag at low frequencies is that of
// the estimate's first-order lag (Hz).
double valve_frequency(double damping, double lag) {
  return damping / (std::numbers::pi * lag);
}

void add_structure(std::vector<plant::AntennaChange>& changes, const plant::Antenna& antenna,
                   const DriveEstimate& estimate, const IdentifiedParts& parts) {
  const double own = antenna.structure.locked_rotor_frequency;
  changes.push_back(plant::scaled_by("structure.frequencies", estimate.lowest_frequency / own));
  changes.push_back(set_to("structure.locked_rotor_frequency", estimate.lowest_frequency));
  std::vector<std::optional<double>> held{estimate.lowest_frequency};
  const auto known =
      std::min(parts.frequencies.size(), static_cast<std::size_t>(estimate.mode_frequency.size()));
  for (std::size_t i = 1; i < known; ++i) {
    held.push_back(parts.frequencies[i]
                       ? std::optional(estimate.mode_frequency(static_cast<Eigen::Index>(i)))
                       : std::nullopt);
  }
  if (held.size() < 2) return;
  const auto moved = plant::with_motors_held_frequencies(structure_specification(antenna), held);
  if (!moved) return;
  for (std::size_t i = 0; i < moved->modes.size(); ++i) {
    changes.push_back(
        set_to(fmt::format("structure.mode[{}].frequency", i), moved->modes[i].frequency));
  }
}

const GreyBoxParameterResult& parameter(const GreyBoxResult& result, Eigen::Index index) {
  return result.parameters.at(static_cast<std::size_t>(index));
}

}  // namespace

IdentifiedParts identified_parts(const GreyBoxResult& result) {
  using P = GreyBoxParameters;
  const GreyBoxQuantity& slope = result.quantity("tracking friction slope");
  IdentifiedParts parts;
  parts.leakage_rate = result.quantity("leakage rate").identified;
  parts.friction_slope = slope.identified && slope.posterior.lower > 0.0;
  parts.friction_curve = parts.friction_slope || result.quantity("Coulomb level").identified;
  parts.offset_torque = result.quantity("offset torque as recorded").identified;
  parts.bristles = parameter(result, P::bristle_stiffness).identified;
  parts.valve_lag = result.quantity("valve lag").identified;
  for (Eigen::Index i = 0; i < result.estimate.mode_frequency.size(); ++i) {
    parts.frequencies.push_back(parameter(result, P::frequency(i)).identified);
  }
  return parts;
}

std::vector<plant::AntennaChange> identified_changes(const plant::Antenna& antenna,
                                                     const DriveEstimate& estimate,
                                                     const IdentifiedParts& parts) {
  if (estimate.contradicted) {
    throw NumericalFailure(
        "identified_changes: expected an estimate that agrees with the stated numbers which "
        "inertia "
        "and stiffness rest on, found one that contradicts them");
  }
  std::vector changes{
      set_to("motor.inertia", estimate.motor_inertia / antenna.hydraulics.motor_count),
      set_to("antenna.inertia", antenna_inertia(antenna, estimate))};
  add_oil(changes, antenna, estimate);
  if (parts.leakage_rate) changes.push_back(set_to("drive.leakage_rate", estimate.leakage_rate));
  add_friction(changes, estimate, parts);
  if (antenna.nonlinear) add_contacts(changes, estimate, parts);
  if (parts.valve_lag) {
    changes.push_back(set_to("drive.valve_frequency",
                             valve_frequency(antenna.drive.valve_damping, estimate.valve_lag)));
  }
  if (estimate.lowest_frequency > 0.0) add_structure(changes, antenna, estimate, parts);
  return changes;
}

std::vector<IdentifiedNumber> identified_numbers(const plant::Antenna& antenna,
                                                 const DriveEstimate& estimate,
                                                 const std::vector<DriveEstimate>& random_samples,
                                                 const IdentifiedParts& parts) {
  std::vector<IdentifiedNumber> numbers;
  for (const auto& change : identified_changes(antenna, estimate, parts)) {
    if (change.how == plant::AntennaChange::How::set) {
      numbers.push_back({change.path, change.number, 0.0});
    }
  }
  std::size_t used = 0;
  for (const auto& draw : random_samples) {
    if (used == max_random_samples) break;
    if (!(antenna_inertia_left(antenna, draw) > 0.0)) continue;
    ++used;
    for (const auto& change : identified_changes(antenna, draw, parts)) {
      if (change.how != plant::AntennaChange::How::set) continue;
      const auto number = std::ranges::find(numbers, change.path, &IdentifiedNumber::path);
      if (number == numbers.end()) continue;
      number->standard_uncertainty += std::pow(change.number - number->value, 2);
    }
  }
  for (auto& number : numbers) {
    number.standard_uncertainty =
        used > 0 ? std::sqrt(number.standard_uncertainty / static_cast<double>(used)) : 0.0;
  }
  return numbers;
}

}  // namespace boresight::identification
