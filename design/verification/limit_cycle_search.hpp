#pragma once

#include <cstddef>
#include <span>

#include <boresight/design/verification/nonlinear_verification.hpp>

namespace boresight::design {

/// One run of the search for limit cycles at a rate (rad/s at the sky), without wind and noise,
/// from one of hunting_starts initial steps, over options.hunting_duration. @throws as run_loop.
HuntingResult limit_cycle_run(const SimulatedLoop& loop,
                              const NonlinearVerificationOptions& options, double rate,
                              std::size_t start);

/// The worst of the runs at one rate, one from each start. A limit cycle is confirmed by a run
/// hunting_confirmation times as long, which replaces it in `runs`. @throws as run_loop.
HuntingResult confirmed_limit_cycle(const SimulatedLoop& loop,
                                    const NonlinearVerificationOptions& options, double rate,
                                    std::span<HuntingResult> runs);

}  // namespace boresight::design
