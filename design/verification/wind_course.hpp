#pragma once

#include <cstdint>
#include <optional>

#include <boresight/design/problem/tracking_problem.hpp>
#include <boresight/design/verification/simulated_loop.hpp>
#include <boresight/plant/wind/stationary_series.hpp>

namespace boresight::design {

/// Reference trajectory at a constant rate (rad/s of motor) from 0, with the given wind torque at
/// the motor shaft (N m), one sample per interval (s).
ReferenceTrajectory steady_course(double interval, double rate, Eigen::VectorXd wind_torque);

/// Reference trajectories at a constant rate (rad/s of motor) from 0 in records of the problem's
/// wind for a duration (s), in steps of the loop's sample time. Prepared once for any number of
/// records.
class WindCourses {
 public:
  /// @throws InvalidInput as plant::wind_torque_series.
  WindCourses(const TrackingProblem& problem, const SimulatedLoop& loop, double rate,
              double duration);

  Eigen::Index samples() const { return samples_; }
  /// Wind torque of a seed's record about its mean, at the motor shaft (N m).
  Eigen::VectorXd gusts(std::uint64_t seed) const;
  /// That record with the mean torque, and the reference.
  ReferenceTrajectory course(std::uint64_t seed) const;

 private:
  double interval_, rate_, gear_ratio_, mean_torque_;
  Eigen::Index samples_;
  plant::StationarySeries uniform_;
  std::optional<plant::StationarySeries> gradient_;  // none in models without one
};

}  // namespace boresight::design
