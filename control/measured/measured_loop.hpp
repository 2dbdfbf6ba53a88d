#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include <boresight/control/analysis/margins.hpp>

namespace boresight::control {

/// A measured loop gain, with S = 1/(1 + L).
struct MeasuredLoop {
  Eigen::ArrayXd frequency;  // rad/s, positive, rising
  Eigen::ArrayXcd gain;      // L
  Eigen::ArrayXd coherence;  // 0 to 1 at each frequency; empty where it is not known
};

struct MeasuredLoopOptions {
  CrossoverOptions crossovers = {};
  /// Points with a lower coherence are omitted.
  double lowest_coherence = 0.6;
  /// Largest phase change (degrees) and largest factor of magnitude of L between neighbouring
  /// points at which the data resolve it.
  double largest_turn_deg = 60.0;
  double largest_factor = 2.0;
  /// A step in ln w wider than this times the median of the ten steps around it counts as a gap.
  double widest_step = 4.0;
};

/// Interval between neighbouring points that do not resolve L. It is not searched.
struct UnresolvedInterval {
  double lowest = 0.0;  // rad/s
  double highest = 0.0;
  double turn_deg = 0.0;  // phase change over it, the shorter way, in (-180, 180]
  double factor = 1.0;    // |L| at the higher over |L| at the lower frequency
  bool gap = false;       // points are missing
  /// The ends lie on different sides of the unit circle, or of the negative real axis (the line
  /// between the points meets it). The interval therefore contains at least one crossover.
  bool hides_gain_crossover = false;
  bool hides_phase_crossover = false;
};

struct MeasuredMargins {
  /// Margins over the resolved data, from lowest_frequency to highest_frequency without the
  /// unresolved intervals.
  Margins margins;
  std::vector<UnresolvedInterval> unresolved;
  std::size_t points_used = 0;
  std::size_t points_left_out = 0;  // for low coherence, or because L = 0
  /// L| at the ends of the data. If it is above 1 at the highest frequency, or below 1 at the
  /// lowest in a loop with integral action, a gain crossover lies beyond the data.
  double gain_at_lowest = 0.0;
  double gain_at_highest = 0.0;
};

/// Margins of a measured loop gain. Between neighbouring points ln|L| and the angle of L are cubics
/// in ln w, with the slopes of the parabolas through each point and its neighbours. Crossovers,
/// tangencies and peaks are those of that curve. Nothing is extrapolated: margins outside the data
/// and in unresolved intervals are not found.
/// @throws InvalidInput for fewer than two usable points, arrays of different length, values that
/// are not finite, frequencies that are not positive or do not rise, a coherence outside 0 to 1, or
/// options out of range.
MeasuredMargins margins(const MeasuredLoop& loop, const MeasuredLoopOptions& options = {});

}  // namespace boresight::control
