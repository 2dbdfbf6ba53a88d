#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <boresight/control/loops/state_space_controller_course.hpp>
#include <boresight/design/benchmark/rejection_benchmark.hpp>
#include <boresight/design/studies/time_domain_study.hpp>

namespace boresight::design {

/// What is benchmarked: a controller as control::antenna_state_space_controller takes it.
struct BenchmarkedController {
  plant::StateSpace system;
  std::string description;
  /// The controller of Boresight's structures that the system is the state space of, if it is one:
  /// what is not linear is run of such ones only.
  std::optional<control::ControlLaw> law;
};

/// The controller of a law: continuous, or in the sampled form that the antenna's computer runs
/// (sample_time above 0, s). @throws as control::sampled_law.
BenchmarkedController controller_of(const control::ControlLaw& law, const std::string& description,
                                    double sample_time);

/// Why there is no run on the nonlinear antenna.
enum class NoTimeDomain {
  none,      // there is one
  unstable,  // the linear loop is
  interrupted,
  state_space,  // a given one has no stated limits and anti-windup
  linear_only,  // no Antenna::nonlinear
};

/// The score of a controller by the protocol, and what it was scored on.
struct BenchmarkStudy {
  BenchmarkedController controller;
  bool present_gains = false;  // the controller is what the antenna runs on now
  double dead_time = 0.0;      // s, of a continuous controller; one sample time of a sampled one
  /// s, that the antenna's dead time speaks of (control::sample_time_of).
  double expected_sample_time = 0.0;
  double gear_ratio = 1.0;
  WindCondition wind;
  control::FrequencyBand rms_band;
  HardGoals goals;
  std::vector<PointingBudget> budgets;
  std::size_t attitudes = 0;  // of the mission's table of torque coefficients that were judged
  RejectionScore score;
  /// Of the beam after 1 N m, 1 N m s at the motor shaft (rad of motor): at most 120 s for plots.
  std::vector<control::CoursePoint> step_course, impulse_course;
  std::optional<TimeDomainStudy> nonlinear;
  /// m/s, one a budget: the score's budget_speeds by that simulation, limit cycle included; empty
  /// without one.
  std::vector<double> simulated_budget_speeds;
  NoTimeDomain no_nonlinear = NoTimeDomain::none;
  bool interrupted = false;

  /// A sampled controller samples otherwise than the antenna's dead time says.
  bool samples_otherwise() const;
};

struct BenchmarkOptions {
  std::uint64_t seed = 1;
  unsigned threads = 1;
  std::function<bool()> interrupted;
  /// Called between parts with those done and all.
  std::function<void(std::size_t, std::size_t)> progress;
};

/// Scores a controller on a mission's antenna and the members of its ensemble by the protocol.
/// @throws as rejection_benchmark and verify_in_time_domain.
BenchmarkStudy study_rejection(const Mission& mission, const std::vector<EnsembleMember>& members,
                               const BenchmarkedController& controller,
                               const BenchmarkOptions& options);

}  // namespace boresight::design
