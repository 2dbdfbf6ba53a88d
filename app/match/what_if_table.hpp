#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <boresight/design/problem/pointing_budget.hpp>

namespace boresight::app {

/// What a plant makes of a law whose gains are held.
enum class HeldState : std::uint8_t { unstable, goals_missed, goals_met };

/// The study's robust laws, each held at the motor inertia it was tuned for, where leakage,
/// friction and wind are not those it was tuned for: what a board's "what if" is answered from.
struct WhatIfTable {
  std::vector<std::string> structures;
  std::vector<double> disks;            // on each motor, rising
  std::vector<double> leakage_rates;    // 1/s, rising
  std::vector<double> friction_slopes;  // N m s/rad at the motor shaft, rising
  std::vector<double> wind_speeds;      // m/s, mean, rising
  // Where the sliders start: the case's own.
  double leakage_rate = 0.0, friction_slope = 0.0, wind_speed = 0.0, disks_as_built = 0.0;
  double tracking_friction = 0.0;  // N m s/rad, slope of the friction curve at the tracking rate
  std::vector<design::PointingBand> bands;
  std::vector<design::PointingBudget> budgets;
  /// By structure, disks, leakage, friction and wind speed, the last fastest: rms of the beam at
  /// the sky (rad, one axis), NaN where unstable, and what becomes of stability and hard goals.
  std::vector<double> beam_rms;
  std::vector<HeldState> states;

  std::size_t place(std::size_t structure, std::size_t disk, std::size_t leakage,
                    std::size_t friction, std::size_t speed) const;
};

}  // namespace boresight::app
