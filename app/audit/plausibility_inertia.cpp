#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <boresight/app/audit/plausibility_checks.hpp>
#include <boresight/io/case/resonating_mode.hpp>
#include <boresight/plant/antenna/hydraulics.hpp>

namespace boresight::app {
namespace {

/// An inertia that a test gave, as printed or recomputed.
struct MeasuredInertia {
  std::string id;
  std::string how;
  double value = 0.0;
};

std::vector<MeasuredInertia> measured_inertias(const CaseNumbers& numbers) {
  std::vector<MeasuredInertia> inertias;
  if (numbers.antenna.resonance_frequency) {
    const std::string id = "resonance.reflected_inertia";
    if (rings_as_rigid(numbers.antenna)) {
      inertias.push_back({id, "recomputed",
                          plant::inertia_from_resonance(
                              numbers.oil_stiffness, numbers.antenna.resonance_frequency->value)});
    }
    for (const io::StatedEntry& stated : numbers.antenna.stated) {
      // The summary prints it again.
      const bool again = !inertias.empty() && inertias.back().value == stated.value.value;
      if (stated.quantity == id && !again) {
        inertias.push_back({id, "as printed", stated.value.value});
      }
    }
  }
  for (const io::ImpulseResult& result : numbers.antenna.impulse_results) {
    inertias.push_back({"impulse." + result.name + ".reflected_inertia", "as printed",
                        result.reflected_inertia.value});
  }
  return inertias;
}

}  // namespace

void check_inertia_remainders(const CaseNumbers& numbers, Implausibilities& found) {
  const double rotating = numbers.motors + numbers.gear_train;
  for (const MeasuredInertia& inertia : measured_inertias(numbers)) {
    const double remainder = inertia.value - rotating;
    if (remainder >= 0.5 * numbers.antenna_at_motor) continue;
    found.push_back(
        {"inertia remainder",
         inertia.id,
         fmt::format(
             "{:.4g} kg.m2 {} less {:.4g} of the motors and {:.4g} of the gear train leaves {:.3g} "
             "kg.m2 for the antenna, which needs {:.3g}{}.",
             inertia.value, inertia.how, numbers.motors, numbers.gear_train, remainder,
             numbers.antenna_at_motor,
             remainder < 0.0
                 ? ": no antenna has a negative inertia"
                 : fmt::format(": {:.0f} %", 100.0 * remainder / numbers.antenna_at_motor)),
         {{"inertia", inertia.value, "kg.m2"},
          {"motors", numbers.motors, "kg.m2"},
          {"gear train", numbers.gear_train, "kg.m2"},
          {"remainder", remainder, "kg.m2"},
          {"antenna", numbers.antenna_at_motor, "kg.m2"}}});
  }
}

void check_coincidences(const CaseNumbers& numbers, Implausibilities& found) {
  struct Print {
    std::string id, text;
  };
  std::vector<Print> prints;
  for (const io::StatedEntry& stated : numbers.antenna.stated) {
    if (stated.quantity == "resonance.reflected_inertia" ||
        stated.quantity == "reflected_inertia") {
      const bool again = std::any_of(prints.begin(), prints.end(), [&](const Print& print) {
        return print.id == stated.quantity && print.text == stated.value.text;
      });
      if (!again) prints.push_back({stated.quantity, stated.value.text});
    }
  }
  for (const io::ImpulseResult& result : numbers.antenna.impulse_results) {
    prints.push_back(
        {"impulse." + result.name + ".reflected_inertia", result.reflected_inertia.text});
  }
  for (std::size_t i = 0; i < prints.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (prints[i].text != prints[k].text || prints[i].id == prints[k].id) continue;
      found.push_back({"coincidence",
                       prints[i].id,
                       fmt::format("'{}' is printed for {} and for {}: two methods that agree to "
                                   "the last digit, which chance rarely makes; they are no "
                                   "independent confirmation before that is explained.",
                                   prints[i].text, prints[k].id, prints[i].id),
                       {}});
    }
  }
}

void check_impulse_order(const CaseNumbers& numbers, Implausibilities& found) {
  const io::FrictionTestsEntry& tests = numbers.antenna.friction_tests;
  if (!tests.constant_speed_coulomb || !tests.slow_ramp_up || !tests.slow_ramp_down) return;
  const double constant_speed = tests.constant_speed_coulomb->value;
  const double slow_ramp = 0.5 * (tests.slow_ramp_up->value + tests.slow_ramp_down->value);
  const auto subtracted = [&](const io::ImpulseResult& result) {
    return result.friction == "constant_speed" ? constant_speed : slow_ramp;
  };
  for (const io::ImpulseResult& more : numbers.antenna.impulse_results) {
    for (const io::ImpulseResult& less : numbers.antenna.impulse_results) {
      const double torque = subtracted(more) - subtracted(less);
      const double inertia = more.reflected_inertia.value - less.reflected_inertia.value;
      if (torque <= 0.0 || inertia <= 0.0) continue;
      const double acceleration = torque / inertia;
      found.push_back(
          {"impulse order",
           "impulse." + more.name + ".reflected_inertia",
           fmt::format("With {:.3g} N.m more friction subtracted ({} against {}) an accelerating "
                       "window must give less inertia, J falls by dT dt/dw; printed is {:.3g} "
                       "kg.m2 more. Either the two are exchanged, or the windows slowed down, by "
                       "{:.3g} rad/s2: {:.3g} N.m of braking, all but the friction's {:.3g} N.m "
                       "from the motors.",
                       torque, more.name, less.name, inertia, acceleration,
                       acceleration * more.reflected_inertia.value, subtracted(more)),
           {{"friction difference", torque, "N.m"},
            {"inertia difference", inertia, "kg.m2"},
            {"deceleration it would take", acceleration, "rad/s2"}}});
    }
  }
}

}  // namespace boresight::app
