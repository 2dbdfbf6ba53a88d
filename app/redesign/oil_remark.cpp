#include <fmt/format.h>

#include <boresight/app/redesign/oil_remark.hpp>
#include <boresight/io/case/resonating_mode.hpp>

namespace boresight::app {

std::string oil_remark(const plant::PlantMode& mode, const plant::PlantMode& mode_of_oil) {
  if (!io::little_of_oil(mode, mode_of_oil)) return "";
  return fmt::format(
      " Only {:.0f} % of that mode's elastic energy is in the oil, {:.0f} % in the gearbox spring "
      "and the rest in the structure. The dominant hydraulic mode is at {:.3g} Hz, damping ratio "
      "{:.3g}, with {:.0f} % in the oil.",
      100.0 * mode.oil_fraction, 100.0 * mode.gear_fraction, mode_of_oil.frequency,
      mode_of_oil.damping_ratio, 100.0 * mode_of_oil.oil_fraction);
}

}  // namespace boresight::app
