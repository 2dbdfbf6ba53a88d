#pragma once

#include <vector>

#include <boresight/identification/records/drive_record.hpp>
#include <boresight/identification/records/integrated_motion.hpp>

namespace boresight::identification {

/// A window over which the speed changes.
struct ImpulseWindow {
  std::size_t record = 0;  // of the campaign
  MotionWindow window;
  int direction = 0;          // +1, -1: of motion
  bool accelerating = false;  // away from rest
  double from_rate = 0.0;     // rad/s, smoothed, at the window's ends
  double to_rate = 0.0;
};

/// Sommerville's two windows on a fast ramp (section IV.A). The first extends from where the rate
/// initially becomes positive to where the tachometer reaches its plateau. Positive means 2 % of
/// the plateau, which excludes slow creep before the ramp. The second starts where the tachometer
/// leaves the plateau and has as many samples. If the tachometer never reaches its limit, the
/// largest rate of the first half period replaces the plateau. Empty without upward motion.
std::vector<ImpulseWindow> ramp_windows(const Campaign& campaign, std::size_t record);

struct ImpulseWindowOptions {
  double guard_time = 0.1;  // s about clipped or missing samples
  /// Smallest change of speed of a window, as a fraction of the largest of all tests.
  double smallest_change = 0.25;
  /// Rates below this fraction of the largest are left out at both ends. About a velocity reversal,
  /// friction follows the contacts' springs and stops, not the steady curve.
  double lowest_rate = 0.02;
};

/// Windows of fast-ramp, constant-speed, valve-step and valve-chirp tests over which the speed
/// rises or falls by a large amount. They lie between turning points of the rate, smoothed over
/// half a period of the lowest structural mode, without change of direction and outside guard bands
/// about clipped samples. They are at least a period of that mode long, with flanks of a period, or
/// of half the window.
std::vector<ImpulseWindow> impulse_windows(const Campaign& campaign,
                                           const ImpulseWindowOptions& options = {});

/// Windows of one direction, with the common range of their speeds as their rates. They come from
/// the fast ramps if these accelerate and decelerate, else from all tests. Only windows over at
/// least half of the largest change of speed are used, long enough to be integrated over speed
/// (shortest_speed_window). `cut_low` and `cut_high`: fractions of the common speeds left out at
/// either end. Empty if none accelerates or none decelerates.
std::vector<ImpulseWindow> common_path(const Campaign& campaign,
                                       const std::vector<ImpulseWindow>& windows, int direction,
                                       double cut_low = 0.0, double cut_high = 0.0);

/// Time (s) over which rate and torque are smoothed to integrate over speed: half a period of the
/// lowest structural mode.
double speed_smoothing_time(const DriveKnowledge& knowledge);

/// Period of the lowest structural mode, s; 0.5 s where none is known.
double structure_period(const DriveKnowledge& knowledge);

}  // namespace boresight::identification
