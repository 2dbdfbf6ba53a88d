#pragma once

#include <string_view>
#include <vector>

#include <boresight/design/verification/nonlinear_verification.hpp>

namespace boresight::design {

/// Friction that the antenna may have instead of what the model states: it changes with the oil's
/// temperature, with load and with wear.
struct FrictionSet {
  std::string_view name;
  plant::MotorFriction friction;
};

/// As stated; all torques of the curve x 0.7 and x 1.3; breakaway x 1.3 with half the Stribeck
/// rate, the steepest fall; twice the Stribeck rate with bristles x 0.3, the softest. Without dry
/// friction only the first.
std::vector<FrictionSet> friction_sets(const plant::MotorFriction& stated);

/// The runs of one set at one rate, without wind and noise, from each of limit_cycle_starts.
struct LimitCyclesWithFriction {
  std::string_view friction;
  double rate = 0.0;  // rad/s at the sky
  int starts = 0;
  int limit_cycles = 0;            // runs that end in one, or that did not complete
  double encoder_amplitude = 0.0;  // rad at the sky, the largest; NaN if a run did not complete
};

/// The search for limit cycles (limit_cycle_run, not confirmed) over all friction sets, at rest and
/// at the options' tracking rate if it is not 0. Of each set first at rest. 30 runs, some 4 s of
/// computing on the 70-m antenna, over options.threads; the result does not depend on them.
/// @throws as run_loop.
std::vector<LimitCyclesWithFriction> limit_cycles_by_friction(
    const SimulatedLoop& loop, const NonlinearVerificationOptions& options);

}  // namespace boresight::design
