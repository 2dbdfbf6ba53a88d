// What inertia do the motors drive, and how well is it known? From drawings: the masses of motors,
// gear train and dish, each with an uncertainty, through the gear ratio to the motor shaft.
#include <cstdio>
#include <span>
#include <vector>

#include "elevation_axis.hpp"
#include <boresight/numerics/statistics/propagation.hpp>

int main() {
  namespace numerics = boresight::numerics;
  namespace plant = boresight::plant;

  const double ratio = elevation_axis::gear_ratio();
  // Value and standard uncertainty, kg m2.
  const std::vector<numerics::UncertainInput> masses{
      {"motors and flywheels", elevation_axis::motor_inertia, 0.01 * elevation_axis::motor_inertia},
      {"gear train", elevation_axis::gear_train_inertia, 0.05 * elevation_axis::gear_train_inertia},
      {"dish", elevation_axis::dish_inertia, 0.10 * elevation_axis::dish_inertia}};

  const auto total = [ratio](std::span<const double> mass) {
    return mass[0] + mass[1] + plant::reflected_inertia(mass[2], ratio);
  };
  // The motor-to-load ratio has a pole where nothing is left for the load: its inverse has not.
  const auto load_to_motor = [total](std::span<const double> mass) {
    return plant::load_to_motor_ratio(mass[0], total(mass));
  };
  const auto results = numerics::propagate(
      masses, {{.name = "reflected inertia kg.m2", .evaluate = total},
               {.name = "motor-to-load ratio", .evaluate = load_to_motor, .reciprocal = true}});

  std::printf("gear ratio: %.1f\n", ratio);
  for (const auto& result : results) {
    std::printf("%s: %.4f, 95 %% interval %.3f .. %.3f\n", result.name.c_str(), result.value,
                result.lower, result.upper);
    for (const auto& input : result.contributions) {
      std::printf("  %2.0f %% of its variance from: %s\n", 100.0 * input.fraction,
                  input.input.c_str());
    }
  }
}
