#include <fmt/format.h>

#include <boresight/app/report/sky_units.hpp>
#include <boresight/app/tune/controllers_in_time.hpp>

namespace boresight::app {

std::string evaluated_against(const TunedController& row) {
  if (!row.left_out() || !row.in_time) return "";
  const ControllerInTime& run = *row.in_time;
  if (!run.limit_cycle_free) {
    return run.limit_cycles > 0.0
               ? fmt::format("limit-cycles by +-{:.2f} mdeg", run.limit_cycles / millidegree)
               : "is not shown free of limit cycles";
  }
  return "does not complete the run in wind";
}

}  // namespace boresight::app
