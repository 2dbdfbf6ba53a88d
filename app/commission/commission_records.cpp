#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/commission/commission_study.hpp>
#include <boresight/io/campaign/loaded_record.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::app {
namespace {

using identification::Signal;

const identification::DriveRecord& find_record(const std::vector<io::LoadedRecord>& records,
                                               const std::string& name) {
  std::vector<std::string> known;
  for (const auto& one : records) {
    if (one.notes.name == name) {
      if (one.clean.record) return *one.clean.record;
      throw InvalidInput(
          fmt::format("commission: the record '{}' cannot be used: {}", name, one.clean.refusal));
    }
    known.push_back(one.notes.name);
  }
  throw InvalidInput(fmt::format("commission: expected a record of the case, {}, found '{}'",
                                 fmt::join(known, ", "), name));
}

std::vector<bool> both(const std::vector<bool>& one, const std::vector<bool>& other) {
  if (one.empty()) return other;
  std::vector<bool> result = one;
  for (std::size_t i = 0; i < other.size(); ++i) result[i] = result[i] && other[i];
  return result;
}

design::RecordedChannel channel(const Eigen::VectorXd& values, const std::vector<bool>& valid,
                                double sample_time) {
  return {values, valid, sample_time};
}

design::RecordedChannel torque_of(const identification::DriveRecord& record,
                                  const identification::DriveKnowledge& knowledge) {
  std::vector<bool> valid;
  for (const auto& signal : record.inlet_pressure) valid = both(valid, signal.valid);
  for (const auto& signal : record.outlet_pressure) valid = both(valid, signal.valid);
  return channel(identification::recorded_torque(record, knowledge), valid, record.sample_time);
}

design::RecordedChannel rate_error(const identification::DriveRecord& record,
                                   const Signal& command) {
  return channel(record.motor_rate.values - command.values,
                 both(record.motor_rate.valid, command.valid), record.sample_time);
}

design::RecordedChannel of(const Signal& signal, double sample_time) {
  return channel(signal.values, signal.valid, sample_time);
}

}  // namespace

std::vector<ChannelComparison> compare_case_records(const io::Case& antenna,
                                                    const std::string& before,
                                                    const std::string& after, unsigned threads) {
  if (antenna.campaign.records.empty()) {
    throw InvalidInput(fmt::format(
        "{}: expected [[record]]s to compare, found none: name both records in the case",
        antenna.path));
  }
  if (before == after) {
    throw InvalidInput(
        fmt::format("commission: expected two records to compare, found '{}' twice", before));
  }
  const auto records = load_records(antenna, threads);
  const identification::DriveRecord& first = find_record(records, before);
  const identification::DriveRecord& second = find_record(records, after);
  io::CampaignNotes notes;
  const auto knowledge = drive_knowledge(antenna, notes);
  std::vector<ChannelComparison> result;
  const auto add = [&](const char* name, const char* unit, const design::RecordedChannel& one,
                       const design::RecordedChannel& other) {
    ChannelComparison comparison;
    comparison.channel = name;
    comparison.unit = unit;
    try {
      comparison.comparison = design::compare_records(one, other);
    } catch (const NumericalFailure& failure) {
      // Clipped too often; other channels may serve.
      comparison.not_compared = failure.what();
    }
    result.push_back(std::move(comparison));
  };
  if (first.rate_command && second.rate_command) {
    add("motor rate less its command", "rad/s", rate_error(first, *first.rate_command),
        rate_error(second, *second.rate_command));
  }
  add("motor rate", "rad/s", of(first.motor_rate, first.sample_time),
      of(second.motor_rate, second.sample_time));
  if (!first.inlet_pressure.empty() && !second.inlet_pressure.empty()) {
    add("torque", "N.m", torque_of(first, knowledge), torque_of(second, knowledge));
  }
  if (first.valve_command && second.valve_command) {
    add("valve command", "rad/s", of(*first.valve_command, first.sample_time),
        of(*second.valve_command, second.sample_time));
  }
  return result;
}

}  // namespace boresight::app
