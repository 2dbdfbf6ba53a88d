#pragma once

#include <string>

#include <boresight/design/verification/nonlinear_verification.hpp>

namespace boresight::app {

/// A limit cycle for a table, boresight amplitude in mdeg: "+-0.3500"; "+-0.3500 (2/5)" if only
/// some runs have one; "none"; or how an incomplete run ended.
std::string limit_cycle_cell(const design::LimitCycleResult& limit_cycles);

/// What such cells are, without a full stop.
std::string limit_cycle_legend();

}  // namespace boresight::app
