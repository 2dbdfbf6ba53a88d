#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include <boresight/io/campaign/campaign.hpp>
#include <boresight/io/campaign/loaded_campaign.hpp>
#include <boresight/io/case/case_campaign.hpp>
#include <boresight/io/case/case_drive.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_mechanics.hpp>
#include <boresight/io/case/case_motor.hpp>
#include <boresight/io/case/case_oil.hpp>
#include <boresight/io/case/case_simulation.hpp>
#include <boresight/io/case/case_structure.hpp>
#include <boresight/io/case/drive_evidence.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/field.hpp>
#include <boresight/plant/antenna/gear_train.hpp>

namespace boresight::io {
namespace {

using identification::TestKind;
using numerics::Uncertain;

Uncertain uncertain(const Quantity& quantity) {
  return {quantity.value, quantity.standard_uncertainty};
}

// Of the motors' means over a record, theirs and how far they are from one another (Pa, standard
// deviation).
struct MeanPressures {
  double mean = 0.0;
  double spread = 0.0;
};

MeanPressures mean_pressures(const identification::RawRecord& raw,
                             const std::vector<identification::RawChannel>& side,
                             const std::vector<std::size_t>& replaced) {
  std::vector<double> means;
  for (std::size_t motor = 0; motor < side.size(); ++motor) {
    if (std::find(replaced.begin(), replaced.end(), motor) != replaced.end()) continue;
    double sum = 0.0;
    double count = 0.0;
    for (const double value : side[motor].values.head(raw.time.size())) {
      if (!std::isfinite(value)) continue;
      sum += value;
      count += 1.0;
    }
    if (count > 0.0) means.push_back(sum / count);
  }
  if (means.empty()) return {};
  const double mean =
      Eigen::Map<const Eigen::VectorXd>(means.data(), static_cast<Eigen::Index>(means.size()))
          .mean();
  if (means.size() < 2) return {mean, 0.0};
  double square = 0.0;
  for (const double value : means) square += (value - mean) * (value - mean);
  return {mean, std::sqrt(square / static_cast<double>(means.size() - 1))};
}

// A sum over n motors of which k are the mean of the others has more of the others' errors, and
// does not know what sets the k apart.
void raise_for_replaced(const LoadedRecord& work, identification::Instruments& instruments,
                        const identification::Instruments& stated) {
  const auto motors = static_cast<double>(work.raw.inlet.size());
  double variance = 0.0;  // of the sum of all channels, in those of one
  double unknown = 0.0;
  double zeros =
      0.0;  // of the sum of all channels, what the dead ones' own errors would have added
  for (const auto* replaced : {&work.clean.replaced_inlets, &work.clean.replaced_outlets}) {
    const auto dead = static_cast<double>(replaced->size());
    variance += motors * motors / (motors - dead);
    const auto& side = replaced == &work.clean.replaced_inlets ? work.raw.inlet : work.raw.outlet;
    const MeanPressures others = mean_pressures(work.raw, side, *replaced);
    unknown += dead * std::pow(others.spread, 2);
    // Where too few are left to show how unlike they are, what zeros and gains make of it.
    const double apart = std::max(
        others.spread, std::hypot(stated.pressure_zero, stated.pressure_gain * others.mean));
    zeros += std::pow(apart, 2) * dead * motors / (motors - dead);
  }
  const double growth = std::sqrt(variance / (2.0 * motors));
  instruments.pressure_gain = std::max(instruments.pressure_gain, growth * stated.pressure_gain);
  instruments.pressure_zero =
      std::max(instruments.pressure_zero,
               std::hypot(growth * stated.pressure_zero, std::sqrt(unknown / (2.0 * motors))));
  instruments.unknown_pressure_sum = std::max(instruments.unknown_pressure_sum, std::sqrt(zeros));
}

// A closed rate loop follows its command: with the valve amplifier driven by the command, valve
// and command are one signal.
bool loop_seems_closed(const identification::DriveRecord& record) {
  if (record.test == TestKind::constant_speed || record.test == TestKind::slow_ramp) return true;
  if (record.test != TestKind::fast_ramp && record.test != TestKind::other) return false;
  if (!record.rate_command) return false;
  const Eigen::VectorXd& command = record.rate_command->values;
  // Nothing was asked of the loop.
  if (!(command.norm() > 0.0)) return false;
  if (record.valve_command && record.valve_command->values.norm() > 0.0) {
    const Eigen::VectorXd& valve = record.valve_command->values;
    const double alike = command.dot(valve) / (command.norm() * valve.norm());
    return !(alike > 0.9995);
  }
  const double gain = command.dot(record.motor_rate.values) / command.squaredNorm();
  return gain > 0.9 && gain < 1.1;
}

}  // namespace

identification::DriveKnowledge drive_knowledge(const Case& antenna, CampaignNotes& notes) {
  identification::DriveKnowledge knowledge;
  const identification::DriveEvidence evidence = make_evidence(antenna);
  knowledge.motor_count = evidence.motor_count;
  knowledge.motor_inertia = evidence.motor_inertia;
  for (const auto& assembly : evidence.assemblies) {
    const double ratio = plant::gear_ratio(evidence.stages, assembly.stages);
    const double fraction = assembly.count / (ratio * ratio);
    knowledge.gear_inertia.value += fraction * assembly.inertia.value;
    // Added, not in squares: one density, and the same habit of taking gears for disks.
    knowledge.gear_inertia.standard_uncertainty += fraction * assembly.inertia.standard_uncertainty;
  }
  if (evidence.assemblies.empty()) {
    notes.assumptions.emplace_back("no gear_train.assembly: the gears' inertia was taken as zero");
  }
  knowledge.antenna_inertia = evidence.antenna.front().reflected;
  knowledge.displacement = evidence.displacement;
  knowledge.torque_efficiency = evidence.torque_efficiency;
  knowledge.volumetric_efficiency = evidence.volumetric_efficiency;
  knowledge.oil_density = evidence.oil_density;
  knowledge.volume_1 = evidence.volume_1;
  knowledge.volume_2 = evidence.volume_2;
  knowledge.efficiency_in_stiffness = evidence.efficiency_in_stiffness;
  for (const auto& line : antenna.campaign->lines) {
    knowledge.line_lengths.push_back(uncertain(line.length));
  }
  if (knowledge.line_lengths.empty()) {
    notes.assumptions.emplace_back("no oil.line: slosh tests cannot give a bulk modulus");
  } else if (knowledge.line_lengths.size() != static_cast<std::size_t>(antenna.motor->count)) {
    notes.assumptions.push_back(
        fmt::format("{} oil lines for {} motors: the first was taken as the shortest, the last as "
                    "the longest",
                    knowledge.line_lengths.size(), antenna.motor->count));
  }
  for (const auto& frequency : antenna.campaign->locked_rotor_frequencies) {
    knowledge.locked_rotor_frequencies.push_back(uncertain(frequency));
  }
  if (knowledge.locked_rotor_frequencies.empty()) {
    knowledge.locked_rotor_frequencies.push_back(
        uncertain(antenna.structure->locked_rotor_frequency));
    notes.assumptions.push_back(
        fmt::format("no structure.prediction: {} gives the only structural mode known",
                    antenna.structure->locked_rotor_frequency.key));
  }
  knowledge.supply_pressure = antenna.drive->supply_pressure.value;
  knowledge.supply_uncertainty = uncertain(antenna.drive->supply_pressure).standard_uncertainty;
  if (antenna.campaign->return_pressure) {
    knowledge.return_pressure = antenna.campaign->return_pressure->value;
  } else if (antenna.simulation) {
    knowledge.return_pressure = antenna.simulation->return_pressure.value;
    notes.assumptions.emplace_back(
        "no drive.return_pressure: simulation.return_pressure was taken");
  } else {
    notes.assumptions.emplace_back("no drive.return_pressure: taken as zero");
  }
  if (!(knowledge.supply_pressure > knowledge.return_pressure)) {
    const Quantity& supply = antenna.drive->supply_pressure;
    refuse_at(supply.location, supply.key,
              fmt::format("expected a supply pressure above the return's, {:.4g} Pa, found {} "
                          "({:.4g} Pa)",
                          knowledge.return_pressure, supply.text, supply.value));
  }
  if (!antenna.oil->efficiency_in_stiffness) {
    notes.assumptions.push_back(fmt::format(
        "oil.efficiency_in_stiffness = false: what records show is K with both efficiencies, since "
        "torque counts with one and flow with the other; K = beta D^2 (1/V1 + 1/V2) alone would be "
        "{:.4f} times the oil stiffness found here",
        1.0 / (knowledge.torque_efficiency.value * knowledge.volumetric_efficiency.value)));
  }
  knowledge.gear_ratio = gear_ratio(antenna);
  knowledge.tracking_rate = antenna.drive->tracking_rate.value * knowledge.gear_ratio;
  return knowledge;
}

identification::Campaign make_campaign(const Case& antenna, LoadedCampaign loaded,
                                       CampaignNotes& notes) {
  const auto& entries = antenna.campaign->records;
  auto& works = loaded.records;
  const identification::Instruments stated = loaded.instruments;
  identification::Campaign campaign;
  campaign.knowledge = std::move(loaded.knowledge);
  campaign.instruments = stated;
  notes = {};
  notes.assumptions = std::move(loaded.assumptions);
  std::string replaced;  // names of records
  for (std::size_t i = 0; i < works.size(); ++i) {
    LoadedRecord& work = works[i];
    RecordNotes& note = work.notes;
    note.defects = work.clean.defects;
    note.refusal = work.clean.refusal;
    if (auto& record = work.clean.record) {
      if (entries[i].rate_loop.empty()) {
        record->rate_loop_closed = loop_seems_closed(*record);
        note.rate_loop_guessed = true;
      }
      note.test = record->test;
      note.rate_loop_closed = record->rate_loop_closed;
      note.sample_time = record->sample_time;
      note.duration = record->sample_time * static_cast<double>(record->samples());
      if (!work.clean.replaced_inlets.empty() || !work.clean.replaced_outlets.empty()) {
        raise_for_replaced(work, campaign.instruments, stated);
        replaced += (replaced.empty() ? "" : ", ") + note.name;
      }
      campaign.records.push_back(std::move(*record));
    }
    notes.records.push_back(std::move(note));
  }
  if (!replaced.empty()) {
    notes.assumptions.push_back(fmt::format(
        "a dead pressure was replaced by the mean of the other motors', which depend on the same "
        "common line ({}), and so was one of the wrong sign or port; the pressures' uncertainties "
        "were raised for it",
        replaced));
  }
  // What is said of one record is mostly the columns' fault, and then that of all.
  std::string refused;
  std::size_t count = 0;
  for (const RecordNotes& note : notes.records) {
    if (note.refusal.empty()) continue;
    ++count;
    refused += fmt::format("; {}: {}", note.name, note.refusal);
  }
  if (2 * count > notes.records.size()) {
    throw InvalidInput(
        fmt::format("{}: record: expected most of {} records to be of use, found {} that are not{}",
                    antenna.path, notes.records.size(), count, refused));
  }
  return campaign;
}

identification::Campaign make_campaign(const Case& antenna, CampaignNotes& notes,
                                       unsigned threads) {
  return make_campaign(antenna, load_campaign(antenna, threads), notes);
}

}  // namespace boresight::io
