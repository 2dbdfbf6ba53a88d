#include <fmt/format.h>

#include <boresight/io/case/antenna_of.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_mechanics.hpp>
#include <boresight/io/case/case_motor.hpp>
#include <boresight/io/case/case_oil.hpp>
#include <boresight/io/case/case_statements.hpp>
#include <boresight/io/case/case_tests.hpp>
#include <boresight/io/case/drive_evidence.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/resonating_mode.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::io {
namespace {

numerics::Uncertain uncertain(const Quantity& quantity) {
  return {quantity.value, quantity.standard_uncertainty};
}

// An inertia about the antenna axis, at the motor shaft.
numerics::Uncertain at_motor(const Case& antenna, const Quantity& inertia) {
  const double ratio = gear_ratio(antenna);
  return {plant::reflected_inertia(inertia.value, ratio),
          plant::reflected_inertia(inertia.standard_uncertainty, ratio)};
}

// Of an alternative, at the motor shaft.
numerics::Uncertain at_motor(const Case& antenna, const AntennaAlternative& alternative) {
  if (alternative.reflected_inertia) return uncertain(*alternative.reflected_inertia);
  if (!alternative.inertia) {
    throw InvalidInput(fmt::format("antenna alternative '{}' has no inertia", alternative.name));
  }
  return at_motor(antenna, *alternative.inertia);
}

}  // namespace

identification::DriveEvidence make_evidence(const Case& antenna) {
  identification::DriveEvidence evidence;
  evidence.stages = gear_stages(antenna);
  for (const auto& assembly : antenna.gear_train->assemblies) {
    evidence.assemblies.push_back({assembly.name, assembly_inertia(antenna, assembly),
                                   static_cast<double>(assembly.count), assembly.stages});
  }
  const Quantity& own = antenna.antenna->inertia;
  evidence.antenna.push_back(
      {own.source.empty() ? "the case" : own.source, at_motor(antenna, own)});
  for (const auto& alternative : antenna.antenna->alternatives) {
    if (alternative.keeps_springs) continue;  // of another attitude
    evidence.antenna.push_back({alternative.name, at_motor(antenna, alternative)});
  }
  for (const auto& stated : antenna.stated) {
    if (stated.quantity != "load_inertia" || evidence.printed_load) continue;
    evidence.printed_load = {stated.value.source, stated.value.value};
  }
  const MotorEntry& motor = *antenna.motor;
  evidence.motor_count = static_cast<double>(motor.count);
  evidence.motor_inertia = uncertain(motor.inertia);
  evidence.displacement = uncertain(motor.displacement);
  evidence.torque_efficiency = uncertain(motor.torque_efficiency);
  evidence.volumetric_efficiency = uncertain(motor.volumetric_efficiency);
  const OilEntry& oil = *antenna.oil;
  if (oil.density) evidence.oil_density = uncertain(*oil.density);
  for (const auto& line : oil.lines) {
    evidence.lines.push_back({line.name, uncertain(line.length), uncertain(line.slosh_frequency)});
  }
  if (oil.bulk_modulus) evidence.bulk_modulus = uncertain(*oil.bulk_modulus);
  evidence.volume_1 = uncertain(oil.volume_1);
  evidence.volume_2 = uncertain(oil.volume_2);
  evidence.efficiency_in_stiffness = oil.efficiency_in_stiffness
                                         ? plant::EfficiencyInStiffness::both
                                         : plant::EfficiencyInStiffness::none;
  if (antenna.resonance->frequency && rings_as_rigid(antenna)) {
    evidence.resonance_frequency = uncertain(*antenna.resonance->frequency);
  }
  for (const auto& impulse : antenna.impulse_results) {
    evidence.impulse.push_back({impulse.name + " friction", uncertain(impulse.reflected_inertia)});
  }
  return evidence;
}

}  // namespace boresight::io
