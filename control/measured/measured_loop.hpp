#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include <boresight/control/analysis/margins.hpp>

namespace boresight::control {

/// A loop gain as it was measured, with S = 1/(1 + L).
struct MeasuredLoop {
  Eigen::ArrayXd frequency;  // rad/s, positive, rising
  Eigen::ArrayXcd gain;      // L
  Eigen::ArrayXd coherence;  // 0 to 1 at each frequency; empty where it is not known
};

struct MeasuredLoopOptions {
  CrossoverOptions crossovers = {};
  /// Points of less coherence are left out.
  double lowest_coherence = 0.6;
  /// Between neighbouring points L may turn by this (degrees) and grow or shrink by this factor for
  /// the data to resolve it.
  double largest_turn_deg = 60.0;
  double largest_factor = 2.0;
  /// A step in ln w wider than this times the median of the ten steps around it is a gap.
  double widest_step = 4.0;
};

/// Two neighbouring points between which the data do not say what L does: nothing is looked for
/// there.
struct UnresolvedInterval {
  double lowest = 0.0;  // rad/s
  double highest = 0.0;
  double turn_deg = 0.0;  // from one to the other, the shorter way, in (-180, 180]
  double factor = 1.0;    // |L| at the higher over |L| at the lower frequency
  bool gap = false;       // points are missing
  /// L is on different sides of the unit circle, or of the negative real axis (the line between the
  /// points meets it), at the two ends: a crossover is hidden here at least.
  bool hides_gain_crossover = false;
  bool hides_phase_crossover = false;
};

struct MeasuredMargins {
  /// Of what the data resolve, from lowest_frequency to highest_frequency less the unresolved
  /// intervals.
  Margins margins;
  std::vector<UnresolvedInterval> unresolved;
  std::size_t points_used = 0;
  std::size_t points_left_out = 0;  // for their coherence, or because L = 0
  /// |L| where the data end. Above 1 at the highest frequency, or below 1 at the lowest in a loop
  /// that integrates, a gain crossover lies beyond the data.
  double gain_at_lowest = 0.0;
  double gain_at_highest = 0.0;
};

/// Margins of a measured loop gain. Between neighbouring points ln|L| and the angle of L follow
/// cubics in ln w with the slopes of the parabolas through each point and its neighbours;
/// crossovers, tangencies and peaks are those of that curve. Nothing is extrapolated, and nothing
/// is said of frequencies outside the data and of unresolved intervals: a margin there would not be
/// seen.
/// @throws InvalidInput for fewer than two usable points, arrays of different length, values that
/// are not finite, frequencies that are not positive or do not rise, a coherence outside 0 to 1, or
/// options out of range.
MeasuredMargins margins(const MeasuredLoop& loop, const MeasuredLoopOptions& options = {});

}  // namespace boresight::control
