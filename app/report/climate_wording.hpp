#pragma once

#include <string>
#include <vector>

#include <boresight/design/problem/wind_climate.hpp>

namespace boresight::app {

/// How much of the climate's time winds up to a speed (m/s) take, to stand behind it:
/// " (84 % of the time)"; ", beyond the climate's highest speed of 15 m/s" where that is all of it
/// and more; empty without a climate.
std::string climate_text(const std::vector<design::ClimatePart>& climate, double speed);

/// The same for tables: "84 %"; "-" without a climate, or of a speed that is not a number.
std::string percent_of_time(const std::vector<design::ClimatePart>& climate, double speed);

}  // namespace boresight::app
