#include <fmt/format.h>

#include <boresight/app/report/sky_units.hpp>
#include <boresight/app/tune/laws_in_time.hpp>

namespace boresight::app {

std::string held_against(const TunedLaw& row) {
  if (!row.left_out() || !row.in_time) return "";
  const LawInTime& run = *row.in_time;
  if (!run.still) {
    return run.hunting > 0.0 ? fmt::format("hunts by +-{:.2f} mdeg", run.hunting / millidegree)
                             : "does not hold still";
  }
  return "does not hold in wind";
}

}  // namespace boresight::app
