#pragma once

#include <string>

#include <boresight/design/verification/simulated_rms.hpp>

namespace boresight::app {

/// "95 % 0.418 to 0.436 over 10 winds; 0.415 linear", mdeg: what stands in brackets behind
/// the expected rms. `linear`: the prediction (rad).
std::string interval_text(const design::SimulatedRms& expected, double linear);

}  // namespace boresight::app
