#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <boresight/control/controllers/controller.hpp>
#include <boresight/design/ensembles/plant_ensemble.hpp>
#include <boresight/design/problem/tracking_problem.hpp>

namespace boresight::design {

/// A curve on the nominal plant and its range over the nominal plant and the stable members, point
/// by point: lower <= nominal <= upper.
struct EnsembleBand {
  Eigen::ArrayXd nominal, lower, upper;
};

/// Response of a loop to a unit step of its command: continuous, without command preprocessor and
/// feedforward.
struct StepOverEnsemble {
  Eigen::ArrayXd time;  // s, from 0
  EnsembleBand response;

  /// Fraction of the step by which the response exceeds it: on the nominal plant, and the largest
  /// over the nominal plant and the stable members. 0 where it does not, and without a response.
  double overshoot() const;
  double largest_overshoot() const;
};

/// One controller, gains fixed, on every member of an ensemble, as curves.
struct EnsembleCurves {
  std::size_t members = 0;
  std::size_t stable = 0;    // of these; unstable members are excluded from the ranges
  Eigen::ArrayXd frequency;  // rad/s, rising
  /// |S| at the breaks of control::loop_breaks, in their order.
  std::array<EnsembleBand, 3> sensitivity;
  /// The stable member with the highest Ms at each break, and that Ms over all frequencies. No name
  /// without a stable member.
  struct Worst {
    std::string member;
    double peak = 0.0;
    Eigen::ArrayXd sensitivity;
  };
  std::array<Worst, 3> worst;
  Eigen::ArrayXd wind_speed;   // m/s, mean, rising
  EnsembleBand boresight_rms;  // rad at the sky, per axis
  /// Tachometer per rate command, position loop open; empty for a state space.
  StepOverEnsemble rate_step;
  StepOverEnsemble position_step;  // encoder per position command
};

/// The highest mean wind speed (m/s) at which an rms is compared with budgets that are met up to
/// `speed_limits`. It is 1.5 times the mean speed, or 8 % beyond a limit up to 3 times the mean
/// speed.
double highest_compared_speed(double mean_speed, const std::vector<double>& speed_limits);

/// Computes the curves. Sensitivities run from 0.01 Hz (or the lowest frequency of the rms band) to
/// the end of the analysis band, 150 points per decade. The rms is by spectrum at 60 speeds up to
/// `highest_speed`, noise included. Steps have 300 times, until the nominal loop has settled within
/// 2 % and half as long again. `evaluated`: result of the same controller on the same members
/// (evaluate). The result does not depend on the number of threads. O(members (grid + states^3)).
/// @throws InvalidInput where sizes of `members` and `evaluated` differ, for a highest speed that
/// is not positive, and as control::validate.
EnsembleCurves ensemble_curves(const TrackingProblem& problem,
                               const std::vector<EnsembleMember>& members,
                               const control::Controller& controller,
                               const EnsembleResult& evaluated, double highest_speed,
                               unsigned threads);

}  // namespace boresight::design
