#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <boresight/design/studies/matching_study.hpp>

namespace boresight::design {

/// Result of a fixed-gain controller on one plant.
enum class FixedGainState : std::uint8_t { unstable, constraints_missed, constraints_met };

/// The study's robust controllers, each evaluated with fixed gains at the motor inertia it was
/// tuned for, at other values of leakage, friction and wind. It answers "what if" questions.
struct WhatIfTable {
  std::vector<std::string> structures;
  std::vector<double> disks;            // on each motor, rising
  std::vector<double> leakage_rates;    // 1/s, rising
  std::vector<double> friction_slopes;  // N m s/rad at the motor shaft, rising
  std::vector<double> wind_speeds;      // m/s, mean, rising
  /// The mission's own values.
  double leakage_rate = 0.0, friction_slope = 0.0, wind_speed = 0.0, disks_as_built = 0.0;
  double tracking_friction = 0.0;  // N m s/rad, slope of the friction curve at the tracking rate
  std::vector<PointingBand> bands;
  std::vector<PointingBudget> budgets;
  /// Indexed by structure, disks, leakage, friction and wind speed, the last fastest.
  /// `boresight_rms`: boresight rms at the sky (rad, per axis), NaN where unstable. `states`:
  /// stability and constraints.
  std::vector<double> boresight_rms;
  std::vector<FixedGainState> states;

  std::size_t place(std::size_t structure, std::size_t disk, std::size_t leakage,
                    std::size_t friction, std::size_t speed) const;
};

struct WhatIfOptions {
  unsigned threads = 1;
  /// Receives the numbers of controllers done and in total, under a lock.
  std::function<void(std::size_t done, std::size_t all)> progress = {};
  /// Polled between controllers; true leaves the rest NaN and unstable.
  std::function<bool()> interrupted = {};
};

/// Computes the table of a study at its evenly spaced numbers of disks and as built. Leakage: 0.3
/// to 1.3 of the mission's. Friction slopes: 0 to 1.5 of that at the tracking rate. Winds: half to
/// twice the design's. Constraints are evaluated in the winds of the table, otherwise on the
/// mission's plant alone. Takes some 0.2 ms of one core per entry. The result does not depend on
/// the number of threads.
/// @throws as MonteCarloEvaluator.
WhatIfTable what_if(const Mission& mission, const MatchingStudy& study,
                    const WhatIfOptions& options);

}  // namespace boresight::design
