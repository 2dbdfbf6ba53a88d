#include <algorithm>
#include <cmath>
#include <string>

#include <boresight/io/audit/case_checks.hpp>
#include <boresight/io/case/case_drive.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_mechanics.hpp>
#include <boresight/io/case/case_motor.hpp>
#include <boresight/io/case/case_pointing.hpp>
#include <boresight/io/case/case_statements.hpp>
#include <boresight/io/case/case_structure.hpp>
#include <boresight/io/case/case_tuning.hpp>
#include <boresight/io/case/member_ranges.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::io {

void check_inertia_against_dish(const Case& antenna, PhysicalChecks& found) {
  constexpr double wide_factor = 10.0;
  const AntennaEntry& dish = *antenna.antenna;
  const auto [minimum, maximum] = std::ranges::minmax(dss14_inertia_figures);
  auto& check = begin_check(found, "inertia_against_dish", dish.inertia.key);
  check.add("inertia over diameter^5", dish.inertia.value / std::pow(dish.dish_diameter.value, 5),
            "kg/m3", minimum / wide_factor, maximum * wide_factor);
  check.add("least known", minimum, "kg/m3");
  check.add("most known", maximum, "kg/m3");
}

void check_flywheels(const Case& antenna, PhysicalChecks& found) {
  constexpr double fastest_rim = 150.0;  // m/s
  constexpr double heaviest_disks = 10.0;
  const MotorEntry& motor = *antenna.motor;
  if (motor.disk_radius) {
    auto& check = begin_check(found, "flywheel_rim", motor.disk_radius->key);
    check.add("motor rate at slew rate", found.shaft.slew_rate, "rad/s");
    check.add("rim speed", motor.disk_radius->value * found.shaft.slew_rate, "m/s",
              -design::unbounded, fastest_rim);
  }
  const auto count = static_cast<double>(motor.count);
  const double rest =
      count * motor.rotor_inertia.value + found.shaft.gear_train + found.shaft.antenna;
  auto& check = begin_check(found, "flywheel_inertia", motor.disk_inertia.key);
  check.add("flywheel disks", count * motor.flywheel_disks * motor.disk_inertia.value, "kg.m2",
            -design::unbounded, heaviest_disks * rest);
  check.add("all else at the motors", rest, "kg.m2");
}

void check_carrier_frequencies(const Case& antenna, PhysicalChecks& found) {
  constexpr double speed_of_light = 299792458.0;  // m/s, exact
  constexpr double widest_beam_deg = 5.0;
  const auto check = [&](const BandEntry& band, const Quantity& frequency) {
    const double wavelength = speed_of_light / frequency.value;
    const double boresight_deg =
        band.beamwidth_factor.value * wavelength / antenna.antenna->dish_diameter.value / degree;
    auto& one = begin_check(found, "carrier_frequency", "band." + band.name + ".frequency");
    one.entries = {{one.quantity, frequency.text, frequency.value}};
    one.add("wavelength", wavelength, "m");
    one.add("beam width", boresight_deg * degree, "rad", -design::unbounded,
            widest_beam_deg * degree);
  };
  for (const BandEntry& band : antenna.bands) {
    check(band, band.frequency);
    for (const StatedEntry& stated : antenna.stated) {
      if (stated.quantity == "band." + band.name + ".frequency") check(band, stated.value);
    }
  }
}

void check_ensemble_ranges(const Case& antenna, PhysicalChecks& found) {
  const EnsembleEntry& ensemble = *antenna.ensemble;
  const design::MemberRanges ranges = member_ranges(antenna);
  const design::MemberRanges spread = spread_of_stated(antenna);
  auto& check = begin_check(found, "ensemble_range", "ensemble");
  const auto compare = [&](const std::optional<RangeEntry>& stated, const std::string& key,
                           const std::string& number, const design::Ends& range,
                           const design::Ends& minimum, double scale) {
    if (!stated || (range.lower <= minimum.lower && range.upper >= minimum.upper)) return;
    if (check.entries.empty()) check.quantity = "ensemble." + key;
    check.holds = false;
    check.entries.push_back({"ensemble." + key, "", 0.0});
    check.entries.push_back({number, "", scale});
    check.add(key + " lower", range.lower / scale, "1", -design::unbounded, minimum.lower / scale);
    check.add(key + " upper", range.upper / scale, "1", minimum.upper / scale);
  };
  compare(ensemble.structure_frequency, "structure_frequency",
          antenna.structure->locked_rotor_frequency.key, ranges.structure_frequency,
          spread.structure_frequency, 1.0);
  compare(ensemble.oil_stiffness, "oil_stiffness", "oil.bulk_modulus", ranges.oil_stiffness,
          spread.oil_stiffness, 1.0);
  compare(ensemble.leakage_rate, "leakage_rate", "drive.leakage_rate", ranges.leakage_rate,
          spread.leakage_rate, antenna.drive->leakage_rate.value);
}

}  // namespace boresight::io
