#include <array>

#include <fmt/format.h>

#include <boresight/app/audit/check_sentences.hpp>
#include <boresight/io/case/case_drive.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_friction.hpp>
#include <boresight/io/case/case_tests.hpp>
#include <boresight/io/case/friction_leeway.hpp>

namespace boresight::app {
namespace {

std::string as_written(const design::CheckedEntry& entry) {
  return fmt::format("'{}'{}", entry.text, entry.assumed ? " (assumed)" : "");
}

std::string taken_by_friction(const FailedCheck& failed, bool at_rest) {
  const design::CheckedEntry& maximum = failed.check.entries.at(0);
  if (at_rest) {
    return fmt::format("breakaway takes {:.3g} N.m, by {} {}", failed["breakaway"], maximum.id,
                       as_written(maximum));
  }
  return fmt::format(
      "at the slew rate of '{}' ({:.3g} rad/s at the motors) it is {:.3g} N.m, mostly from {} {}",
      failed.antenna.drive->slew_rate.text, failed.physics.shaft.slew_rate,
      failed["friction at slew rate"], maximum.id, as_written(maximum));
}

// By which entries a stroke is known.
std::string known_by(std::span<const design::CheckedEntry> entries) {
  return entries.size() == 1
             ? fmt::format("by simulation.valve_stroke '{}'", entries[0].text)
             : fmt::format("by its rated flow of '{}' at '{}'", entries[0].text, entries[1].text);
}

std::string friction_slope_sentence(const FailedCheck& failed) {
  const auto& numbers = failed.check.numbers;
  const bool rings = failed.antenna.resonance->frequency.has_value();
  std::string text = fmt::format("'{}' as viscous friction",
                                 failed.antenna.friction_tests->constant_speed_slope.value().text);
  // Behind the supply's torque and power four for each reading of the slope's unit.
  for (std::size_t i = 2; i + 3 < numbers.size(); i += 4) {
    const bool first = i == 2;
    text += fmt::format(
        "{} {} ({:.3g} N.m.s/rad) gives the hydraulic mode{} a damping ratio of {:.2f} and takes "
        "{:.3g} N.m and {:.3g} kW at slew rate",
        first ? "" : ";", numbers[i].name.substr(std::string_view("slope ").size()),
        numbers[i].value, first && rings ? ", which rings in the tests," : "", numbers[i + 1].value,
        numbers[i + 2].value, 1e-3 * numbers[i + 3].value);
  }
  return text + fmt::format(". The supply gives {:.3g} N.m, {:.3g} kW{}.", failed["supply torque"],
                            1e-3 * failed["supply power at slew rate"],
                            failed.antenna.drive->supply_pressure.basis == io::Basis::assumed
                                ? " (from an assumed pressure)"
                                : "");
}

// Of what takes more than the whole of the supply's torque, or a large fraction of it.
std::string friction_against_supply_sentence(const FailedCheck& failed) {
  const bool at_rest = failed.check.explanation.starts_with("breakaway");
  const bool impossible = failed.check.explanation.ends_with("_beyond_supply");
  std::string claim = fmt::format("Friction takes {:.0f} % of the supply's torque",
                                  100.0 * failed["fraction of the supply torque"]);
  std::string doubt = "wind and acceleration need torque as well, or ";
  if (impossible) {
    claim = fmt::format("The supply cannot {} the antenna against its friction",
                        at_rest ? "move" : "slew");
    doubt = at_rest ? "" : "the slew rate is out of reach, or ";
  }
  return fmt::format(
      "{}: {}, and the motors give {:.3g} N.m at {}: {}one of these numbers or its "
      "unit is wrong.",
      claim, taken_by_friction(failed, at_rest), failed["supply torque"],
      as_written(failed.check.entries.at(1)), doubt);
}

std::string friction_test_line_sentence(const FailedCheck& failed) {
  const auto& tested = failed.check.numbers.front();
  return fmt::format(
      "The line through the constant-speed tests has the {} '{}', {:.3g} {}; [friction_curve] "
      "allows {:.3g} to {:.3g} {}. Tests and curve contradict each other, or one is in other units "
      "or for another shaft.",
      tested.unit == "N.m" ? "intercept" : "slope", failed.check.entries.at(0).text, tested.value,
      tested.unit, failed["least by the curve"], failed["most by the curve"], tested.unit);
}

std::string friction_curve_tests_sentence(const FailedCheck& failed) {
  const io::FrictionCurveEntry& curve = *failed.antenna.friction_curve;
  const auto rate = io::loose_stribeck_rate(curve).value();
  std::string maximum;
  if (rate.moved_most_by) {
    const io::SteadyFrictionTest& test = curve.tests[*rate.moved_most_by];
    maximum = fmt::format(", moved most by friction_curve.test[{}] of {:.4g} N.m at {:.4g} rad/s",
                          *rate.moved_most_by, test.torque, test.rate);
  }
  return fmt::format(
      "The curve has as many unknowns as its {} tests, so no test checks it. {} the motors' "
      "Stribeck rate, {:.3g} rad/s by the torques as stated, is {}{}. Limit cycles and reversals "
      "depend on that rate: add tests at low rates.",
      curve.tests.size(), io::moved_torques(), curve.stribeck_rate.value,
      io::in_words(rate, "rad/s"), maximum);
}

std::string coulomb_levels_sentence(const FailedCheck& failed) {
  return fmt::format(
      "The constant-speed test's intercept is {:.3g} N.m, the slow ramp's level {:.3g} N.m, {:.1f} "
      "times apart: friction is not linear in speed, and a line through two speeds does not give "
      "the friction at rest.",
      failed["constant speed"], failed["slow ramp"], failed["factor"]);
}

std::string slew_rate_without_load_sentence(const FailedCheck& failed) {
  const double slewing = failed["motor rate at slew rate"], reached = failed["valve stroke"];
  return fmt::format(
      "Slewing at '{}' needs {:.3g} rad/s at the motors; the fully open valve gives {:.3g} rad/s "
      "without load {}, {:.0f} % of that. The antenna cannot slew so fast, or a value of valve, "
      "supply, motors or gear ratio is wrong.",
      failed.antenna.drive->slew_rate.text, slewing, reached, known_by(failed.check.entries),
      100.0 * reached / slewing);
}

std::string slew_rate_under_load_sentence(const FailedCheck& failed) {
  const double slewing = failed["motor rate at slew rate"];
  const double load = failed["load at slew rate"];
  const double reached = failed["motor rate against the load"];
  return fmt::format(
      "Slewing at '{}' needs {:.3g} rad/s at the motors and {:.3g} N.m against {}, {:.0f} % of the "
      "supply's torque above the return. The fully open valve gives {:.3g} rad/s without load {}, "
      "but {:.3g} rad/s under this load, {:.0f} % of the slew rate. The slew rate is out of reach, "
      "or a value of friction, valve, supply, motors or gear ratio is wrong.",
      failed.antenna.drive->slew_rate.text, slewing, load,
      failed.check.explanation == "friction" ? "friction" : "friction and offset",
      100.0 * load / failed["supply torque above the return's"], failed["valve stroke"],
      known_by(failed.check.entries), reached, 100.0 * reached / slewing);
}

std::string valve_strokes_sentence(const FailedCheck& failed) {
  const std::span strokes(failed.check.entries);
  return fmt::format(
      "The fully open valve gives the motors {:.3g} rad/s without load {}, and {:.3g} rad/s {}: "
      "one of the two is wrong.",
      failed["valve stroke"], known_by(strokes.first(1)), failed["valve stroke by the rated flow"],
      known_by(strokes.subspan(1)));
}

std::string return_pressure_sentence(const FailedCheck& failed) {
  return fmt::format(
      "The return pressure is '{}' by drive.return_pressure (for identification) and '{}' by "
      "simulation.return_pressure (for simulation and the valve's stroke by its rated flow): one "
      "of the two is wrong.",
      failed.check.entries.at(0).text, failed.check.entries.at(1).text);
}

std::string recorder_limit_sentence(const FailedCheck& failed) {
  const double volts = failed["voltage at slew rate"], limit = failed["recorder limit"];
  return fmt::format(
      "At slew rate the tachometer gives {:.3g} V, the recorder clips at {:.3g} V: only the lowest "
      "{:.0f} % of the speed range is recorded.",
      volts, limit, 100.0 * limit / volts);
}

constexpr std::array of_drive{
    CheckWording{"friction_slope", "friction slope", &friction_slope_sentence},
    CheckWording{"friction_against_supply", "friction against the supply",
                 &friction_against_supply_sentence},
    CheckWording{"friction_test_line", "friction tests", &friction_test_line_sentence},
    CheckWording{"friction_curve_tests", "friction tests", &friction_curve_tests_sentence},
    CheckWording{"coulomb_levels", "Coulomb levels", &coulomb_levels_sentence},
    CheckWording{"slew_rate_without_load", "valve stroke", &slew_rate_without_load_sentence},
    CheckWording{"slew_rate_under_load", "valve stroke", &slew_rate_under_load_sentence},
    CheckWording{"valve_strokes", "valve stroke", &valve_strokes_sentence},
    CheckWording{"return_pressure", "return pressure", &return_pressure_sentence},
    CheckWording{"recorder_limit", "recorder limit", &recorder_limit_sentence},
};

}  // namespace

std::span<const CheckWording> drive_wordings() {
  return of_drive;
}

}  // namespace boresight::app
