#pragma once

#include <cstdint>
#include <optional>

#include <Eigen/Core>

#include <boresight/design/problem/tracking_problem.hpp>
#include <boresight/design/verification/simulated_loop.hpp>
#include <boresight/numerics/statistics/interval.hpp>

namespace boresight::design {

/// Runs that an expected rms is estimated from.
struct SimulatedRmsOptions {
  int records = 10;            // of wind, each run on the nonlinear antenna; at least 4
  int winds = 200;             // those and further ones, through the linear loop's response
  double settling = 60.0;      // s before an error counts
  double duration = 300.0;     // s after that, of a record
  double tracking_rate = 0.0;  // rad/s at the sky
  std::uint64_t seed = 1;      // of the first record; the others follow
  unsigned threads = 1;
};

/// The boresight rms (rad at the sky, about each record's mean) that records of wind of that length
/// have on the average of their mean squares.
struct SimulatedRms {
  RunStatus status = RunStatus::complete;  // the worst of the runs
  int records = 0;
  int winds = 0;
  std::uint64_t seed = 1;  // of the first record
  /// With its 95 % interval, never narrower than integrator_agreement_limit of the rms to either
  /// side, which is what a run's integration may err by; NaN unless complete.
  numerics::Interval rms;
  Eigen::VectorXd mean_squares;         // rad2, one a record, of the nonlinear runs
  Eigen::VectorXd linear_mean_squares;  // rad2, one a wind, the records' first, of the linear loop
};

/// By numerics::mean_by_double_sampling of the records' mean squares: those of the nonlinear runs
/// are corrected by how far their winds lie from more winds, of which each has the mean square that
/// the linear loop makes of its periodogram (a transform a wind, no run).
/// The same for any number of threads.
/// @throws InvalidInput for fewer than 4 records or fewer winds than those; as run_loop.
SimulatedRms simulated_rms(const TrackingProblem& problem, const SimulatedLoop& loop,
                           const SimulatedRmsOptions& options);

/// The simulated rms of a loop, and the amplitude (rad at the sky) of its limit cycle.
struct SimulatedFigure {
  const SimulatedRms& expected;
  double amplitude = 0.0;
};

/// Relative change of sqrt(rms^2 + limit_cycle_rms(amplitude)^2) from one loop to another, with its
/// 95 % interval. Both met the same winds: by mean_by_double_sampling of the differences of the
/// records' mean squares, which is narrower than two intervals apart, and as theirs never narrower
/// than the integration. None for runs that did not complete or are not of the same records.
std::optional<numerics::Interval> relative_change(const SimulatedFigure& from,
                                                  const SimulatedFigure& to);

/// How far (relative) two such figures may be apart by chance of the wind, where what they are
/// taken to was not simulated itself: half the width of that interval; 0 without one.
double left_open(const SimulatedFigure& one, const SimulatedFigure& other);

}  // namespace boresight::design
