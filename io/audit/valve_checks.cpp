#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <boresight/io/audit/case_checks.hpp>
#include <boresight/io/case/antenna_of.hpp>
#include <boresight/io/case/case_campaign.hpp>
#include <boresight/io/case/case_drive.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_simulation.hpp>
#include <boresight/io/case/case_tests.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/plant/nonlinear/drive_capability.hpp>

namespace boresight::io {
namespace {

/// A rate of the motors with the valve fully open, without load, and what says it.
struct Stroke {
  std::vector<design::CheckedEntry> entries;
  Quantity rate;
};

std::vector<Stroke> strokes_of(const Case& antenna) {
  std::vector<Stroke> strokes;
  if (antenna.simulation && antenna.simulation->valve_stroke_stated) {
    const Quantity& stroke = antenna.simulation->valve_stroke;
    strokes.push_back({{entry_of(stroke)}, stroke});
  }
  const DriveEntry& drive = *antenna.drive;
  if (const auto rated = rated_stroke(antenna);
      rated && drive.valve_rated_flow && drive.valve_rated_pressure_drop) {
    strokes.push_back(
        {{entry_of(*drive.valve_rated_flow), entry_of(*drive.valve_rated_pressure_drop)}, *rated});
  }
  return strokes;
}

// How far two numbers may be apart: 5 % of `size`, or two standard uncertainties.
double allowance(const Quantity& one, const Quantity& other, double size) {
  return std::max(0.05 * size,
                  2.0 * std::hypot(one.standard_uncertainty, other.standard_uncertainty));
}

// Of the excess at the slew rate.
double excess_uncertainty(const Case& antenna, const ShaftNumbers& shaft,
                          const plant::LoadedDrive& drive, const Quantity& stroke) {
  const double square = std::pow(shaft.slew_rate / stroke.value, 2);
  const double of_fraction = 2.0 * std::hypot(relative_uncertainty(antenna.drive->slew_rate),
                                              relative_uncertainty(stroke));
  return std::hypot(friction_at_slew_rate(antenna, shaft).uncertainty,
                    drive.available() * square * of_fraction,
                    torque_of_supply(antenna, shaft).uncertainty * (1.0 - square));
}

void check_under_load(const Case& antenna, const Stroke& stroke, PhysicalChecks& found) {
  const ShaftNumbers& shaft = found.shaft;
  // That the supply cannot turn the motors so fast with any valve is said of the friction.
  if (friction_stops_slewing(antenna, shaft)) return;
  const plant::LoadedDrive drive(drive_of(antenna), shaft.oil_stiffness, shaft.supply_torque);
  auto& check = begin_check(found, "slew_rate_under_load", "drive.slew_rate",
                            drive.excess(shaft.slew_rate, stroke.rate.value) <=
                                2.0 * excess_uncertainty(antenna, shaft, drive, stroke.rate));
  check.entries = stroke.entries;
  check.explanation = drive.has_offset() ? "friction_and_offset" : "friction";
  check.add("motor rate at slew rate", shaft.slew_rate, "rad/s");
  check.add("valve stroke", stroke.rate.value, "rad/s");
  check.add("load at slew rate", drive.load(shaft.slew_rate), "N.m");
  check.add("supply torque above the return's", drive.available(), "N.m");
  check.add("motor rate against the load", drive.attainable_rate(stroke.rate.value), "rad/s");
}

}  // namespace

double motor_rate_per_volt(const TachometerEntry& tachometer) {
  return tachometer.shaft_speed.value / tachometer.voltage.value * tachometer.motor_teeth.value /
         tachometer.tachometer_teeth.value;
}

void check_valve_stroke(const Case& antenna, PhysicalChecks& found) {
  const double slewing = found.shaft.slew_rate;
  const double of_slewing = slewing * relative_uncertainty(antenna.drive->slew_rate);
  const std::vector<Stroke> strokes = strokes_of(antenna);
  for (const Stroke& stroke : strokes) {
    auto& check = begin_check(found, "slew_rate_without_load", "drive.slew_rate");
    check.entries = stroke.entries;
    check.add("motor rate at slew rate", slewing, "rad/s");
    check.add("valve stroke", stroke.rate.value, "rad/s",
              slewing - 2.0 * std::hypot(of_slewing, stroke.rate.standard_uncertainty));
    if (check.holds) check_under_load(antenna, stroke, found);
  }
  if (strokes.size() < 2) return;
  const Quantity& stated = strokes[0].rate;
  const Quantity& rated = strokes[1].rate;
  const double allowed = allowance(stated, rated, rated.value);
  auto& check = begin_check(found, "valve_strokes", "simulation.valve_stroke");
  check.entries = strokes[0].entries;
  check.entries.insert(check.entries.end(), strokes[1].entries.begin(), strokes[1].entries.end());
  check.add("valve stroke", stated.value, "rad/s");
  check.add("valve stroke by the rated flow", rated.value, "rad/s", stated.value - allowed,
            stated.value + allowed);
}

void check_return_pressures(const Case& antenna, PhysicalChecks& found) {
  const auto& recorded = antenna.campaign->return_pressure;
  if (!recorded || !antenna.simulation) return;
  const Quantity& simulated = antenna.simulation->return_pressure;
  const double allowed =
      allowance(*recorded, simulated, std::max(recorded->value, simulated.value));
  auto& check = begin_check(found, "return_pressure", "simulation.return_pressure");
  check.entries = {entry_of(*recorded), entry_of(simulated)};
  check.add("drive.return_pressure", recorded->value, "Pa");
  check.add("simulation.return_pressure", simulated.value, "Pa", recorded->value - allowed,
            recorded->value + allowed);
}

void check_recorder_limit(const Case& antenna, PhysicalChecks& found) {
  if (!antenna.tachometer) return;
  const double limit = antenna.tachometer->recorder_limit.value;
  auto& check = begin_check(found, "recorder_limit", "tachometer.recorder_limit");
  check.add("voltage at slew rate",
            found.shaft.slew_rate / motor_rate_per_volt(*antenna.tachometer), "V",
            -design::unbounded, limit);
  check.add("recorder limit", limit, "V");
}

}  // namespace boresight::io
