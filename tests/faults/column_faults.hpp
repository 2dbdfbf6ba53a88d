#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "recorder_fault.hpp"

namespace boresight::faults {

/// Columns of a record.
struct Columns {
  enum class Signal { inlet, outlet, tachometer, encoder, rate_command, valve_command };
  std::vector<Signal> signals;
  std::optional<std::size_t> motor;  // from 0, of pressures; nothing: all
};

/// Records of a campaign.
enum class Records {
  all,
  fast_ramp,    // that one alone
  valve_chirp,  // that one alone
  later_half    // from the middle of the campaign on
};

/// What a fault makes of one column of one record; `place` of `count` records.
struct Spoiled {
  identification::RawRecord& record;
  identification::RawChannel& channel;
  std::size_t place;
  std::size_t count;
  reference::RandomNumbers& random;
};
using Spoil = std::function<void(const Spoiled&)>;

/// The columns that a record has of those.
std::vector<identification::RawChannel*> columns_of(identification::RawRecord& record,
                                                    const Columns& columns);
/// Beginnings of their names.
std::vector<std::string> names_of(const Columns& columns);

/// A fault of these columns in these records.
RecorderFault column_fault(std::string kind, std::string name, const Columns& columns,
                           Records records, const Spoil& spoil);

/// A wrong scale, of the recorder's limits too.
Spoil gain(double factor);
/// From 1 at the campaign's begin to `factor` at its end.
Spoil gain_drift(double factor);
/// Zero of so many parts of the column's largest value in the record.
Spoil zero(double fraction);
/// A zero from 0 at the record's begin to so many parts of its largest value at its end.
Spoil zero_drift(double fraction);
/// Shown so many seconds late, between samples by a straight line.
Spoil delay(double seconds);
/// First-order low-pass of so many Hz.
Spoil lag(double corner);
/// Stands still for so many seconds from a third of the record on; infinite: throughout.
Spoil stuck(double seconds);
/// Held within so many parts of its range, about the range's middle.
Spoil clipped(double fraction);
/// Samples missing at random.
Spoil missing(double fraction);
/// The same in bursts of so many samples.
Spoil missing_bursts(double fraction, Eigen::Index length);
/// Random samples that show anything within the range.
Spoil spikes(double fraction);
/// White noise of so many parts of the range, rms.
Spoil noise(double fraction);
/// A sine of so many parts of the range and Hz.
Spoil hum(double fraction, double frequency);
/// So many steps over the range.
Spoil quantised(double steps);

}  // namespace boresight::faults
