#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <boresight/app/audit/plausibility_checks.hpp>
#include <boresight/io/case/antenna_of.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/plant/nonlinear/drive_capability.hpp>

namespace boresight::app {
namespace {

struct Stroke {
  std::string how;
  io::Quantity rate;
};

std::vector<Stroke> strokes_of(const io::Case& antenna) {
  std::vector<Stroke> strokes;
  if (antenna.simulation && antenna.simulation->valve_stroke_stated) {
    strokes.push_back(
        {fmt::format("by simulation.valve_stroke '{}'", antenna.simulation->valve_stroke.text),
         antenna.simulation->valve_stroke});
  }
  const io::DriveEntry& drive = antenna.drive;
  if (const auto rated = io::rated_stroke(antenna);
      rated && drive.valve_rated_flow && drive.valve_rated_pressure_drop) {
    strokes.push_back(
        {fmt::format("by its rated flow of '{}' at '{}'", drive.valve_rated_flow->text,
                     drive.valve_rated_pressure_drop->text),
         *rated});
  }
  return strokes;
}

plant::LoadedDrive loaded_drive(const CaseNumbers& numbers) {
  return {drive_of(numbers.antenna), numbers.oil_stiffness, numbers.supply_torque};
}

// Of the excess at the slew rate.
double uncertainty(const CaseNumbers& numbers, const plant::LoadedDrive& drive,
                   const io::Quantity& stroke) {
  const double square = std::pow(numbers.slew_rate_at_motor / stroke.value, 2);
  const double of_share =
      2.0 * std::hypot(io::relative_uncertainty(numbers.antenna.drive.slew_rate),
                       io::relative_uncertainty(stroke));
  return std::hypot(friction_at_slew_rate(numbers).uncertainty,
                    drive.available() * square * of_share,
                    torque_of_supply(numbers).uncertainty * (1.0 - square));
}

void check_without_load(const CaseNumbers& numbers, const Stroke& stroke, Implausibilities& found) {
  const double slewing = numbers.slew_rate_at_motor;
  const double reached = stroke.rate.value;
  found.push_back(
      {"valve stroke",
       "drive.slew_rate",
       fmt::format("Slewing at '{}' takes {:.3g} rad/s of the motors; the valve, fully open, lets "
                   "them turn at {:.3g} rad/s without load {}, {:.0f} % of that: the antenna "
                   "cannot slew so fast, or a number of valve, supply, motors or gear ratio is "
                   "wrong.",
                   numbers.antenna.drive.slew_rate.text, slewing, reached, stroke.how,
                   100.0 * reached / slewing),
       {{"motor rate at slew rate", slewing, "rad/s"}, {"valve stroke", reached, "rad/s"}}});
}

void check_under_load(const CaseNumbers& numbers, const Stroke& stroke, Implausibilities& found) {
  // That the supply cannot turn the motors so fast with any valve is said of the friction.
  if (friction_stops_slewing(numbers)) return;
  const plant::LoadedDrive drive = loaded_drive(numbers);
  const double slewing = numbers.slew_rate_at_motor;
  if (drive.excess(slewing, stroke.rate.value) <= 2.0 * uncertainty(numbers, drive, stroke.rate)) {
    return;
  }
  const double load = drive.load(slewing);
  const double reached = drive.attainable_rate(stroke.rate.value);
  found.push_back(
      {"valve stroke",
       "drive.slew_rate",
       fmt::format(
           "Slewing at '{}' takes {:.3g} rad/s of the motors and {:.3g} N.m against {}, "
           "{:.0f} % of what the supply has above the return, which is off the valve's "
           "drop: fully open it lets them turn at {:.3g} rad/s without load {}, but against "
           "their load at {:.3g} rad/s at most, {:.0f} % of the slew rate: that is out of "
           "reach, or a number of friction, valve, supply, motors or gear ratio is wrong.",
           numbers.antenna.drive.slew_rate.text, slewing, load,
           drive.has_offset() ? "friction and offset" : "friction",
           100.0 * load / drive.available(), stroke.rate.value, stroke.how, reached,
           100.0 * reached / slewing),
       {{"motor rate at slew rate", slewing, "rad/s"},
        {"valve stroke", stroke.rate.value, "rad/s"},
        {"load at slew rate", load, "N.m"},
        {"supply torque above the return's", drive.available(), "N.m"},
        {"motor rate against the load", reached, "rad/s"}}});
}

}  // namespace

void check_valve_stroke(const CaseNumbers& numbers, Implausibilities& found) {
  const double slewing = numbers.slew_rate_at_motor;
  const double of_slewing = slewing * relative_uncertainty(numbers.antenna.drive.slew_rate);
  const std::vector<Stroke> strokes = strokes_of(numbers.antenna);
  for (const Stroke& stroke : strokes) {
    const double uncertainty = std::hypot(of_slewing, stroke.rate.standard_uncertainty);
    if (slewing - stroke.rate.value > 2.0 * uncertainty) {
      check_without_load(numbers, stroke, found);
    } else {
      check_under_load(numbers, stroke, found);
    }
  }
  if (strokes.size() < 2) return;
  const io::Quantity& stated = strokes[0].rate;
  const io::Quantity& rated = strokes[1].rate;
  const double difference = std::abs(stated.value - rated.value);
  if (difference <= 0.05 * rated.value ||
      difference <= 2.0 * std::hypot(stated.standard_uncertainty, rated.standard_uncertainty)) {
    return;
  }
  found.push_back(
      {"valve stroke",
       "simulation.valve_stroke",
       fmt::format("The valve, fully open, lets the motors turn at {:.3g} rad/s without "
                   "load {}, and at {:.3g} rad/s {}: one of the two is wrong.",
                   stated.value, strokes[0].how, rated.value, strokes[1].how),
       {{"valve stroke", stated.value, "rad/s"},
        {"valve stroke by the rated flow", rated.value, "rad/s"}}});
}

}  // namespace boresight::app
