#include <cmath>
#include <optional>
#include <set>

#include <fmt/format.h>

#include <boresight/io/case/case_campaign.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_mechanics.hpp>
#include <boresight/io/case/case_motor.hpp>
#include <boresight/io/case/case_sections.hpp>
#include <boresight/io/case/case_structure.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/modes_file.hpp>
#include <boresight/io/case/pointing_axis.hpp>
#include <boresight/io/case/structure_numbers.hpp>
#include <boresight/io/units/unit_table.hpp>
#include <boresight/io/units/wording.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::io {
namespace {

AssemblyPart read_part(TableReader& entry, std::set<std::string>& names) {
  AssemblyPart part;
  part.name = read_name(entry, names);
  part.description = entry.optional_text("description").value_or("");
  part.radius = entry.optional_quantity("radius", Kind::length, Range::positive(100.0));
  part.length = entry.optional_quantity("length", Kind::length, Range::positive(100.0));
  part.inertia = entry.optional_quantity("inertia", Kind::inertia, Range::positive());
  // First, so that a misspelt key is named and not its absence.
  entry.finish();
  if (part.radius.has_value() != part.length.has_value()) {
    entry.refuse(part.radius ? "length" : "radius",
                 std::string("expected radius and length together, found the ") +
                     (part.radius ? "radius" : "length") + " alone");
  }
  if (!part.radius && !part.inertia) {
    entry.refuse("inertia", "expected an inertia, or radius and length of a disk, found neither");
  }
  return part;
}

/// Names that must differ: those of assemblies, and those of parts whatever assembly they are in.
struct NamesInUse {
  std::set<std::string> assemblies, parts;
};

RotatingAssembly read_assembly(TableReader& entry, long stages, NamesInUse& names) {
  RotatingAssembly assembly;
  assembly.name = read_name(entry, names.assemblies);
  if (assembly.name == "antenna") {
    entry.refuse("name",
                 "expected another name than 'antenna', which load_inertia.antenna bears, "
                 "found 'antenna'");
  }
  assembly.description = entry.optional_text("description").value_or("");
  assembly.count = entry.integer("count", 1, 1000);
  assembly.stages = static_cast<std::size_t>(entry.integer("stages", 0, stages));
  assembly.inertia = entry.optional_quantity("inertia", Kind::inertia, Range::positive());
  for (auto& part : entry.tables("part")) assembly.parts.push_back(read_part(part, names.parts));
  entry.finish();
  if (!assembly.inertia && assembly.parts.empty()) {
    entry.refuse("inertia", "expected an inertia or parts to sum, found neither");
  }
  return assembly;
}

// Fills the structure from an export of a finite-element program.
void take_modes_file(TableReader& table, const std::string& name, Case& antenna) {
  for (const char* key :
       {"bull_gear_wind_fraction", "bull_gear_beam_weight", "mode_frequencies", "mode"}) {
    if (table.has(key)) {
      table.refuse(key, "expected either a modes_file or what it says, found both");
    }
    table.optional_text(key);  // known keys all the same
  }
  const std::string path = beside_case(antenna.path, name);
  const auto held = read_modes_file(path);
  const double inertia = antenna.antenna->inertia.value;
  if (std::abs(held.antenna_inertia - inertia) > 0.2 * inertia) {
    throw InvalidInput(
        fmt::format("{}: expected an inertia of the free turn within 20 % of antenna.inertia, "
                    "{:.4g} kg.m2, found {:.4g} kg.m2",
                    path, inertia, held.antenna_inertia));
  }
  const auto number = [&](double value) {
    Quantity quantity;
    quantity.value = value;
    quantity.key = table.path("modes_file");
    quantity.location = table.location("modes_file");
    return quantity;
  };
  StructureEntry& structure = *antenna.structure;
  structure.bull_gear_wind_fraction = number(held.bull_gear_wind_fraction);
  structure.bull_gear_beam_weight = number(held.bull_gear_beam_weight);
  for (const auto& mode : held.modes) {
    if (mode.frequency <= structure.locked_rotor_frequency.value) {
      throw InvalidInput(fmt::format(
          "{}: expected modes above locked_rotor_frequency, {:.6g} Hz, with the bull gear held, "
          "found one of {:.6g} Hz",
          path, structure.locked_rotor_frequency.value, mode.frequency));
    }
    structure.modes.push_back({number(mode.frequency), number(mode.damping_ratio),
                               number(mode.inertia_fraction), number(mode.wind_fraction),
                               number(mode.beam_weight)});
  }
}

// One of the two, the same of all modes, and the effective one only with the motors held.
void check_fractions(const TableReader& entry, const StructureEntry& structure,
                     const StructureModeEntry& mode) {
  const bool effective = mode.effective_fraction.has_value();
  if (effective == entry.has("inertia_fraction")) {
    entry.refuse(effective ? "effective_fraction" : "inertia_fraction",
                 std::string("expected either inertia_fraction or, of a mode with the motors held, "
                             "effective_fraction, found ") +
                     (effective ? "both" : "neither"));
  }
  if (effective && !structure.motors_held) {
    entry.refuse("effective_fraction",
                 "expected mode_frequencies = \"motors_held\" in [structure] with it, found "
                 "frequencies with the bull gear held, to which inertia_fraction belongs");
  }
  if (structure.modes.empty()) return;
  const bool before = structure.modes.front().effective_fraction.has_value();
  if (effective != before) {
    entry.refuse(effective ? "effective_fraction" : "inertia_fraction",
                 fmt::format("expected {} as of the modes before it, found {}",
                             before ? "effective_fraction" : "inertia_fraction",
                             effective ? "effective_fraction" : "inertia_fraction"));
  }
}

void check_sum_of_fractions(const TableReader& table, const StructureEntry& structure, double sum) {
  if (sum < 1.0) return;
  const bool effective = structure.modes.front().effective_fraction.has_value();
  table.refuse("mode", fmt::format("expected {} to sum to less than 1 (the rest {}), found {:.6g}",
                                   effective ? "effective_fraction" : "inertia_fraction",
                                   effective ? "belongs to the lowest mode with the motors held"
                                             : "sits at the bull gear",
                                   sum));
}

// Frequencies with the motors held must belong to an antenna of the stated fractions, and effective
// ones give those with the bull gear held.
void solve_motors_held(const TableReader& table, StructureEntry& structure) {
  if (!structure.motors_held) return;
  try {
    const auto antenna = structure_specification(structure);
    for (std::size_t i = 0; i < structure.modes.size(); ++i) {
      const auto& effective = structure.modes[i].effective_fraction;
      if (!effective) continue;
      const double value = antenna.modes[i].inertia_fraction;
      Quantity fraction = derived_quantity(*effective, Kind::number, value, "");
      fraction.text = fmt::format("{:.4g}", value);
      fraction.key.clear();  // moves with all that is stated, and has its uncertainty from there
      fraction.standard_uncertainty = 0.0;
      structure.modes[i].inertia_fraction = std::move(fraction);
    }
  } catch (const InvalidInput& error) {
    table.refuse("mode_frequencies", error.what());
  }
}

// By the stiffness of the gear train, where the case states that alone.
void derive_locked_rotor_frequency(const TableReader& table, Case& antenna) {
  const char* const key = "locked_rotor_frequency";
  if (table.has(key)) return;
  StructureEntry& structure = *antenna.structure;
  const auto& stated = structure.gear_stiffness;
  if (!stated) {
    table.refuse(key, "expected locked_rotor_frequency or gear_stiffness, found neither");
  }
  if (structure.motors_held || table.has("modes_file")) {
    table.refuse(key, fmt::format("expected it beside {}, found gear_stiffness alone",
                                  structure.motors_held ? "frequencies with the motors held"
                                                        : "a modes_file"));
  }
  const plant::StructureSpecification per_inertia = structure_specification(structure);
  const double stiffness = stated->value / antenna.antenna->inertia.value;
  double frequency = 0.0, stiffer = 0.0;
  try {
    frequency = locked_rotor_frequency_for(per_inertia, stiffness);
    stiffer =
        locked_rotor_frequency_for(per_inertia, stiffness * (1.0 + relative_uncertainty(*stated)));
  } catch (const InvalidInput& error) {
    table.refuse("gear_stiffness", fmt::format("{} ({})", error.what(), in_quotes(stated->text)));
  }
  constexpr double highest = 1000.0;  // Hz, of a stated one
  if (frequency > highest) {
    table.refuse("gear_stiffness",
                 fmt::format("expected a locked-rotor frequency by it and antenna.inertia of at "
                             "most 1000 Hz, found {} and {:.6g} Hz",
                             in_quotes(stated->text), frequency));
  }
  structure.locked_rotor_frequency = derived_quantity(*stated, Kind::frequency, frequency, "Hz");
  structure.locked_rotor_frequency.standard_uncertainty = stiffer - frequency;
}

// What a case may say of its motors' inertia.
struct MotorInertias {
  std::optional<Quantity> built, rotor, disk, disk_radius, disk_length, disk_density;
};

constexpr double steel_density = 7850.0;  // kg/m3

Quantity density_of_steel(const std::string& key) {
  Quantity density;
  density.value = steel_density;
  density.text = fmt::format("{:g} kg/m3", steel_density);
  density.kind = Kind::density;
  density.basis = Basis::assumed;
  density.source = "steel";
  density.key = key;
  return density;
}

MotorInertias read_motor_inertias(TableReader& table) {
  MotorInertias stated;
  stated.built = table.optional_quantity("inertia", Kind::inertia, Range::positive());
  stated.rotor = table.optional_quantity("rotor_inertia", Kind::inertia, Range::positive());
  stated.disk = table.optional_quantity("disk_inertia", Kind::inertia, Range::positive());
  stated.disk_radius = table.optional_quantity("disk_radius", Kind::length, Range::positive(100.0));
  stated.disk_length = table.optional_quantity("disk_length", Kind::length, Range::positive(100.0));
  stated.disk_density =
      table.optional_quantity("disk_density", Kind::density, Range::between(100.0, 25000.0));
  if (stated.disk_radius && !stated.disk_density) {
    // Listed as assumed only where an inertia rests on it, and not for the audit alone.
    stated.disk_density = stated.disk
                              ? density_of_steel(table.path("disk_density"))
                              : table.assume("disk_density", Kind::density, steel_density, "steel");
  }
  return stated;
}

// Of one flywheel disk, as stated or of a solid one.
Quantity disk_inertia_of(const TableReader& table, const MotorInertias& stated) {
  const auto& [built, rotor, disk, radius, length, density] = stated;
  if (radius.has_value() != length.has_value()) {
    table.refuse(radius ? "disk_length" : "disk_radius",
                 std::string("expected disk_radius and disk_length together, found the ") +
                     (radius ? "radius" : "length") + " alone");
  }
  if (disk) {
    if (density && !radius) {
      table.refuse("disk_density", "expected disk_radius and disk_length beside it, found neither");
    }
    return *disk;
  }
  if (!radius || !length || !density) {
    table.refuse("disk_inertia",
                 "expected disk_inertia, or disk_radius and disk_length, found neither");
  }
  return solid_disk(*radius, *length, *density);
}

// As built and bare: both as stated, or one by the other and the disks.
void take_motor_inertias(const TableReader& table, const MotorInertias& stated, MotorEntry& motor) {
  motor.disk_inertia = disk_inertia_of(table, stated);
  motor.disk_inertia_stated = stated.disk.has_value();
  motor.disk_radius = stated.disk_radius;
  motor.disk_length = stated.disk_length;
  motor.disk_density = stated.disk_density;
  const char* disk = stated.disk ? "disk_inertia" : "disk_radius";
  const double disks = motor.flywheel_disks * motor.disk_inertia.value;
  const double of_disks = motor.flywheel_disks * motor.disk_inertia.standard_uncertainty;
  const auto by = [&](const Quantity& other, double value) {
    Quantity inertia = derived_quantity(other, Kind::inertia, value, "kg.m2");
    inertia.standard_uncertainty = std::hypot(other.standard_uncertainty, of_disks);
    return inertia;
  };
  if (stated.built) {
    motor.inertia = *stated.built;
    const double sum = stated.rotor ? stated.rotor->value + disks : motor.inertia.value;
    if (std::abs(sum - motor.inertia.value) > 0.05 * motor.inertia.value) {
      table.refuse(disk,
                   fmt::format("expected rotor_inertia + flywheel_disks x disk_inertia within "
                               "5 % of inertia ({:.6g} kg.m2), found {:.6g} kg.m2",
                               motor.inertia.value, sum));
    }
    const double bare = motor.inertia.value - disks;
    if (bare <= 0.0) {
      table.refuse(disk, fmt::format("expected flywheel_disks x disk_inertia below inertia, found "
                                     "{:.6g} kg.m2 left of it without them",
                                     bare));
    }
    motor.rotor_inertia = stated.rotor ? *stated.rotor : by(*stated.built, bare);
  } else if (stated.rotor) {
    motor.rotor_inertia = *stated.rotor;
    motor.inertia = by(*stated.rotor, stated.rotor->value + disks);
  } else {
    table.refuse("inertia", "expected inertia, rotor_inertia or both, found neither");
  }
}

}  // namespace

void read_antenna(TableReader& file, Case& antenna) {
  TableReader table = file.table("antenna");
  antenna.antenna->dish_diameter =
      table.quantity("dish_diameter", Kind::length, Range::between(0.5, 1000.0));
  antenna.antenna->inertia = table.quantity("inertia", Kind::inertia, Range::positive());
  constexpr double turn = two_pi;
  antenna.antenna->azimuth =
      table.optional_quantity("azimuth", Kind::angle, Range::between(-turn, turn));
  antenna.antenna->elevation =
      table.optional_quantity("elevation", Kind::angle, Range::between(0.0, 0.5 * turn));
  antenna.antenna->y_angle =
      table.optional_quantity("y_angle", Kind::angle, Range::between(-0.25 * turn, 0.25 * turn));
  if (antenna.antenna->y_angle && antenna.axis != "X") {
    table.refuse("y_angle", "expected it with axis = 'X', of an X-Y mount, only, found it with " +
                                in_quotes(antenna.axis));
  }
  constexpr double min_cosine = 0.05;
  if (pointing_axis(antenna).boresight_factor < min_cosine) {
    const bool azimuth = antenna.axis == "azimuth";
    table.refuse(azimuth ? "elevation" : "y_angle",
                 azimuth ? "expected one at which an azimuth axis moves the boresight, 3 deg or "
                           "more from the zenith, found " +
                               antenna.antenna->elevation->text
                         : "expected one at which the X axis moves the boresight, 3 deg or more "
                           "from -90 and 90 deg, found " +
                               antenna.antenna->y_angle->text);
  }
  std::set<std::string> names;
  for (auto& entry : table.tables("alternative")) {
    AntennaAlternative alternative;
    alternative.name = read_name(entry, names);
    alternative.inertia = entry.optional_quantity("inertia", Kind::inertia, Range::positive());
    alternative.reflected_inertia =
        entry.optional_quantity("reflected_inertia", Kind::inertia, Range::positive());
    if (entry.optional_text("keeps")) {
      alternative.keeps_springs = entry.choice("keeps", {"frequencies", "springs"}) == "springs";
    }
    entry.finish();
    if (alternative.inertia.has_value() == alternative.reflected_inertia.has_value()) {
      entry.refuse("inertia", std::string("expected either inertia (about the antenna axis) or "
                                          "reflected_inertia (at the motor shaft), found ") +
                                  (alternative.inertia ? "both" : "neither"));
    }
    antenna.antenna->alternatives.push_back(std::move(alternative));
  }
  table.finish();
}

void read_gear_train(TableReader& file, Case& antenna) {
  TableReader table = file.table("gear_train");
  GearTrainEntry& train = *antenna.gear_train;
  train.density = table.optional_quantity("density", Kind::density, Range::between(100.0, 25000.0));
  for (auto& entry : table.tables("stage", true)) {
    GearStageEntry stage;
    stage.driven_teeth = entry.quantity("driven_teeth", Kind::number, Range::positive(1e6));
    stage.driving_teeth = entry.quantity("driving_teeth", Kind::number, Range::positive(1e6));
    entry.finish();
    train.stages.push_back(std::move(stage));
  }
  NamesInUse names;
  for (auto& entry : table.tables("assembly")) {
    train.assemblies.push_back(read_assembly(entry, static_cast<long>(train.stages.size()), names));
  }
  table.finish();
  for (const auto& assembly : train.assemblies) {
    for (const auto& part : assembly.parts) {
      if (part.radius && !train.density) {
        table.refuse("density", "expected a density for the disks' dimensions, found none");
      }
    }
  }
}

void read_motor(TableReader& file, Case& antenna) {
  TableReader table = file.table("motor");
  MotorEntry& motor = *antenna.motor;
  motor.count = table.integer("count", 1, 1000);
  motor.flywheel_disks = static_cast<double>(table.integer("flywheel_disks", 0, 10000));
  const MotorInertias inertias = read_motor_inertias(table);
  motor.displacement = table.quantity("displacement", Kind::displacement, Range::positive(1.0));
  motor.torque_efficiency = table.quantity("torque_efficiency", Kind::number, Range::positive(1.0));
  motor.volumetric_efficiency =
      table.quantity("volumetric_efficiency", Kind::number, Range::positive(1.0));
  table.finish();
  take_motor_inertias(table, inertias, motor);
}

void read_structure(TableReader& file, Case& antenna) {
  TableReader table = file.table("structure");
  StructureEntry& structure = *antenna.structure;
  const Range damping = Range::between(0.0, 1.0);
  const Range unit_range = Range::between(0.0, 1.0);
  const Range fractions = Range::positive(1.0);
  structure.locked_rotor_frequency =
      table.optional_quantity("locked_rotor_frequency", Kind::frequency, Range::positive(1000.0))
          .value_or(Quantity{});
  structure.gear_stiffness =
      table.optional_quantity("gear_stiffness", Kind::stiffness, Range::positive());
  structure.gear_damping_ratio = table.quantity("gear_damping_ratio", Kind::number, damping);
  const auto modes_file = table.optional_text("modes_file");
  if (modes_file) {
    take_modes_file(table, *modes_file, antenna);
  } else {
    structure.bull_gear_wind_fraction =
        table.quantity("bull_gear_wind_fraction", Kind::number, unit_range);
    structure.bull_gear_beam_weight =
        table.quantity("bull_gear_beam_weight", Kind::number, Range::between(-10.0, 10.0));
    if (table.optional_text("mode_frequencies")) {
      structure.motors_held =
          table.choice("mode_frequencies", {"bull_gear_held", "motors_held"}) == "motors_held";
    }
  }
  structure.lowest_predicted =
      table.optional_quantity("lowest_predicted", Kind::frequency, Range::positive(1000.0));
  if (structure.lowest_predicted) {
    structure.lowest_predicted_axis =
        table.choice("lowest_predicted_axis", {"elevation", "azimuth", "X", "Y"});
  }
  for (auto& entry : table.tables("prediction")) {
    auto& frequencies = antenna.campaign->locked_rotor_frequencies;
    frequencies.push_back(entry.quantity("frequency", Kind::frequency, Range::positive(1000.0)));
    entry.finish();
    if (frequencies.size() > 1 && frequencies.back().value <= frequencies.rbegin()[1].value) {
      entry.refuse("frequency", "expected frequencies that rise, found one not above the last");
    }
  }
  if (modes_file) {
    table.finish();
    derive_locked_rotor_frequency(table, antenna);
    return;
  }
  double fraction = 0.0;
  double wind = structure.bull_gear_wind_fraction.value;
  double boresight = structure.bull_gear_beam_weight.value;
  for (auto& entry : table.tables("mode")) {
    StructureModeEntry mode;
    mode.frequency = entry.quantity("frequency", Kind::frequency, Range::positive(1000.0));
    mode.damping_ratio = entry.quantity("damping_ratio", Kind::number, damping);
    mode.inertia_fraction =
        entry.optional_quantity("inertia_fraction", Kind::number, fractions).value_or(Quantity{});
    mode.effective_fraction =
        entry.optional_quantity("effective_fraction", Kind::number, fractions);
    mode.wind_fraction = entry.quantity("wind_fraction", Kind::number, Range::between(-1.0, 1.0));
    mode.beam_weight = entry.quantity("beam_weight", Kind::number, Range::between(-10.0, 10.0));
    const Quantity& below = structure.modes.empty() ? structure.locked_rotor_frequency
                                                    : structure.modes.back().frequency;
    if (structure.motors_held && mode.frequency.value <= below.value) {
      entry.refuse("frequency",
                   fmt::format("expected frequencies with the motors held that rise from "
                               "locked_rotor_frequency, found {} behind {}",
                               in_quotes(mode.frequency.text), in_quotes(below.text)));
    }
    if (mode.frequency.value <= structure.locked_rotor_frequency.value) {
      entry.refuse(
          "frequency",
          fmt::format("expected a frequency above locked_rotor_frequency, {:.6g} Hz (the "
                      "gear spring can only lower a mode), found {}",
                      structure.locked_rotor_frequency.value, in_quotes(mode.frequency.text)));
    }
    entry.finish();
    check_fractions(entry, structure, mode);
    fraction += mode.effective_fraction.value_or(mode.inertia_fraction).value;
    wind += mode.wind_fraction.value;
    boresight += mode.beam_weight.value;
    structure.modes.push_back(std::move(mode));
  }
  table.finish();
  check_sum_of_fractions(table, structure, fraction);
  if (std::abs(wind - 1.0) > 1e-6) {
    table.refuse("mode",
                 fmt::format("expected bull_gear_wind_fraction and the modes' wind_fraction to sum "
                             "to 1, found {:.6g}",
                             wind));
  }
  if (std::abs(boresight - 1.0) > 1e-6) {
    table.refuse("mode",
                 fmt::format("expected bull_gear_beam_weight and the modes' beam_weight to sum to "
                             "1, found {:.6g}",
                             boresight));
  }
  derive_locked_rotor_frequency(table, antenna);
  solve_motors_held(table, structure);
}

}  // namespace boresight::io
