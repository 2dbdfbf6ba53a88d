#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <boresight/design/studies/matching_study.hpp>

namespace boresight::design {

/// What a plant makes of a law whose gains are held.
enum class HeldState : std::uint8_t { unstable, goals_missed, goals_met };

/// The study's robust laws, each held at the motor inertia it was tuned for, where leakage,
/// friction and wind are not those it was tuned for: what a "what if" is answered from.
struct WhatIfTable {
  std::vector<std::string> structures;
  std::vector<double> disks;            // on each motor, rising
  std::vector<double> leakage_rates;    // 1/s, rising
  std::vector<double> friction_slopes;  // N m s/rad at the motor shaft, rising
  std::vector<double> wind_speeds;      // m/s, mean, rising
  /// The mission's own.
  double leakage_rate = 0.0, friction_slope = 0.0, wind_speed = 0.0, disks_as_built = 0.0;
  double tracking_friction = 0.0;  // N m s/rad, slope of the friction curve at the tracking rate
  std::vector<PointingBand> bands;
  std::vector<PointingBudget> budgets;
  /// By structure, disks, leakage, friction and wind speed, the last fastest: rms of the beam at
  /// the sky (rad, one axis), NaN where unstable, and what becomes of stability and hard goals.
  std::vector<double> beam_rms;
  std::vector<HeldState> states;

  std::size_t place(std::size_t structure, std::size_t disk, std::size_t leakage,
                    std::size_t friction, std::size_t speed) const;
};

struct WhatIfOptions {
  unsigned threads = 1;
  /// Laws done and all, under a lock.
  std::function<void(std::size_t done, std::size_t all)> progress = {};
  /// Asked between laws; true leaves the rest NaN and unstable.
  std::function<bool()> interrupted = {};
};

/// The table of a study: at its evenly spaced numbers of disks and as built; leakage from 0.3 to
/// 1.3 of the mission's, friction slopes from 0 to 1.5 of that at the tracking rate, winds from
/// half to twice the design's. Goals in the winds of the table; on the mission's plant alone
/// otherwise. Some 0.2 ms of one core an entry. The same for any number of threads.
/// @throws as MonteCarloJudge.
WhatIfTable what_if(const Mission& mission, const MatchingStudy& study,
                    const WhatIfOptions& options);

}  // namespace boresight::design
