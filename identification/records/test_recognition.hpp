#pragma once

#include <vector>

#include <boresight/identification/records/drive_record.hpp>

namespace boresight::identification {

/// Largest motor rate (rad/s) that a command or, without one, the tachometer shows in any of the
/// records.
double fastest_motion(const std::vector<const DriveRecord*>& records);

/// The probable kind of a test, from its commands. With the rate command at rest and the valve
/// driven: a chirp if the valve crosses its median ever faster; steps if it moves mostly in jumps
/// and never comes to rest; slosh if it does or the record is shorter than 20 s. With a rate
/// command: constant speed if it stays near two values, else a ramp, slow if it stays below 15 % of
/// `fastest` (see fastest_motion). Without commands the tachometer is used instead, for constant
/// speed and ramps only. `other` if nothing fits.
TestKind recognised_test(const DriveRecord& record, double fastest);

}  // namespace boresight::identification
