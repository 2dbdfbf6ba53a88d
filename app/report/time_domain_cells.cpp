#include <fmt/format.h>

#include <boresight/app/report/limit_cycle_wording.hpp>
#include <boresight/app/report/time_domain_cells.hpp>

namespace boresight::app {

std::string limit_cycle_cell(const design::NonlinearVerification& run, bool at_rest) {
  for (const auto& limit_cycles : run.limit_cycles) {
    if ((limit_cycles.rate == 0.0) == at_rest) return limit_cycle_cell(limit_cycles);
  }
  return "-";
}

std::string settling_cell(const std::optional<design::SlewResult>& slew, double watched) {
  if (!slew) return "-";
  if (!slew->settling_time) return fmt::format("> {:g}", watched);
  return *slew->settling_time > 0.0 ? fmt::format("{:.2f}", *slew->settling_time) : "at once";
}

}  // namespace boresight::app
