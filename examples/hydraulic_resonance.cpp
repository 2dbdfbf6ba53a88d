// What inertia does a measured hydraulic resonance mean? The pressure wave in a line gives the bulk
// modulus, this and the volumes the oil spring, the spring and the resonance the inertia.
//   hydraulic_resonance [FREQUENCY in Hz]
#include <cstdio>
#include <cstdlib>

#include "elevation_axis.hpp"
#include <boresight/numerics/error.hpp>

int main(int argc, char** argv) try {
  namespace plant = boresight::plant;

  const double frequency = argc > 1 ? std::strtod(argv[1], nullptr) : 0.97;
  const double density = 850.0;  // kg/m3
  const double shortest = plant::bulk_modulus_from_slosh(13.11, 46.3, density);
  const double longest = plant::bulk_modulus_from_slosh(15.60, 38.3, density);
  std::printf("bulk modulus by the shortest line: %.1f MPa\n", 1e-6 * shortest);
  std::printf("bulk modulus by the longest line: %.1f MPa\n", 1e-6 * longest);

  auto drive = elevation_axis::hydraulic_drive();
  drive.bulk_modulus = 0.5 * (shortest + longest);
  const double motors = elevation_axis::motor_inertia;
  const double stiffness = plant::oil_stiffness(drive);
  const double inertia = plant::inertia_from_resonance(stiffness, frequency);
  const double ratio = plant::motor_to_load_ratio(motors, inertia);
  std::printf("oil stiffness: %.3f N.m/rad\n", stiffness);
  std::printf("reflected inertia at %.3f Hz: %.4f kg.m2\n", frequency, inertia);
  std::printf("motor-to-load ratio: %.3f\n", ratio);

  // The ratio is a difference of nearly equal numbers: see what a hundredth of the reading does.
  const double higher = plant::inertia_from_resonance(stiffness, 1.01 * frequency);
  std::printf("1 %% more frequency: inertia %+.1f %%, ratio %+.1f %%\n",
              100.0 * (higher / inertia - 1.0),
              100.0 * (plant::motor_to_load_ratio(motors, higher) / ratio - 1.0));

  const double load =
      elevation_axis::gear_train_inertia +
      plant::reflected_inertia(elevation_axis::dish_inertia, elevation_axis::gear_ratio());
  std::printf("resonance by the drawings' masses: %.4f Hz\n",
              plant::hydraulic_frequency(stiffness, motors + load));
  return 0;
} catch (const boresight::InvalidInput& error) {
  std::fprintf(stderr, "hydraulic_resonance: %s\n", error.what());
  return 2;
}
