#pragma once

#include <string>
#include <vector>

#include <boresight/app/figures/thinned_series.hpp>

namespace boresight::identification {
struct CleanRecord;
struct DriveKnowledge;
struct RawRecord;
}  // namespace boresight::identification

namespace boresight::io {
struct LoadedCampaign;
}  // namespace boresight::io

namespace boresight::app {

/// The plotted channels of a record, SI at the motor shaft, against time (s, as recorded).
struct RecordTrace {
  enum class Signal { tachometer, rate_command, valve_command, pressure, torque };
  Signal signal = Signal::tachometer;
  std::string channel;  // as the file calls it; empty: the torque of all motors
  ThinnedSeries series;
  /// Values that replace masked samples, with gaps elsewhere; empty if none was masked.
  ThinnedSeries masked;
};

/// The channels as recorded, and the torque that their cleaned pressures make; what a record lacks
/// is left out.
std::vector<RecordTrace> record_traces(const identification::RawRecord& raw,
                                       const identification::CleanRecord& clean,
                                       const identification::DriveKnowledge& knowledge);

/// The traces of every record, in the case's order.
std::vector<std::vector<RecordTrace>> campaign_traces(const io::LoadedCampaign& loaded);

}  // namespace boresight::app
