#include <fmt/format.h>

#include <boresight/app/redesign/antenna_model.hpp>
#include <boresight/app/redesign/resonating_mode.hpp>

namespace boresight::app {
namespace {

constexpr double half = 0.5;

}  // namespace

plant::PlantMode resonating_mode(const io::Case& antenna, const plant::AntennaPlant& plant) {
  const auto modes = plant::plant_modes(plant);
  return antenna.resonance_of_oil ? plant::mode_of_oil(modes) : plant::hydraulic_mode(modes);
}

bool rings_as_rigid(const io::Case& antenna) {
  const auto modes = plant::plant_modes(make_plant(antenna));
  const plant::PlantMode hydraulic = plant::hydraulic_mode(modes);
  const bool of_it =
      !antenna.resonance_of_oil || plant::mode_of_oil(modes).frequency == hydraulic.frequency;
  return of_it && hydraulic.oil_share >= half;
}

bool little_of_oil(const plant::PlantMode& mode, const plant::PlantMode& mode_of_oil) {
  if (mode.damping_ratio >= 1.0 || mode.oil_share < 0.0 || mode.gear_share < 0.0) return false;
  return mode.oil_share < half && mode_of_oil.oil_share > mode.oil_share;
}

std::string oil_remark(const plant::PlantMode& mode, const plant::PlantMode& mode_of_oil) {
  if (!little_of_oil(mode, mode_of_oil)) return "";
  return fmt::format(
      " Only {:.0f} % of that mode's elastic energy is in the oil, {:.0f} % in the gearbox spring "
      "and the rest in the structure, so that it tells little of the oil and its leakage; of the "
      "mode at {:.3g} Hz, damping ratio {:.3g}, {:.0f} % is in the oil.",
      100.0 * mode.oil_share, 100.0 * mode.gear_share, mode_of_oil.frequency,
      mode_of_oil.damping_ratio, 100.0 * mode_of_oil.oil_share);
}

}  // namespace boresight::app
