// Uses the installed headers and libraries for a drive whose answers are known in closed form.
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>

#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/antenna/gear_train.hpp>
#include <boresight/plant/antenna/hydraulics.hpp>

namespace {

int failures = 0;

void expect(const char* what, double found, double expected) {
  const double rounding = 8.0 * std::numeric_limits<double>::epsilon() * std::abs(expected);
  if (!(std::abs(found - expected) <= rounding)) {
    std::printf("%s: expected %.17g, found %.17g\n", what, expected, found);
    ++failures;
  }
}

}  // namespace

int main(int count, char** arguments) {
  namespace plant = boresight::plant;

  expect("disk inertia", plant::disk_inertia(2.0, 3.0, 5.0), 120.0 * std::numbers::pi);
  expect("gear ratio", plant::gear_ratio({{60.0, 20.0}, {100.0, 25.0}}), 12.0);

  // K = beta D^2 (1/V1 + 1/V2) with D = 2 x 3 m3/rad, then 1 Hz for J = K/(2 pi)^2.
  const plant::HydraulicDrive drive{.motor_count = 2.0,
                                    .displacement = 3.0,
                                    .bulk_modulus = 7.0,
                                    .volume_1 = 4.0,
                                    .volume_2 = 4.0};
  const double stiffness = plant::oil_stiffness(drive);
  expect("oil stiffness", stiffness, 126.0);
  expect("hydraulic frequency",
         plant::hydraulic_frequency(stiffness, 126.0 / (4.0 * std::numbers::pi * std::numbers::pi)),
         1.0);

  // An exception keeps its type across the installed libraries.
  try {
    plant::disk_inertia(-1.0, 1.0, 1.0);
    std::puts("disk_inertia took a negative radius");
    ++failures;
  } catch (const boresight::InvalidInput&) {
  }

  // A case file becomes an antenna without the program: the ratio of the 70-m antenna's gear train.
  if (count != 2) {
    std::puts("usage: consumer CASE");
    return 2;
  }
  const boresight::io::Case antenna = boresight::io::read_case(arguments[1]);
  expect("gear ratio as published, rounded", std::round(boresight::io::gear_ratio(antenna)),
         28724.0);
  return failures == 0 ? 0 : 1;
}
