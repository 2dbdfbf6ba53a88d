#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <boresight/app/audit/plausibility_checks.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/plant/antenna/hydraulics.hpp>

namespace boresight::app {
namespace {

constexpr double speed_of_light = 299792458.0;  // m/s, exact
constexpr double widest_beam_deg = 5.0;
constexpr double rpm = two_pi / 60.0;

double motor_rate_per_volt(const io::TachometerEntry& tachometer) {
  return tachometer.shaft_speed.value / tachometer.voltage.value * tachometer.motor_teeth.value /
         tachometer.tachometer_teeth.value;
}

/// What a viscous friction (N m s/rad at the motor) would do.
struct SlopeEffect {
  std::string reading;
  double slope = 0.0;
  double damping = 0.0;
  double torque = 0.0;
  double power = 0.0;
};

SlopeEffect effect_of(const CaseNumbers& numbers, const std::string& reading, double slope,
                      double coulomb) {
  const double inertia = numbers.motors + numbers.gear_train + numbers.antenna_at_motor;
  const double torque = coulomb + slope * numbers.slew_rate_at_motor;
  return {reading, slope,
          plant::hydraulic_damping(numbers.oil_stiffness, inertia,
                                   numbers.antenna.drive.leakage_rate.value, slope),
          torque, torque * numbers.slew_rate_at_motor};
}

}  // namespace

void check_friction_slope(const CaseNumbers& numbers, Implausibilities& found) {
  const io::FrictionTestsEntry& tests = numbers.antenna.friction_tests;
  if (!tests.constant_speed_slope) return;
  const double slope = tests.constant_speed_slope->value;
  const double coulomb = tests.constant_speed_coulomb ? tests.constant_speed_coulomb->value : 0.0;
  std::vector<SlopeEffect> effects{effect_of(numbers, "at the motor's shaft", slope, coulomb)};
  const bool rings = numbers.antenna.resonance_frequency.has_value();
  const bool overdamped = rings && effects[0].damping > 1.0;
  if (!overdamped && effects[0].torque <= numbers.supply_torque) return;
  if (numbers.antenna.tachometer) {
    const io::TachometerEntry& tachometer = *numbers.antenna.tachometer;
    const double motor_per_tachometer =
        tachometer.motor_teeth.value / tachometer.tachometer_teeth.value;
    effects.push_back(effect_of(numbers, "if the speed is the tachometer's",
                                slope / motor_per_tachometer, coulomb));
    effects.push_back(effect_of(numbers, "if it is per volt of the tachometer",
                                slope * rpm / motor_rate_per_volt(tachometer), coulomb));
  }
  const double supply_power = numbers.supply_torque * numbers.slew_rate_at_motor;
  Implausibility implausible{"friction slope",
                             "friction_tests.constant_speed_slope",
                             "",
                             {{"supply torque", numbers.supply_torque, "N.m"},
                              {"supply power at slew rate", supply_power, "W"}}};
  implausible.reasoning = fmt::format("'{}' as viscous friction", tests.constant_speed_slope->text);
  for (std::size_t i = 0; i < effects.size(); ++i) {
    const SlopeEffect& effect = effects[i];
    implausible.reasoning += fmt::format(
        "{} {} ({:.3g} N.m.s/rad) gives the hydraulic mode{} a damping ratio of {:.2f} and takes "
        "{:.3g} N.m and {:.3g} kW at slew rate",
        i == 0 ? "" : ";", effect.reading, effect.slope,
        i == 0 && rings ? ", which was seen to ring," : "", effect.damping, effect.torque,
        1e-3 * effect.power);
    implausible.numbers.push_back({"slope " + effect.reading, effect.slope, "N.m.s/rad"});
    implausible.numbers.push_back({"damping ratio " + effect.reading, effect.damping, "1"});
    implausible.numbers.push_back({"torque at slew rate " + effect.reading, effect.torque, "N.m"});
    implausible.numbers.push_back({"power at slew rate " + effect.reading, effect.power, "W"});
  }
  implausible.reasoning += fmt::format(
      ". The supply gives {:.3g} N.m, {:.3g} kW{}.", numbers.supply_torque, 1e-3 * supply_power,
      numbers.antenna.drive.supply_pressure.basis == io::Basis::assumed
          ? " (from an assumed pressure)"
          : "");
  found.push_back(std::move(implausible));
}

void check_coulomb_levels(const CaseNumbers& numbers, Implausibilities& found) {
  const io::FrictionTestsEntry& tests = numbers.antenna.friction_tests;
  if (!tests.constant_speed_coulomb || !tests.slow_ramp_up || !tests.slow_ramp_down) return;
  const double intercept = tests.constant_speed_coulomb->value;
  const double ramp = 0.5 * (tests.slow_ramp_up->value + tests.slow_ramp_down->value);
  const double factor = std::max(intercept, ramp) / std::min(intercept, ramp);
  if (!(factor > 1.5)) return;
  found.push_back(
      {"Coulomb levels",
       "friction.slow_ramp.coulomb",
       fmt::format(
           "The constant-speed test's intercept is {:.3g} N.m, the slow ramp's level {:.3g} "
           "N.m, {:.1f} times apart: friction between the tests' speeds is not a straight "
           "line, and a slope through two points at speed says nothing about rest.",
           intercept, ramp, factor),
       {{"constant speed", intercept, "N.m"},
        {"slow ramp", ramp, "N.m"},
        {"factor", factor, "1"}}});
}

void check_return_pressures(const CaseNumbers& numbers, Implausibilities& found) {
  const auto& recorded = numbers.antenna.campaign.return_pressure;
  if (!recorded || !numbers.antenna.simulation) return;
  const io::Quantity& simulated = numbers.antenna.simulation->return_pressure;
  const double difference = std::abs(recorded->value - simulated.value);
  if (difference <= 0.05 * std::max(recorded->value, simulated.value) ||
      difference <=
          2.0 * std::hypot(recorded->standard_uncertainty, simulated.standard_uncertainty)) {
    return;
  }
  found.push_back(
      {"return pressure",
       "simulation.return_pressure",
       fmt::format("The pressure behind the valve is '{}' by drive.return_pressure, with which "
                   "`boresight identify` reads the records, and '{}' by "
                   "simulation.return_pressure, which simulated runs and the valve's stroke by "
                   "its rated flow take: one of the two is wrong.",
                   recorded->text, simulated.text),
       {{"drive.return_pressure", recorded->value, "Pa"},
        {"simulation.return_pressure", simulated.value, "Pa"}}});
}

void check_recorder_limit(const CaseNumbers& numbers, Implausibilities& found) {
  if (!numbers.antenna.tachometer) return;
  const io::TachometerEntry& tachometer = *numbers.antenna.tachometer;
  const double volts = numbers.slew_rate_at_motor / motor_rate_per_volt(tachometer);
  const double limit = tachometer.recorder_limit.value;
  if (volts <= limit) return;
  found.push_back(
      {"recorder limit",
       "tachometer.recorder_limit",
       fmt::format("At slew rate the tachometer gives {:.3g} V, the recorder clips at {:.3g} V: "
                   "only the lowest {:.0f} % of the speed range is recorded, the rest is a plateau "
                   "and no measurement.",
                   volts, limit, 100.0 * limit / volts),
       {{"voltage at slew rate", volts, "V"}, {"recorder limit", limit, "V"}}});
}

void check_wave_speeds(const CaseNumbers& numbers, Implausibilities& found) {
  struct Wave {
    std::string id;
    double speed, uncertainty;
    bool restated;
  };
  std::vector<Wave> waves;
  const auto add = [&](const io::OilLine& line, const io::Quantity& frequency, bool restated) {
    const double speed = 2.0 * line.length.value * frequency.value;
    const double relative = std::hypot(io::relative_uncertainty(line.length),
                                       io::relative_uncertainty(line.slosh_frequency));
    waves.push_back({"line." + line.name + ".slosh_frequency", speed, speed * relative, restated});
  };
  for (const io::OilLine& line : numbers.antenna.oil.lines) {
    add(line, line.slosh_frequency, false);
    for (const io::StatedEntry& stated : numbers.antenna.stated) {
      if (stated.quantity == waves.back().id) add(line, stated.value, true);
    }
  }
  for (std::size_t i = 0; i < waves.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const double difference = std::abs(waves[i].speed - waves[k].speed);
      const double uncertainty = std::hypot(waves[i].uncertainty, waves[k].uncertainty);
      const bool same_line = waves[i].id == waves[k].id;
      if (waves[k].restated || waves[i].restated != same_line) continue;
      if (difference <= 2.0 * uncertainty) continue;
      const auto name = [](const Wave& wave) {
        return wave.id + (wave.restated ? " as printed again" : "");
      };
      found.push_back(
          {"wave speed",
           waves[i].id,
           fmt::format("The same oil carries sound at {:.4g} m/s by {} and at {:.4g} m/s by {}, "
                       "{:.1f} standard uncertainties apart, {:.1f} % in bulk modulus.",
                       waves[k].speed, name(waves[k]), waves[i].speed, name(waves[i]),
                       difference / uncertainty,
                       100.0 * (std::pow(waves[k].speed / waves[i].speed, 2) - 1.0)),
           {{name(waves[k]), waves[k].speed, "m/s"}, {name(waves[i]), waves[i].speed, "m/s"}}});
    }
  }
}

void check_structural_bound(const CaseNumbers& numbers, Implausibilities& found) {
  const io::StructureEntry& structure = numbers.antenna.structure;
  if (!structure.lowest_predicted || structure.lowest_predicted_axis == numbers.antenna.axis) {
    return;
  }
  found.push_back({"structural bound",
                   "structure.lowest_predicted",
                   fmt::format("'{}' is the lowest structural frequency predicted for the {} axis; "
                               "it says nothing about resonances of the {} axis.",
                               structure.lowest_predicted->text, structure.lowest_predicted_axis,
                               numbers.antenna.axis),
                   {{"lowest predicted", structure.lowest_predicted->value, "Hz"}}});
}

void check_carrier_frequencies(const CaseNumbers& numbers, Implausibilities& found) {
  const double dish = numbers.antenna.antenna.dish_diameter.value;
  const auto check = [&](const io::BandEntry& band, const io::Quantity& frequency) {
    const double wavelength = speed_of_light / frequency.value;
    const double beam = band.beamwidth_factor.value * wavelength / dish / degree;
    if (beam <= widest_beam_deg) return;
    found.push_back(
        {"carrier frequency",
         "band." + band.name + ".frequency",
         fmt::format("At '{}' the wave is {:.3g} m long against a dish of {:.3g} m: its beam would "
                     "be {:.2g} deg wide and need no pointing.",
                     frequency.text, wavelength, dish, beam),
         {{"wavelength", wavelength, "m"}, {"beam width", beam * degree, "rad"}}});
  };
  for (const io::BandEntry& band : numbers.antenna.bands) {
    check(band, band.frequency);
    for (const io::StatedEntry& stated : numbers.antenna.stated) {
      if (stated.quantity == "band." + band.name + ".frequency") check(band, stated.value);
    }
  }
}

}  // namespace boresight::app
