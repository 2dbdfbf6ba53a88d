#include <cmath>

#include <fmt/format.h>

#include <boresight/identification/grey_box/identified_antenna.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::identification {
namespace {

using plant::set_to;

// About the antenna axis.
double antenna_inertia_left(const plant::Antenna& antenna, const DriveEstimate& estimate) {
  const double gear_train = plant::gear_train_inertia(antenna);
  const double left = estimate.inertia - estimate.motor_inertia - gear_train;
  if (!(left > 0.0)) {
    throw NumericalFailure(
        fmt::format("identified inertia {:.4g} kg.m2 leaves none for the antenna: motors {:.4g}, "
                    "gear train {:.4g}",
                    estimate.inertia, estimate.motor_inertia, gear_train));
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

void add_friction(std::vector<plant::AntennaChange>& changes, const plant::Antenna& antenna,
                  const DriveEstimate& estimate) {
  const plant::FrictionCurve& curve = estimate.friction;
  changes.insert(changes.end(), {set_to("friction_curve.coulomb", curve.coulomb_torque),
                                 set_to("friction_curve.breakaway", curve.breakaway_torque),
                                 set_to("friction_curve.stribeck_rate", curve.stribeck_rate),
                                 set_to("friction_curve.saturating", curve.saturating_torque),
                                 set_to("friction_curve.saturating_rate", curve.saturating_rate),
                                 set_to("friction_curve.viscous", curve.viscous_friction)});
  if (!antenna.nonlinear) return;
  changes.insert(changes.end(), {set_to("simulation.offset_torque", estimate.offset_as_recorded),
                                 set_to("simulation.bristle_stiffness", estimate.bristle_stiffness),
                                 set_to("simulation.bristle_damping", estimate.bristle_damping)});
}

}  // namespace

std::vector<plant::AntennaChange> identified_changes(const plant::Antenna& antenna,
                                                     const DriveEstimate& estimate) {
  if (estimate.contradicted) {
    throw NumericalFailure(
        "identified_changes: expected an estimate that agrees with the stated numbers which "
        "inertia "
        "and stiffness rest on, found one that contradicts them");
  }
  std::vector changes{
      set_to("motor.inertia", estimate.motor_inertia / antenna.hydraulics.motor_count),
      set_to("antenna.inertia", antenna_inertia_left(antenna, estimate))};
  add_oil(changes, antenna, estimate);
  changes.push_back(set_to("drive.leakage_rate", estimate.leakage_rate));
  add_friction(changes, antenna, estimate);
  if (estimate.lowest_frequency > 0.0) {
    const double own = antenna.structure.locked_rotor_frequency;
    changes.push_back(plant::scaled_by("structure.frequencies", estimate.lowest_frequency / own));
    changes.push_back(set_to("structure.locked_rotor_frequency", estimate.lowest_frequency));
  }
  return changes;
}

}  // namespace boresight::identification
