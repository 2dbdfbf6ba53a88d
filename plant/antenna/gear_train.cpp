#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include <boresight/numerics/error.hpp>
#include <boresight/plant/antenna/gear_train.hpp>

namespace boresight::plant {

double disk_inertia(double radius, double length, double density) {
  for (const double value : {radius, length, density}) {
    if (!(value > 0.0) || !std::isfinite(value)) {
      throw InvalidInput(fmt::format(
          "disk_inertia: expected positive finite radius, length and density, found {} m, {} m, "
          "{} kg/m3",
          radius, length, density));
    }
  }
  return 0.5 * density * std::numbers::pi * std::pow(radius, 4) * length;
}

double gear_ratio(const std::vector<GearStage>& stages, std::size_t stage_count) {
  if (stage_count > stages.size()) {
    throw InvalidInput(fmt::format("gear_ratio: expected at most {} stages, found {}",
                                   stages.size(), stage_count));
  }
  double ratio = 1.0;
  for (std::size_t i = 0; i < stage_count; ++i) {
    const auto& [driven, driving] = stages[i];
    if (!(driven > 0.0) || !(driving > 0.0)) {
      throw InvalidInput(
          fmt::format("gear_ratio: expected positive tooth counts in stage {}, found {}/{}", i + 1,
                      driven, driving));
    }
    ratio *= driven / driving;
  }
  return ratio;
}

double gear_ratio(const std::vector<GearStage>& stages) {
  return gear_ratio(stages, stages.size());
}

double reflected_inertia(double inertia, double ratio, double count) {
  return count * inertia / (ratio * ratio);
}

double motor_to_load_ratio(double motor_inertia, double reflected_inertia) {
  return motor_inertia / (reflected_inertia - motor_inertia);
}

double load_to_motor_ratio(double motor_inertia, double reflected_inertia) {
  return (reflected_inertia - motor_inertia) / motor_inertia;
}

}  // namespace boresight::plant
