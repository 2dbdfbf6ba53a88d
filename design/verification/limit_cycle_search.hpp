#pragma once

#include <cstddef>
#include <span>

#include <boresight/design/verification/nonlinear_verification.hpp>

namespace boresight::design {

/// rad at the sky: half of peak to peak at the encoder that a limit cycle exceeds, half an encoder
/// step and at least 1e-3 mdeg.
double min_limit_cycle_amplitude(const SimulatedLoop& loop);

/// One run of the search for limit cycles at a rate (rad/s at the sky), without wind and noise,
/// from one of limit_cycle_starts initial steps, over options.limit_cycle_duration. @throws as
/// run_loop.
LimitCycleResult limit_cycle_run(const SimulatedLoop& loop,
                                 const NonlinearVerificationOptions& options, double rate,
                                 std::size_t start);

/// limit_cycle_run at rest on the reduced antenna of run_friction_loop. @throws as
/// run_friction_loop.
LimitCycleResult reduced_limit_cycle_run(const SimulatedLoop& loop,
                                         const NonlinearVerificationOptions& options,
                                         std::size_t start);

/// limit_cycle_run; if it shows a limit cycle, instead the run limit_cycle_confirmation times as
/// long. @throws as run_loop.
LimitCycleResult confirmed_limit_cycle_run(const SimulatedLoop& loop,
                                           const NonlinearVerificationOptions& options, double rate,
                                           std::size_t start);

/// The worst of the runs at one rate, one from each start. A limit cycle is confirmed by a run
/// limit_cycle_confirmation times as long, which replaces it in `runs`. @throws as run_loop.
LimitCycleResult confirmed_limit_cycle(const SimulatedLoop& loop,
                                       const NonlinearVerificationOptions& options, double rate,
                                       std::span<LimitCycleResult> runs);

}  // namespace boresight::design
