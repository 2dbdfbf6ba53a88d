#include <fmt/format.h>

#include <boresight/app/report/sky_units.hpp>
#include <boresight/app/tune/laws_in_time.hpp>

namespace boresight::app {

std::string held_against(const TunedLaw& row) {
  if (!row.left_out() || !row.in_time) return "";
  const LawInTime& run = *row.in_time;
  if (!run.still) {
    return run.hunting > 0.0
               ? fmt::format("limit-cycles by +-{:.2f} mdeg", run.hunting / millidegree)
               : "is not shown free of limit cycles";
  }
  return "does not complete the run in wind";
}

}  // namespace boresight::app
