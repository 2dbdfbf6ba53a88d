#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include <boresight/app/audit/plausibility_checks.hpp>

namespace boresight::app {
namespace {

// Inertia over the fifth power of the diameter (kg/m3), Sommerville, section II: 64 m with 100e6
// lbf ft s2 and 70 m with 241.667e6 about elevation, 70 m with 303.3e6 about azimuth.
constexpr std::array known_figures{0.126, 0.195, 0.245};
constexpr double wide_factor = 10.0;

constexpr double fastest_rim = 150.0;  // m/s
constexpr double heaviest_disks = 10.0;

}  // namespace

void check_inertia_against_dish(const CaseNumbers& numbers, Implausibilities& found) {
  const io::AntennaEntry& antenna = numbers.antenna.antenna;
  const double figure = antenna.inertia.value / std::pow(antenna.dish_diameter.value, 5);
  const auto [least, most] = std::ranges::minmax(known_figures);
  const bool light = figure < least / wide_factor;
  if (!light && figure <= most * wide_factor) return;
  found.push_back(
      {"inertia against the dish",
       antenna.inertia.key,
       fmt::format(
           "'{}' over the fifth power of the dish's '{}' is {:.2g} kg/m3; DSS-14 had {:.3g} kg/m3 "
           "about elevation with 64 m, and has {:.3g} about elevation and {:.3g} about azimuth "
           "with "
           "70 m (Sommerville, section II), and structures alike keep that figure at any size: "
           "inertia or diameter is in another unit{}.",
           antenna.inertia.text, antenna.dish_diameter.text, figure, known_figures[0],
           known_figures[1], known_figures[2],
           light ? ", or the inertia that of a part" : ", or a radius stands for the diameter"),
       {{"inertia over diameter^5", figure, "kg/m3"},
        {"least known", least, "kg/m3"},
        {"most known", most, "kg/m3"}}});
}

void check_flywheels(const CaseNumbers& numbers, Implausibilities& found) {
  const io::MotorEntry& motor = numbers.antenna.motor;
  if (motor.disk_radius) {
    const double rim = motor.disk_radius->value * numbers.slew_rate_at_motor;
    if (rim > fastest_rim) {
      found.push_back(
          {"flywheel",
           motor.disk_radius->key,
           fmt::format(
               "At the slew rate of '{}', {:.3g} rad/s of the motors, the rim of a flywheel "
               "disk of '{}' radius runs at {:.3g} m/s; plain steel disks with a bore yield "
               "from some 200 m/s: the radius may be a diameter or in another unit, or slew "
               "rate or gear ratio is wrong.",
               numbers.antenna.drive.slew_rate.text, numbers.slew_rate_at_motor,
               motor.disk_radius->text, rim),
           {{"motor rate at slew rate", numbers.slew_rate_at_motor, "rad/s"},
            {"rim speed", rim, "m/s"}}});
    }
  }
  const auto count = static_cast<double>(motor.count);
  const double disks = count * motor.flywheel_disks * motor.disk_inertia.value;
  const double rest =
      count * motor.rotor_inertia.value + numbers.gear_train + numbers.antenna_at_motor;
  if (disks <= heaviest_disks * rest) return;
  found.push_back(
      {"flywheel",
       motor.disk_inertia.key,
       fmt::format(
           "{:.0f} flywheel disks of {:.3g} kg.m2 on each of {:.0f} motors have {:.3g} kg.m2, "
           "{:.0f} times all that turns with them, {:.3g} kg.m2 at the motors with gear "
           "train and antenna: a disk's dimensions or inertia are in another unit, or are "
           "those of all disks.",
           motor.flywheel_disks, motor.disk_inertia.value, count, disks, disks / rest, rest),
       {{"flywheel disks", disks, "kg.m2"}, {"all else at the motors", rest, "kg.m2"}}});
}

}  // namespace boresight::app
