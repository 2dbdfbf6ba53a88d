#include <algorithm>
#include <string>
#include <vector>

#include <boresight/io/audit/case_checks.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_statements.hpp>
#include <boresight/io/case/case_tests.hpp>
#include <boresight/io/case/resonating_mode.hpp>
#include <boresight/plant/antenna/hydraulics.hpp>

namespace boresight::io {
namespace {

/// An inertia that a test gave, as printed or recomputed.
struct MeasuredInertia {
  std::string id;
  std::string how;
  double value = 0.0;
};

std::string id_of(const ImpulseResult& result) {
  return "impulse." + result.name + ".reflected_inertia";
}

std::vector<MeasuredInertia> measured_inertias(const Case& antenna, const ShaftNumbers& shaft) {
  std::vector<MeasuredInertia> inertias;
  if (antenna.resonance->frequency) {
    const std::string id = "resonance.reflected_inertia";
    if (rings_as_rigid(antenna)) {
      inertias.push_back({id, "recomputed",
                          plant::inertia_from_resonance(shaft.oil_stiffness,
                                                        antenna.resonance->frequency->value)});
    }
    for (const StatedEntry& stated : antenna.stated) {
      // The summary prints it again.
      const bool again = !inertias.empty() && inertias.back().value == stated.value.value;
      if (stated.quantity == id && !again) {
        inertias.push_back({id, "as_printed", stated.value.value});
      }
    }
  }
  for (const ImpulseResult& result : antenna.impulse_results) {
    inertias.push_back({id_of(result), "as_printed", result.reflected_inertia.value});
  }
  return inertias;
}

}  // namespace

void check_inertia_remainders(const Case& antenna, PhysicalChecks& found) {
  const ShaftNumbers& shaft = found.shaft;
  for (const MeasuredInertia& inertia : measured_inertias(antenna, shaft)) {
    auto& check = begin_check(found, "inertia_remainder", inertia.id);
    check.explanation = inertia.how;
    check.add("inertia", inertia.value, "kg.m2");
    check.add("motors", shaft.motors, "kg.m2");
    check.add("gear train", shaft.gear_train, "kg.m2");
    check.add("remainder", inertia.value - (shaft.motors + shaft.gear_train), "kg.m2",
              0.5 * shaft.antenna);
    check.add("antenna", shaft.antenna, "kg.m2");
  }
}

void check_coincidences(const Case& antenna, PhysicalChecks& found) {
  std::vector<design::CheckedEntry> prints;
  for (const StatedEntry& stated : antenna.stated) {
    if (stated.quantity == "resonance.reflected_inertia" ||
        stated.quantity == "reflected_inertia") {
      const bool again = std::ranges::any_of(prints, [&](const design::CheckedEntry& print) {
        return print.id == stated.quantity && print.text == stated.value.text;
      });
      if (!again) prints.push_back({stated.quantity, stated.value.text, stated.value.value});
    }
  }
  for (const ImpulseResult& result : antenna.impulse_results) {
    prints.push_back(
        {id_of(result), result.reflected_inertia.text, result.reflected_inertia.value});
  }
  for (std::size_t i = 0; i < prints.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (prints[i].id == prints[k].id) continue;
      auto& check =
          begin_check(found, "coincidence", prints[i].id, prints[i].text != prints[k].text);
      check.entries = {prints[i], prints[k]};
    }
  }
}

void check_impulse_order(const Case& antenna, PhysicalChecks& found) {
  const FrictionTestsEntry& tests = *antenna.friction_tests;
  if (!tests.constant_speed_coulomb || !tests.slow_ramp_up || !tests.slow_ramp_down) return;
  const double slow_ramp = 0.5 * (tests.slow_ramp_up->value + tests.slow_ramp_down->value);
  const auto subtracted = [&](const ImpulseResult& result) {
    return result.friction == "constant_speed" ? tests.constant_speed_coulomb->value : slow_ramp;
  };
  for (const ImpulseResult& more : antenna.impulse_results) {
    for (const ImpulseResult& less : antenna.impulse_results) {
      const double torque = subtracted(more) - subtracted(less);
      if (torque <= 0.0) continue;
      const double inertia = more.reflected_inertia.value - less.reflected_inertia.value;
      auto& check = begin_check(found, "impulse_order", id_of(more));
      for (const ImpulseResult* one : {&more, &less}) {
        check.entries.push_back(
            {one->name, one->reflected_inertia.text, one->reflected_inertia.value});
      }
      check.entries.push_back({"friction." + more.friction + ".coulomb", "", subtracted(more)});
      check.add("friction difference", torque, "N.m");
      check.add("inertia difference", inertia, "kg.m2", -design::unbounded, 0.0);
      if (!check.holds) check.add("deceleration it would take", torque / inertia, "rad/s2");
    }
  }
}

}  // namespace boresight::io
