#pragma once

#include <string>

#include <boresight/design/tuning/tuner.hpp>

namespace boresight::app {

/// Assumptions behind a constraint on the valve's demand in gusts, if no number of the valve is
/// stated (demand_assumption). Returned where that constraint is active or makes the problem
/// infeasible: a sentence with a leading blank. Else empty.
std::string assumed_demand(const design::TuningResult& tuning, const std::string& assumption);

}  // namespace boresight::app
