#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <boresight/app/identify/identified_case.hpp>
#include <boresight/io/case/antenna_of.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/plant_numbers.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::app {
namespace {

// The number of a case's quantity by what the records say; in the list of all quantities too.
class Replacement {
 public:
  explicit Replacement(io::Case& antenna) : antenna_(antenna) {}
  void set(io::Quantity& quantity, double value) {
    quantity.value = value;
    quantity.basis = io::Basis::measured;
    quantity.source = "identified from the records";
    quantity.uncertainty_source.clear();
    quantity.text.clear();
    quantity.also.clear();
    for (io::Quantity& listed : antenna_.quantities) {
      if (listed.key == quantity.key) listed = quantity;
    }
  }

 private:
  io::Case& antenna_;
};

void set_inertias(io::Case& antenna, Replacement& replace,
                  const identification::DriveEstimate& estimate) {
  const double motors = static_cast<double>(antenna.motor.count);
  replace.set(antenna.motor.inertia, estimate.motor_inertia / motors);
  const double left = estimate.inertia - estimate.motor_inertia - gear_train_inertia(antenna);
  if (!(left > 0.0)) {
    throw NumericalFailure(
        fmt::format("identified inertia {:.4g} kg.m2 leaves none for the antenna: motors {:.4g}, "
                    "gear train {:.4g}",
                    estimate.inertia, estimate.motor_inertia, gear_train_inertia(antenna)));
  }
  replace.set(antenna.antenna.inertia, left * std::pow(io::gear_ratio(antenna), 2));
}

void set_oil(io::Case& antenna, Replacement& replace,
             const identification::DriveEstimate& estimate) {
  if (!antenna.oil.bulk_modulus) {
    // The mean of the lines gives way to one number, which then has to have a key.
    antenna.oil.bulk_modulus = io::Quantity{};
    antenna.oil.bulk_modulus->kind = io::Kind::pressure;
    antenna.oil.bulk_modulus->key = "oil.bulk_modulus";
  }
  replace.set(*antenna.oil.bulk_modulus, estimate.bulk_modulus);
  // The plant takes the case's convention about efficiencies, motion shows K with both: the volumes
  // make up for either.
  const double scale = oil_stiffness(antenna) / estimate.oil_stiffness;
  for (io::Quantity* volume : {&antenna.oil.volume_1, &antenna.oil.volume_2}) {
    replace.set(*volume, volume->value * scale);
  }
}

void set_friction(io::Case& antenna, Replacement& replace,
                  const identification::DriveEstimate& estimate) {
  io::FrictionCurveEntry& curve = antenna.friction_curve;
  const plant::FrictionCurve& found = estimate.friction;
  replace.set(curve.coulomb, found.coulomb_torque);
  replace.set(curve.breakaway, found.breakaway_torque);
  replace.set(curve.stribeck_rate, found.stribeck_rate);
  replace.set(curve.saturating, found.saturating_torque);
  replace.set(curve.saturating_rate, found.saturating_rate);
  replace.set(curve.viscous, found.viscous_friction);
  curve.tests.clear();
  if (!antenna.simulation) return;
  replace.set(antenna.simulation->offset_torque, estimate.offset_as_recorded);
  replace.set(antenna.simulation->bristle_stiffness, estimate.bristle_stiffness);
  replace.set(antenna.simulation->bristle_damping, estimate.bristle_damping);
}

void set_structure(io::Case& antenna, Replacement& replace,
                   const identification::DriveEstimate& estimate) {
  if (!(estimate.lowest_frequency > 0.0)) return;
  io::StructureEntry& structure = antenna.structure;
  const double scale = estimate.lowest_frequency / structure.locked_rotor_frequency.value;
  replace.set(structure.locked_rotor_frequency, estimate.lowest_frequency);
  for (io::StructureModeEntry& mode : structure.modes) {
    replace.set(mode.frequency, mode.frequency.value * scale);
  }
}

}  // namespace

io::Case with_identified(const io::Case& antenna, const identification::DriveEstimate& estimate) {
  if (estimate.contradicted) {
    throw NumericalFailure(fmt::format(
        "{}: the records contradict the stated numbers that inertia and stiffness rest on: there "
        "is no drive to design for until the wrong one is found; `boresight identify` names it",
        antenna.path));
  }
  io::Case identified = antenna;
  Replacement replace(identified);
  set_inertias(identified, replace, estimate);
  set_oil(identified, replace, estimate);
  replace.set(identified.drive.leakage_rate, estimate.leakage_rate);
  identified.drive.leakage_by_flow = false;
  set_friction(identified, replace, estimate);
  set_structure(identified, replace, estimate);
  return identified;
}

std::vector<design::EnsembleMember> identified_ensemble(
    const io::Case& antenna, const std::vector<identification::DriveEstimate>& draws,
    std::size_t count) {
  std::vector<design::EnsembleMember> members;
  for (std::size_t i = 0; i < draws.size() && members.size() < count; ++i) {
    try {
      members.push_back(
          {fmt::format("draw {}", i + 1), make_plant(with_identified(antenna, draws[i]))});
    } catch (const NumericalFailure&) {
      continue;
    }
  }
  return members;
}

}  // namespace boresight::app
