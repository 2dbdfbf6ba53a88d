// The linear plant: its modes, and the Bode data of tachometer and beam by the valve command, as
// CSV for any plotting program, from 0.01 to 20 Hz.
//   plant_bode [FILE.csv]
#include <cmath>
#include <cstdio>
#include <fstream>

#include "elevation_axis.hpp"
#include <boresight/plant/antenna/plant_response.hpp>

namespace {

double decibel(std::complex<double> value) {
  return 20.0 * std::log10(std::abs(value));
}

double degrees(std::complex<double> value) {
  return std::arg(value) * 180.0 / std::numbers::pi;
}

bool write_bode(const char* path, const boresight::plant::PlantResponse& bode) {
  std::ofstream file(path);
  file.precision(9);
  file << "frequency_hz,tachometer_db,tachometer_deg,boresight_db,boresight_deg\n";
  for (Eigen::Index i = 0; i < bode.frequency.size(); ++i) {
    const auto tachometer = bode.tachometer_command(i), boresight = bode.boresight_command(i);
    file << bode.frequency(i) / elevation_axis::two_pi << ',' << decibel(tachometer) << ','
         << degrees(tachometer) << ',' << decibel(boresight) << ',' << degrees(boresight) << '\n';
  }
  return file.flush().good();
}

}  // namespace

int main(int argc, char** argv) {
  namespace plant = boresight::plant;

  const auto antenna = elevation_axis::plant();
  std::printf("reflected inertia: %.4f kg.m2\n", plant::reflected_inertia(antenna));
  for (const auto& mode : plant::plant_modes(antenna)) {
    std::printf("%8.4f Hz  damping %.4f  pole %9.4f %+9.4fi  %s\n", mode.frequency,
                mode.damping_ratio, mode.pole.real(), mode.pole.imag(), mode.description.c_str());
  }

  // 100 points a decade, and more around each lightly damped pole.
  const auto frequency = plant::frequency_grid(antenna, 0.01, 20.0, 100);
  const auto bode = plant::plant_response(antenna, frequency);
  Eigen::Index highest = 0;
  const double peak = bode.tachometer_command.abs().maxCoeff(&highest);
  std::printf("tachometer by valve command: largest %.2f dB at %.3f Hz\n", 20.0 * std::log10(peak),
              frequency(highest) / elevation_axis::two_pi);
  if (argc > 1 && !write_bode(argv[1], bode)) {
    std::fprintf(stderr, "plant_bode: cannot write %s\n", argv[1]);
    return 2;
  }
}
