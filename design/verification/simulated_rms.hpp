#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include <Eigen/Core>

#include <boresight/design/problem/tracking_problem.hpp>
#include <boresight/design/verification/shared_winds.hpp>
#include <boresight/design/verification/simulated_loop.hpp>
#include <boresight/numerics/statistics/interval.hpp>

namespace boresight::design {

/// Runs from which an expected rms is estimated.
struct SimulatedRmsOptions {
  int records = 10;            // of wind, each run on the nonlinear antenna; at least 4
  int winds = 200;             // those and further ones, by the linear loop's response
  double settling = 60.0;      // s at the start, excluded from the errors
  double duration = 300.0;     // s of a record after that
  double tracking_rate = 0.0;  // rad/s at the sky
  std::uint64_t seed = 1;      // of the first record; the others follow
  /// Mean squares (rad2) of the first records, where they were run already.
  Eigen::VectorXd known = {};
  unsigned threads = 1;
  /// Where those of other controllers in the same wind are; prepared anew if null.
  std::shared_ptr<SharedWinds> shared = nullptr;
};

/// The expected boresight rms (rad at the sky, about each record's mean): root of the expected mean
/// square over records of wind of that length.
struct SimulatedRms {
  RunStatus status = RunStatus::complete;  // the worst of the runs
  int records = 0;
  int winds = 0;
  std::uint64_t seed = 1;  // of the first record
  /// With its 95 % interval; NaN unless complete. The half-width is at least
  /// integrator_agreement_limit times the rms, the allowed integration error.
  numerics::Interval rms;
  Eigen::VectorXd mean_squares;         // rad2, one per record, of the nonlinear runs
  Eigen::VectorXd linear_mean_squares;  // rad2, one per wind, records first, of the linear loop
};

/// Estimates the rms by numerics::mean_by_double_sampling of the records' mean squares. The
/// nonlinear runs are corrected for the deviation of their winds from a larger set of winds. For
/// each of these winds the linear loop's mean square follows from its periodogram, without a run;
/// loops in the same wind share the periodograms. The result does not depend on the number of
/// threads.
/// @throws InvalidInput for fewer than 4 records, fewer winds than those, and more known records;
/// as run_loop.
SimulatedRms simulated_rms(const TrackingProblem& problem, const SimulatedLoop& loop,
                           const SimulatedRmsOptions& options);

/// The simulated rms of a loop, and the amplitude (rad at the sky) of its limit cycle.
struct SimulatedFigure {
  const SimulatedRms& expected;
  double amplitude = 0.0;
};

/// Relative change of sqrt(rms^2 + limit_cycle_rms(amplitude)^2) from one loop to another, with its
/// 95 % interval, over the records that both ran. The interval is by mean_by_double_sampling of the
/// differences of the records' mean squares, which is narrower than from two separate intervals. It
/// is never narrower than the integration error allows. None for runs that did not complete or were
/// in different winds.
std::optional<numerics::Interval> relative_change(const SimulatedFigure& from,
                                                  const SimulatedFigure& to);

/// Largest relative difference of two such figures that the randomness of the wind explains, if the
/// effect is applied to values that were not simulated. It is half the width of that interval; 0
/// without one.
double left_open(const SimulatedFigure& one, const SimulatedFigure& other);

}  // namespace boresight::design
