#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <boresight/control/controllers/sample_time.hpp>
#include <boresight/io/case/case_campaign.hpp>
#include <boresight/io/case/case_drive.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_goals.hpp>
#include <boresight/io/case/case_mechanics.hpp>
#include <boresight/io/case/case_motor.hpp>
#include <boresight/io/case/case_oil.hpp>
#include <boresight/io/case/case_sensors.hpp>
#include <boresight/io/case/case_simulation.hpp>
#include <boresight/io/case/case_structure.hpp>
#include <boresight/io/case/case_tuning.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/field.hpp>
#include <boresight/io/case/plant_numbers.hpp>
#include <boresight/io/case/structure_numbers.hpp>
#include <boresight/io/proposals/dependent_changes.hpp>

namespace boresight::io {
namespace {

double motors_displacement(const Case& antenna) {
  return static_cast<double>(antenna.motor->count) * antenna.motor->displacement.value;
}

double compliance_of_sides(const Case& antenna) {
  return 1.0 / antenna.oil->volume_1.value + 1.0 / antenna.oil->volume_2.value;
}

// As rated_stroke has it.
double no_load_pressure(const Case& antenna) {
  const std::optional<Quantity> returned =
      antenna.simulation ? antenna.simulation->return_pressure : antenna.campaign->return_pressure;
  return antenna.drive->supply_pressure.value - (returned ? returned->value : 0.0);
}

// A number of the same antenna in other terms, as uncertain for its size.
Quantity in_other_terms(const Quantity& stated, double value, const char* unit) {
  Quantity quantity = derived_quantity(stated, stated.kind, value, unit);
  quantity.standard_uncertainty = relative_uncertainty(stated) * value;
  return quantity;
}

// Frequencies with the motors held would move with the gear spring.
void hold_bull_gear(StructureEntry& structure) {
  if (!structure.motors_held) return;
  const plant::StructureSpecification held = structure_specification(structure);
  for (std::size_t i = 0; i < structure.modes.size(); ++i) {
    StructureModeEntry& mode = structure.modes[i];
    mode.frequency = in_other_terms(mode.frequency, held.modes[i].frequency, "Hz");
    if (!mode.effective_fraction) continue;
    const double fraction = held.modes[i].inertia_fraction;
    mode.inertia_fraction = in_other_terms(*mode.effective_fraction, fraction, "");
    mode.inertia_fraction.text = fmt::format("{:.4g}", fraction);
    mode.effective_fraction.reset();
  }
  structure.motors_held = false;
}

void follow_gear(const Case& before, Case& after) {
  const double up = gear_ratio(after) / gear_ratio(before);
  if (up == 1.0 || !after.simulation) return;
  auto& simulation = *after.simulation;
  if (simulation.backlash) simulation.backlash->value *= up;
  simulation.offset_torque.value /= up;
  if (simulation.offset_cosine) simulation.offset_cosine->value /= up;
  if (simulation.offset_sine) simulation.offset_sine->value /= up;
}

void follow_ensemble(const Case& before, Case& after) {
  const auto scale = [](std::optional<RangeEntry>& range, double factor) {
    if (!range) return;
    range->lower.value *= factor;
    range->upper.value *= factor;
  };
  scale(after.ensemble->leakage_rate,
        after.drive->leakage_rate.value / before.drive->leakage_rate.value);
  const double friction = tracking_friction(before);
  if (friction > 0.0) {
    scale(after.ensemble->viscous_friction, tracking_friction(after) / friction);
  }
}

}  // namespace

void refuse_change(const ProposedChange& change, const std::string& message) {
  refuse_at(change.number.location, change.key, message);
}

double changed(const ProposedChange& change, double before) {
  return change.multiplies ? change.number.value * before : change.number.value;
}

// A number of a case with the change's word instead of its own.
Quantity changed(const ProposedChange& change, const Quantity& before) {
  if (!change.multiplies) return change.number;
  Quantity after = before;
  const double factor = change.number.value;
  after.value *= factor;
  after.standard_uncertainty *= std::abs(factor);
  after.half_unit *= std::abs(factor);
  after.text = fmt::format("{} x {}", before.text, change.number.text);
  after.also.clear();
  return after;
}

void check_changed_range(const ProposedChange& change, Kind kind, const Range& range,
                         double value) {
  const bool within = range.minimum_excluded ? value > range.minimum : value >= range.minimum;
  if (within && value <= range.maximum) return;
  const std::string unit = kind == Kind::number ? "" : fmt::format(" {}", describe(kind).si_unit);
  const std::string minimum =
      fmt::format("{} {:g}{}", range.minimum_excluded ? "above" : "from", range.minimum, unit);
  const std::string maximum =
      range.maximum < 1e299 ? fmt::format(" to {:g}{}", range.maximum, unit) : "";
  refuse_change(change,
                fmt::format("expected a result {}{}, found {:g}{}", minimum, maximum, value, unit));
}

void stiffen_gear(const ProposedChange& change, StructureEntry& structure) {
  const double factor = change.number.value;
  if (!(factor > 0.0)) {
    refuse_change(change, fmt::format("expected a factor above 0, found {:g}", factor));
  }
  hold_bull_gear(structure);
  const plant::StructureSpecification antenna = structure_specification(structure);
  const double stiffness = factor * plant::make_structure(antenna).gear_stiffness;
  double frequency = 0.0;
  try {
    frequency = locked_rotor_frequency_for(antenna, stiffness);
  } catch (const InvalidInput& error) {
    refuse_change(change, error.what());
  }
  check_changed_range(change, Kind::frequency, Range::positive(1000.0), frequency);
  structure.locked_rotor_frequency =
      in_other_terms(structure.locked_rotor_frequency, frequency, "Hz");
}

namespace {

// Of those stated, whichever part they hold.
double fastest_mode(const StructureEntry& structure) {
  double fastest = structure.locked_rotor_frequency.value;
  for (const auto& mode : structure.modes) fastest = std::max(fastest, mode.frequency.value);
  return fastest;
}

}  // namespace

void follow_sampling(const Case& before, const Proposal& proposal, Case& after) {
  const auto* rate = proposal.find("controller.sample_rate");
  const auto* delay = proposal.find("controller.delay");
  if (rate != nullptr) {
    const double sample = 1.0 / rate->number.value;
    if (delay == nullptr) {
      after.controller->delay.value = control::dead_time_of(sample);
      after.controller->delay.text = fmt::format("{:.4g} s", after.controller->delay.value);
    } else if (after.controller->delay.value < 0.5 * sample) {
      refuse_change(*delay,
                    fmt::format("expected at least the {:.4g} s that holding a sample takes at "
                                "controller.sample_rate, found {:.4g} s",
                                0.5 * sample, after.controller->delay.value));
    }
    if (proposal.find("sensors.noise_bandwidth") == nullptr) {
      after.sensors->noise_bandwidth.value = 0.5 * rate->number.value;
      after.sensors->noise_bandwidth.text = fmt::format("{:g} Hz", 0.5 * rate->number.value);
    }
  }
  // The fastest thing a loop must see: below half the rate, or it comes back as another
  // frequency.
  const double fastest = std::max(fastest_mode(*before.structure), fastest_mode(*after.structure));
  const double sampled = rate != nullptr
                             ? rate->number.value
                             : 1.0 / control::sample_time_of(after.controller->delay.value);
  const auto* slow = rate != nullptr ? rate : delay;
  const bool slower = sampled < 1.0 / control::sample_time_of(before.controller->delay.value);
  if (slow != nullptr && slower && sampled < 2.0 * fastest) {
    refuse_change(
        *slow, fmt::format("expected a sampling of at least {:.4g} Hz, twice the fastest mode of "
                           "the structure ({:.4g} Hz), found {:.4g} Hz{}: the loops cannot see "
                           "what lies above half of it",
                           2.0 * fastest, fastest, sampled,
                           rate != nullptr ? "" : " by the delay of one and a half samples"));
  }
}

void follow_drive(const Case& before, const Proposal& proposal, Case& after) {
  const auto& own = *before.motor;
  for (auto& assembly : after.gear_train->assemblies) {
    if (assembly.count == own.count) assembly.count = after.motor->count;
  }
  const double displaced = motors_displacement(after) / motors_displacement(before);
  double opened = 1.0;
  if (const auto* pressure = proposal.find("drive.supply_pressure")) {
    if (no_load_pressure(after) <= 0.0) {
      refuse_change(*pressure, fmt::format("expected more than {}.return_pressure, found {:.4g} Pa",
                                           after.simulation ? "simulation" : "drive",
                                           after.drive->supply_pressure.value));
    }
    opened = std::sqrt(no_load_pressure(after) / no_load_pressure(before));
  }
  if (after.drive->valve_rated_flow && before.drive->valve_rated_flow) {
    opened *= after.drive->valve_rated_flow->value / before.drive->valve_rated_flow->value;
  }
  const auto stated = [&](std::string_view key) {
    const auto* change = proposal.find(key);
    return change != nullptr && !change->multiplies;
  };
  if (after.sensors->torque_noise && !stated("sensors.torque_noise")) {
    after.sensors->torque_noise->value *= displaced;
  }
  if (!stated("drive.leakage_rate")) {
    after.drive->leakage_rate.value *= bulk_modulus(after) / bulk_modulus(before) *
                                       compliance_of_sides(after) / compliance_of_sides(before) *
                                       static_cast<double>(after.motor->count) /
                                       static_cast<double>(own.count);
  }
  double stroke = opened / displaced;
  if (after.simulation && before.simulation) {
    if (!stated("simulation.valve_stroke")) after.simulation->valve_stroke.value *= stroke;
    stroke = after.simulation->valve_stroke.value / before.simulation->valve_stroke.value;
  }
  after.goals->control_effort.value *= stroke;
  follow_gear(before, after);
  follow_ensemble(before, after);
}

}  // namespace boresight::io
