#include <cmath>

#include <fmt/format.h>

#include <boresight/app/report/climate_wording.hpp>

namespace boresight::app {

std::string climate_text(const std::vector<design::ClimatePart>& climate, double speed) {
  if (climate.empty()) return "";
  const double highest = design::highest_speed(climate);
  return speed > highest * (1.0 + 1e-9)
             ? fmt::format(", beyond the climate's highest speed of {:.4g} m/s", highest)
             : fmt::format(" ({} of the time)", percent_of_time(climate, speed));
}

std::string percent_of_time(const std::vector<design::ClimatePart>& climate, double speed) {
  if (climate.empty() || std::isnan(speed)) return "-";
  const double percent = 100.0 * design::fraction_of_time(climate, speed);
  // Neither all nor nothing that is not.
  if (percent > 99.5 && percent < 100.0) return "over 99 %";
  if (percent > 0.0 && percent < 0.5) return "under 1 %";
  return fmt::format("{:.0f} %", percent);
}

}  // namespace boresight::app
