#include <boresight/io/case/antenna_of.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_tests.hpp>
#include <boresight/io/case/resonating_mode.hpp>

namespace boresight::io {
namespace {

constexpr double half = 0.5;

}  // namespace

plant::PlantMode resonating_mode(const Case& antenna, const plant::AntennaPlant& plant) {
  const auto modes = plant::plant_modes(plant);
  return antenna.resonance->of_oil ? plant::mode_of_oil(modes) : plant::hydraulic_mode(modes);
}

bool rings_as_rigid(const Case& antenna) {
  const auto modes = plant::plant_modes(make_plant(antenna));
  const plant::PlantMode hydraulic = plant::hydraulic_mode(modes);
  const bool of_it =
      !antenna.resonance->of_oil || plant::mode_of_oil(modes).frequency == hydraulic.frequency;
  return of_it && hydraulic.oil_fraction >= half;
}

bool little_of_oil(const plant::PlantMode& mode, const plant::PlantMode& mode_of_oil) {
  if (mode.damping_ratio >= 1.0 || mode.oil_fraction < 0.0 || mode.gear_fraction < 0.0)
    return false;
  return mode.oil_fraction < half && mode_of_oil.oil_fraction > mode.oil_fraction;
}

}  // namespace boresight::io
