#include <algorithm>
#include <cmath>
#include <limits>

#include <boresight/app/identify/record_traces.hpp>
#include <boresight/identification/records/record_defects.hpp>
#include <boresight/io/campaign/loaded_campaign.hpp>

namespace boresight::app {
namespace {

using identification::RawChannel;
using Signal = RecordTrace::Signal;

// Channels of another length than the times are drawn as far as both go.
RecordTrace trace_of(const Eigen::VectorXd& time, const RawChannel& channel, Signal signal) {
  const Eigen::Index count = std::min(time.size(), channel.values.size());
  return {signal, channel.name, thinned(time.head(count), channel.values.head(count)), {}};
}

ThinnedSeries masked_part(const Eigen::VectorXd& time, const identification::Signal& signal) {
  Eigen::VectorXd values = signal.values;
  bool any = false;
  for (Eigen::Index k = 0; k < values.size(); ++k) {
    if (signal.is_valid(k)) {
      values[k] = std::numeric_limits<double>::quiet_NaN();
    } else {
      any = true;
    }
  }
  return any ? thinned(time, values) : ThinnedSeries{};
}

double first_time(const Eigen::VectorXd& time) {
  for (const double t : time) {
    if (std::isfinite(t)) return t;
  }
  return 0.0;
}

}  // namespace

std::vector<RecordTrace> record_traces(const identification::RawRecord& raw,
                                       const identification::CleanRecord& clean,
                                       const identification::DriveKnowledge& knowledge) {
  Eigen::VectorXd even;  // times of the clean record's samples
  if (clean.record) {
    const double begin = first_time(raw.time);
    const Eigen::Index count = clean.record->samples();
    even = Eigen::VectorXd::LinSpaced(
        count, begin, begin + clean.record->sample_time * static_cast<double>(count - 1));
  }
  std::vector<RecordTrace> traces{trace_of(raw.time, raw.tachometer, Signal::tachometer)};
  if (clean.record) traces.back().masked = masked_part(even, clean.record->motor_rate);
  if (raw.rate_command) {
    traces.push_back(trace_of(raw.time, *raw.rate_command, Signal::rate_command));
  }
  if (raw.valve_command) {
    traces.push_back(trace_of(raw.time, *raw.valve_command, Signal::valve_command));
  }
  for (const bool inlet : {true, false}) {
    const auto& side = inlet ? raw.inlet : raw.outlet;
    for (std::size_t motor = 0; motor < side.size(); ++motor) {
      traces.push_back(trace_of(raw.time, side[motor], Signal::pressure));
      if (!clean.record) continue;
      const auto& cleaned = inlet ? clean.record->inlet_pressure : clean.record->outlet_pressure;
      if (motor < cleaned.size()) traces.back().masked = masked_part(even, cleaned[motor]);
    }
  }
  if (clean.record && !clean.record->inlet_pressure.empty()) {
    const Eigen::VectorXd torque = identification::recorded_torque(*clean.record, knowledge);
    traces.push_back({Signal::torque, "", thinned(even, torque), {}});
  }
  return traces;
}

std::vector<std::vector<RecordTrace>> campaign_traces(const io::LoadedCampaign& loaded) {
  std::vector<std::vector<RecordTrace>> traces;
  traces.reserve(loaded.records.size());
  for (const auto& work : loaded.records) {
    traces.push_back(record_traces(work.raw, work.clean, loaded.knowledge));
  }
  return traces;
}

}  // namespace boresight::app
