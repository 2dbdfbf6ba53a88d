#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include <boresight/io/campaign/identified_case.hpp>
#include <boresight/io/case/antenna_of.hpp>
#include <boresight/io/case/case_drive.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_friction.hpp>
#include <boresight/io/case/case_mechanics.hpp>
#include <boresight/io/case/case_motor.hpp>
#include <boresight/io/case/case_oil.hpp>
#include <boresight/io/case/case_simulation.hpp>
#include <boresight/io/case/case_structure.hpp>
#include <boresight/io/case/structure_numbers.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::io {
namespace {

using identification::DriveEstimate;
using identification::GreyBoxResult;
using identification::IdentifiedParts;
using Numbers = std::vector<identification::IdentifiedNumber>;

constexpr std::string_view from_records = "identified from the records";

// Puts numbers of the records into a case; into the list of all its quantities too.
class Replacement {
 public:
  Replacement(Case& antenna, const Numbers& numbers) : antenna_(antenna), numbers_(numbers) {}

  // By its path in the antenna; nothing if the records have none.
  void set(Quantity& quantity, std::string_view path) {
    const auto number = std::ranges::find(numbers_, path, &identification::IdentifiedNumber::path);
    if (number != numbers_.end()) put(quantity, number->value, number->standard_uncertainty);
  }
  void put(Quantity& quantity, double value, double standard_uncertainty) {
    quantity.value = value;
    quantity.standard_uncertainty = standard_uncertainty;
    quantity.uncertainty_given = standard_uncertainty > 0.0;
    quantity.basis = Basis::measured;
    quantity.source = from_records;
    quantity.uncertainty_source.clear();
    quantity.text.clear();
    quantity.also.clear();
    for (Quantity& listed : antenna_.quantities) {
      if (listed.key == quantity.key) listed = quantity;
    }
  }

 private:
  Case& antenna_;
  const Numbers& numbers_;
};

void set_oil(Case& antenna, Replacement& replace, const plant::HydraulicDrive& found) {
  if (!antenna.oil->bulk_modulus) {
    // The mean of the lines gives way to one number, which then has to have a key.
    antenna.oil->bulk_modulus = Quantity{};
    antenna.oil->bulk_modulus->kind = Kind::pressure;
    antenna.oil->bulk_modulus->key = "oil.bulk_modulus";
  }
  replace.set(*antenna.oil->bulk_modulus, "oil.bulk_modulus");
  replace.put(antenna.oil->volume_1, found.volume_1, antenna.oil->volume_1.standard_uncertainty);
  replace.put(antenna.oil->volume_2, found.volume_2, antenna.oil->volume_2.standard_uncertainty);
}

void set_drive(Case& antenna, Replacement& replace, const IdentifiedParts& parts) {
  FrictionCurveEntry& curve = *antenna.friction_curve;
  replace.set(curve.coulomb, "friction_curve.coulomb");
  replace.set(curve.breakaway, "friction_curve.breakaway");
  replace.set(curve.stribeck_rate, "friction_curve.stribeck_rate");
  replace.set(curve.saturating, "friction_curve.saturating");
  replace.set(curve.saturating_rate, "friction_curve.saturating_rate");
  replace.set(curve.viscous, "friction_curve.viscous");
  if (parts.friction_curve) curve.tests.clear();
  replace.set(antenna.drive->leakage_rate, "drive.leakage_rate");
  if (parts.leakage_rate) antenna.drive->leakage_by_flow = false;
  replace.set(antenna.drive->viscous_friction, "drive.viscous_friction");
  replace.set(antenna.drive->valve_frequency, "drive.valve_frequency");
  if (!antenna.simulation) return;
  replace.set(antenna.simulation->offset_torque, "simulation.offset_torque");
  replace.set(antenna.simulation->bristle_stiffness, "simulation.bristle_stiffness");
  replace.set(antenna.simulation->bristle_damping, "simulation.bristle_damping");
}

// The case's modes by their frequencies with the bull gear held.
void set_bull_gear_held(Case& antenna, Replacement& replace, const plant::AntennaStructure& found) {
  std::vector<StructureModeEntry>& modes = antenna.structure->modes;
  for (std::size_t i = 0; i < modes.size() && i < found.modes.size(); ++i) {
    const std::string path = fmt::format("structure.mode[{}].frequency", i);
    replace.put(modes[i].frequency, found.modes[i].frequency,
                modes[i].frequency.standard_uncertainty);
    replace.set(modes[i].frequency, path);
  }
}

// The case's modes by their frequencies with the motors held, mode i the (i + 1)-th of them: those
// that the records show, the others in proportion to the lowest.
void set_motors_held(Case& antenna, Replacement& replace, const DriveEstimate& estimate,
                     const IdentifiedParts& parts, double scale) {
  std::vector<StructureModeEntry>& modes = antenna.structure->modes;
  StructureEntry each = *antenna.structure;
  for (std::size_t i = 0; i < modes.size(); ++i) {
    const std::size_t j = i + 1;
    const bool known = j < parts.frequencies.size() && parts.frequencies[j] &&
                       std::ssize(parts.frequencies) == estimate.mode_frequency.size();
    each.modes[i].frequency.value = known ? estimate.mode_frequency(static_cast<Eigen::Index>(j))
                                          : scale * modes[i].frequency.value;
  }
  bool possible = true;
  try {
    structure_specifications(each);
  } catch (const InvalidInput&) {
    possible = false;
  }
  for (std::size_t i = 0; i < modes.size(); ++i) {
    Quantity& frequency = modes[i].frequency;
    replace.put(frequency, possible ? each.modes[i].frequency.value : scale * frequency.value,
                frequency.standard_uncertainty);
  }
}

bool is_vouched_for(const Quantity& stated) {
  return stated.basis != Basis::assumed && stated.uncertainty_given;
}

bool is_narrower(const Quantity& stated, const numerics::Interval& records) {
  return is_vouched_for(stated) && stated.standard_uncertainty < records.standard_uncertainty;
}

bool is_assumed(const Quantity& quantity) {
  return quantity.basis == Basis::assumed || quantity.uncertainty_source.starts_with("assumed");
}

// A curve that its case states by tests or otherwise vouches for, with its level at high rates
// known better than the records know it.
bool is_narrower(const FrictionCurveEntry& curve, const numerics::Interval& level) {
  return is_vouched_for(curve.coulomb) && is_vouched_for(curve.saturating) &&
         std::hypot(curve.coulomb.standard_uncertainty, curve.saturating.standard_uncertainty) <
             level.standard_uncertainty;
}

}  // namespace

Case with_identified(const Case& antenna, const DriveEstimate& estimate,
                     const std::vector<DriveEstimate>& random_samples,
                     const IdentifiedParts& parts) {
  if (estimate.contradicted) {
    throw NumericalFailure(fmt::format(
        "{}: the records contradict the stated numbers that inertia and stiffness rest on: there "
        "is no drive to design for until the wrong one is found; `boresight identify` names it",
        antenna.path));
  }
  const plant::Antenna own = antenna_of(antenna);
  const plant::Antenna found = changed(own, identified_changes(own, estimate, parts));
  const Numbers numbers = identified_numbers(own, estimate, random_samples, parts);
  Case identified = antenna;
  Replacement replace(identified, numbers);
  replace.set(identified.motor->inertia, "motor.inertia");
  replace.set(identified.antenna->inertia, "antenna.inertia");
  set_oil(identified, replace, found.hydraulics);
  set_drive(identified, replace, parts);
  if (estimate.lowest_frequency > 0.0) {
    const double scale =
        estimate.lowest_frequency / antenna.structure->locked_rotor_frequency.value;
    replace.set(identified.structure->locked_rotor_frequency, "structure.locked_rotor_frequency");
    if (identified.structure->motors_held) {
      set_motors_held(identified, replace, estimate, parts, scale);
    } else {
      set_bull_gear_held(identified, replace, found.structure);
    }
  }
  return identified;
}

IdentifiedParts taken_parts(const Case& antenna, const GreyBoxResult& found) {
  IdentifiedParts parts = identification::identified_parts(found);
  const auto narrower = [&](const Quantity& stated, const char* quantity) {
    return is_narrower(stated, found.quantity(quantity).posterior);
  };
  const DriveEntry& drive = *antenna.drive;
  if (narrower(drive.leakage_rate, "leakage rate")) parts.leakage_rate = false;
  if (narrower(drive.viscous_friction, "tracking friction slope")) {
    parts.friction_slope = false;
  }
  if (is_narrower(*antenna.friction_curve, found.quantity("Coulomb level").posterior)) {
    parts.friction_curve = false;
  }
  const numerics::Interval& lag = found.quantity("valve lag").posterior;
  const Quantity& valve = drive.valve_frequency;
  if (is_vouched_for(valve) && relative_uncertainty(valve) < lag.standard_uncertainty / lag.value) {
    parts.valve_lag = false;
  }
  if (antenna.simulation &&
      narrower(antenna.simulation->offset_torque, "offset torque as recorded")) {
    parts.offset_torque = false;
  }
  return parts;
}

std::vector<SupersededInput> superseded_inputs(const Case& stated, const Case& identified) {
  std::vector<SupersededInput> inputs;
  for (const Quantity& now : identified.quantities) {
    if (now.source != from_records) continue;
    const auto before = std::ranges::find(stated.quantities, now.key, &Quantity::key);
    if (before == stated.quantities.end()) continue;
    inputs.push_back({now.key, std::string(describe(now.kind).si_unit), before->text,
                      is_assumed(*before), before->value, now.value, now.standard_uncertainty});
  }
  return inputs;
}

bool is_superseded(const std::vector<SupersededInput>& inputs, std::string_view key_begin) {
  return std::ranges::any_of(
      inputs, [&](const SupersededInput& input) { return input.key.starts_with(key_begin); });
}

}  // namespace boresight::io
