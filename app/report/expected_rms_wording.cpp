#include <fmt/format.h>

#include <boresight/app/report/expected_rms_wording.hpp>
#include <boresight/app/report/sky_units.hpp>

namespace boresight::app {

std::string interval_text(const design::SimulatedRms& expected, double linear) {
  return fmt::format("95 % {:.3f} to {:.3f} over {} winds; {:.3f} linear",
                     expected.rms.lower / millidegree, expected.rms.upper / millidegree,
                     expected.records, linear / millidegree);
}

}  // namespace boresight::app
