#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <boresight/control/loops/state_space_controller_response.hpp>
#include <boresight/design/benchmark/rejection_benchmark.hpp>
#include <boresight/design/studies/time_domain_study.hpp>

namespace boresight::design {

/// The benchmarked controller, in the form that control::antenna_state_space_controller accepts.
struct BenchmarkedController {
  plant::StateSpace system;
  std::string description;
  /// The controller of Boresight's structures whose state space `system` is; none for any other
  /// system. Nonlinear simulations run only for these.
  std::optional<control::Controller> controller;
};

/// The state space of a controller: continuous, or, for sample_time above 0 (s), in the sampled
/// form that the antenna's computer runs. One that is a state space is sampled as it is.
/// @throws as control::sampled_controller.
BenchmarkedController controller_of(const control::Controller& controller,
                                    const std::string& description, double sample_time);

/// Reason why no simulation on the nonlinear antenna exists.
enum class NoTimeDomain {
  none,      // a simulation exists
  unstable,  // the linear loop is unstable
  interrupted,
  state_space,  // a given state space has no stated limits and no anti-windup
  linear_only,  // no Antenna::nonlinear
};

/// The score of a controller by the benchmark protocol, and the conditions of the score.
struct BenchmarkStudy {
  BenchmarkedController controller;
  bool present_gains = false;  // the controller is what the antenna runs on now
  double dead_time = 0.0;      // s; of a continuous controller, or one sample time of a sampled one
  /// s; the sample time that the antenna's dead time implies (control::sample_time_of).
  double expected_sample_time = 0.0;
  double gear_ratio = 1.0;
  WindCondition wind;
  control::FrequencyBand rms_band;
  Constraints goals;
  std::vector<PointingBudget> budgets;
  std::size_t attitudes = 0;  // evaluated, of the mission's table of torque coefficients
  RejectionScore score;
  /// Boresight response (rad of motor) to 1 N m and to 1 N m s at the motor shaft; at most 120 s,
  /// for plots.
  std::vector<control::ResponseSample> step_course, impulse_course;
  std::optional<TimeDomainStudy> nonlinear;
  /// m/s, one per budget: the score's budget_speeds by that simulation, limit cycle included. Empty
  /// without a simulation.
  std::vector<double> simulated_budget_speeds;
  NoTimeDomain no_nonlinear = NoTimeDomain::none;
  bool interrupted = false;

  /// True if the controller's sample time differs from the one that the antenna's dead time
  /// implies.
  bool samples_otherwise() const;
};

struct BenchmarkOptions {
  std::uint64_t seed = 1;
  unsigned threads = 1;
  std::function<bool()> interrupted;
  /// Called between parts with the numbers of parts done and in total.
  std::function<void(std::size_t, std::size_t)> progress;
};

/// Scores a controller on a mission's antenna and on the members of its ensemble by the protocol.
/// @throws as rejection_benchmark and verify_in_time_domain.
BenchmarkStudy study_rejection(const Mission& mission, const std::vector<EnsembleMember>& members,
                               const BenchmarkedController& controller,
                               const BenchmarkOptions& options);

}  // namespace boresight::design
