#pragma once

#include <optional>
#include <vector>

#include <boresight/plant/integration/fast_integrator.hpp>
#include <boresight/plant/nonlinear/nonlinear_antenna.hpp>
#include <boresight/plant/nonlinear/simulation.hpp>

namespace boresight::plant {

/// The motor leaving standstill.
struct SlidingStart {
  double time = 0.0;  // s
  bool upward = true;
  double rate = 0.0;          // rad/s of motor, in that direction
  double friction = 0.0;      // N m, against it, gravity's offset taken off
  double motor_torque = 0.0;  // N m, what a recorder's pressures show: signed, offset included
  /// The rate is at most the curve's stribeck_rate: friction is still that of breaking away.
  bool shows_breakaway = true;
};

/// Something that held at some samples of a run.
struct SampledEvent {
  std::optional<double> first;  // s; none: never
  long long samples = 0;
  double fraction = 0.0;  // of all samples
};

/// Events in a run of the nonlinear antenna, detected at the samples of its true motion. Events
/// between two samples are missed, and an event has the time of its sample.
struct RunEvents {
  /// Times by which the motor, after at least 0.1 s of standstill (below 0.1 stribeck_rate, where
  /// the friction curve has lost 1 % of its bump), has turned from where it last stood by four
  /// times what the bristles bend at breakaway (its torque over their stiffness): they are then
  /// bent to within 4 % of what the curve has at the rate there. A motor that turns back before is
  /// none.
  std::vector<SlidingStart> sliding_starts;
  SampledEvent stroke_limit;   // the valve's port fully open
  SampledEvent slew_limit;     // the spool within 1 % of its largest speed over a sample
  SampledEvent command_limit;  // the command at or beyond the stroke
  SampledEvent contact_lost;   // one half of the gear train off its flank
  long long contact_losses = 0;
  SampledEvent below_makeup;  // some motor's port, line waves included
  SampledEvent below_zero;  // the same below no pressure: oil would cavitate, the model's does not
  std::optional<double> lowest_pressure;  // Pa at any motor's port; none without lines
  std::optional<double> highest_pressure;
  FastIntegratorStatistics integrator;
};

/// `commands`: the valve command at the samples (rad/s); `interval` s between them.
/// @throws InvalidInput for a run without the outputs of to_feedback_system(NonlinearAntenna).
RunEvents events_of(const NonlinearAntenna& antenna, const SimulationResult& run,
                    const Eigen::VectorXd& commands, double interval);

/// The first start of sliding in a direction that shows the breakaway; none if there is none.
std::optional<SlidingStart> first_start(const RunEvents& events, bool upward);

}  // namespace boresight::plant
