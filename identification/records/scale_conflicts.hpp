#pragma once

#include <cstddef>
#include <vector>

#include <boresight/identification/records/drive_record.hpp>

namespace boresight::identification {

/// A channel of one record on another scale than in the other records.
struct ScaleConflict {
  enum class Channel { tachometer, rate_command, valve_command };
  std::size_t record = 0;  // its place in the list
  Channel channel = Channel::tachometer;
  /// How many times larger the channel is than the other records have it.
  double factor = 1.0;
};

/// Compares how much motor rate a command makes, g = sum(u w)/sum(u u) over the valid samples, with
/// the median of the other records: the drive is one, so that g differs by losses alone. Where g is
/// off by a factor of 3 or more for every command that a record has, its tachometer is on another
/// scale; where it is for one of two commands, that command is. Leakage under friction's load takes
/// valve command without rate: in a record below a tenth of the fastest record's rms rate a valve
/// command that is too large is off from a factor of 8 on, unless the rate command is off too. A
/// record counts where it moves and has a command that moves; slosh tests do not, nor does a
/// command that fewer than three records have. Places of missing records (null) stay.
std::vector<ScaleConflict> scale_conflicts(const std::vector<const DriveRecord*>& records);

}  // namespace boresight::identification
