#include <algorithm>

#include <fmt/format.h>

#include <boresight/identification/grey_box/identified_antenna.hpp>
#include <boresight/io/campaign/identified_case.hpp>
#include <boresight/io/case/antenna_of.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::io {
namespace {

// The number of a case's quantity by what the records say; in the list of all quantities too.
class Replacement {
 public:
  explicit Replacement(Case& antenna) : antenna_(antenna) {}
  void set(Quantity& quantity, double value) {
    quantity.value = value;
    quantity.basis = Basis::measured;
    quantity.source = "identified from the records";
    quantity.uncertainty_source.clear();
    quantity.text.clear();
    quantity.also.clear();
    for (Quantity& listed : antenna_.quantities) {
      if (listed.key == quantity.key) listed = quantity;
    }
  }

 private:
  Case& antenna_;
};

void set_oil(Case& antenna, Replacement& replace, const plant::HydraulicDrive& found) {
  if (!antenna.oil.bulk_modulus) {
    // The mean of the lines gives way to one number, which then has to have a key.
    antenna.oil.bulk_modulus = Quantity{};
    antenna.oil.bulk_modulus->kind = Kind::pressure;
    antenna.oil.bulk_modulus->key = "oil.bulk_modulus";
  }
  replace.set(*antenna.oil.bulk_modulus, found.bulk_modulus);
  replace.set(antenna.oil.volume_1, found.volume_1);
  replace.set(antenna.oil.volume_2, found.volume_2);
}

void set_friction(Case& antenna, Replacement& replace, const plant::Antenna& found) {
  FrictionCurveEntry& curve = antenna.friction_curve;
  replace.set(curve.coulomb, found.friction_curve.coulomb_torque);
  replace.set(curve.breakaway, found.friction_curve.breakaway_torque);
  replace.set(curve.stribeck_rate, found.friction_curve.stribeck_rate);
  replace.set(curve.saturating, found.friction_curve.saturating_torque);
  replace.set(curve.saturating_rate, found.friction_curve.saturating_rate);
  replace.set(curve.viscous, found.friction_curve.viscous_friction);
  curve.tests.clear();
  if (!antenna.simulation || !found.nonlinear) return;
  replace.set(antenna.simulation->offset_torque, found.nonlinear->offset_torque);
  replace.set(antenna.simulation->bristle_stiffness, found.nonlinear->bristle_stiffness);
  replace.set(antenna.simulation->bristle_damping, found.nonlinear->bristle_damping);
}

// The case may state its frequencies with the motors held: all are in one proportion.
void set_structure(Case& antenna, Replacement& replace, double lowest_frequency) {
  StructureEntry& structure = antenna.structure;
  const double scale = lowest_frequency / structure.locked_rotor_frequency.value;
  replace.set(structure.locked_rotor_frequency, lowest_frequency);
  for (StructureModeEntry& mode : structure.modes) {
    replace.set(mode.frequency, mode.frequency.value * scale);
  }
}

}  // namespace

Case with_identified(const Case& antenna, const identification::DriveEstimate& estimate) {
  if (estimate.contradicted) {
    throw NumericalFailure(fmt::format(
        "{}: the records contradict the stated numbers that inertia and stiffness rest on: there "
        "is no drive to design for until the wrong one is found; `boresight identify` names it",
        antenna.path));
  }
  const plant::Antenna own = antenna_of(antenna);
  const plant::Antenna found = changed(own, identified_changes(own, estimate));
  Case identified = antenna;
  Replacement replace(identified);
  replace.set(identified.motor.inertia, found.flywheels.motor_inertia);
  replace.set(identified.antenna.inertia, found.inertia);
  set_oil(identified, replace, found.hydraulics);
  replace.set(identified.drive.leakage_rate, found.drive.leakage_rate);
  identified.drive.leakage_by_flow = false;
  set_friction(identified, replace, found);
  if (estimate.lowest_frequency > 0.0) {
    set_structure(identified, replace, found.structure.locked_rotor_frequency);
  }
  return identified;
}

}  // namespace boresight::io
