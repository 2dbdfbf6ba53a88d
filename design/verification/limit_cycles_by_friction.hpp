#pragma once

#include <span>
#include <string_view>
#include <vector>

#include <boresight/design/verification/nonlinear_verification.hpp>

namespace boresight::design {

/// Friction that differs from what the model states, as it changes with oil temperature, load and
/// wear.
struct FrictionVariation {
  std::string_view name;  // what differs
  plant::MotorFriction friction;
};

/// Four variations: all friction torques x 0.7; x 1.3; breakaway torque x 1.3 with half the
/// Stribeck rate, the steepest fall; twice the Stribeck rate with bristle stiffness x 0.3, the
/// softest. None without dry friction.
std::vector<FrictionVariation> friction_variations(const plant::MotorFriction& stated);

/// Runs with one friction at one rate, without wind and noise, from each of limit_cycle_starts.
struct LimitCyclesWithFriction {
  std::string_view friction;  // FrictionVariation::name
  double rate = 0.0;          // rad/s at the sky
  int starts = 0;
  int limit_cycles = 0;            // runs that end in a limit cycle or do not complete
  double encoder_amplitude = 0.0;  // rad at the sky, the largest; NaN if a run did not complete
};

/// Searches for limit cycles (confirmed_limit_cycle_run) with each friction, at rest and then at
/// the options' tracking rate if that is not 0. The loop's feedforward keeps the friction of
/// `loop`. Each friction takes 6 runs, some 0.8 s of computing on the 70-m antenna; those with a
/// limit cycle take four times as long. They run over options.threads, on which the result does not
/// depend. @throws as run_loop.
std::vector<LimitCyclesWithFriction> limit_cycles_by_friction(
    const SimulatedLoop& loop, std::span<const FrictionVariation> frictions,
    const NonlinearVerificationOptions& options);

}  // namespace boresight::design
