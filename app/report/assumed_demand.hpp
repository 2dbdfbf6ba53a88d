#pragma once

#include <string>

#include <boresight/design/tuning/tuner.hpp>

namespace boresight::app {

/// Where a goal on the valve's demand in gusts limits a law, or stands in the way of any, what that
/// goal rests on if no number of the valve is stated (demand_assumption): a sentence with a blank
/// before it, else empty.
std::string assumed_demand(const design::TuningResult& tuning, const std::string& assumption);

}  // namespace boresight::app
