#include <algorithm>
#include <string>

#include <fmt/format.h>

#include <boresight/app/audit/plausibility_checks.hpp>
#include <boresight/app/redesign/resonance_verdict.hpp>
#include <boresight/io/case/antenna_of.hpp>
#include <boresight/io/case/plant_numbers.hpp>
#include <boresight/io/case/resonating_mode.hpp>
#include <boresight/plant/antenna/antenna_change.hpp>
#include <boresight/plant/antenna/hydraulics.hpp>

namespace boresight::app {
namespace {

plant::PlantMode flexible_mode(const io::Case& antenna,
                               const std::vector<plant::AntennaChange>& changes = {}) {
  return resonating_mode(antenna, make_plant(antenna, changes));
}

}  // namespace

void check_expected_resonance(const CaseNumbers& numbers, Implausibilities& found) {
  const auto verdict = resonance_verdict(numbers.antenna);
  if (!verdict || !verdict->contradicts()) return;
  const double rotating = numbers.motors + numbers.gear_train;
  const auto rigid = [&](double load) {
    return plant::hydraulic_frequency(numbers.oil_stiffness, rotating + load);
  };
  Implausibility implausible{"resonance expected",
                             "resonance.frequency",
                             "",
                             {{"measured", verdict->measured, "Hz"},
                              {"expected", verdict->expected, "Hz"},
                              {"all masses rigid", rigid(numbers.antenna_at_motor), "Hz"},
                              {"without the antenna", rigid(0.0), "Hz"},
                              {"standard uncertainties", verdict->deviation(), "1"}}};
  std::string others;
  for (const io::AntennaAlternative& alternative : numbers.antenna.antenna.alternatives) {
    const double frequency =
        flexible_mode(numbers.antenna, changes_of(numbers.antenna, alternative)).frequency;
    others += fmt::format("; the flexible antenna has {:.3f} Hz with the inertia of {}", frequency,
                          alternative.name);
    implausible.numbers.push_back({alternative.name, frequency, "Hz"});
  }
  if (verdict->bulk_modulus) {
    implausible.numbers.push_back({"bulk modulus for it", *verdict->bulk_modulus, "Pa"});
  }
  implausible.reasoning = fmt::format(
      "{} All masses rigid on the oil spring would make it {:.3f} Hz, {:.3f} Hz with no antenna at "
      "all{}. Stiffness, masses or the reading of the spectrum is wrong.",
      resonance_sentence(*verdict), rigid(numbers.antenna_at_motor), rigid(0.0), others);
  found.push_back(std::move(implausible));
}

void check_resonance_damping(const CaseNumbers& numbers, Implausibilities& found) {
  if (!numbers.antenna.resonance_damping) return;
  // Read off a decay by eye, and of a plant whose friction is a straight line.
  constexpr double agrees = 2.0;
  const double measured = numbers.antenna.resonance_damping->value;
  const double expected = flexible_mode(numbers.antenna).damping_ratio;
  if (std::max(measured, expected) <= agrees * std::min(measured, expected)) return;
  const io::DriveEntry& drive = numbers.antenna.drive;
  const auto verdict = resonance_verdict(numbers.antenna);
  found.push_back(
      {"resonance damping",
       "resonance.damping_ratio",
       fmt::format(
           "The {} of the case has the damping ratio {:.3g}, by the leakage rate of {:.3g} 1/s, "
           "viscous friction of {:.3g} N.m.s/rad and the structure; measured is {:.3g}, more than "
           "a factor of {:g} {}: leakage or friction is {} than stated{}.{}",
           numbers.antenna.resonance_of_oil ? "mode of most oil" : "hydraulic mode", expected,
           drive.leakage_rate.value, drive.viscous_friction.value, measured, agrees,
           measured > expected ? "above" : "below", measured > expected ? "larger" : "smaller",
           measured > expected
               ? ", or what no linear plant has damped that test: dry friction, or "
                 "the edges of a valve that stood open, which leak with the pressure"
               : "",
           verdict ? which_was_measured(*verdict) : ""),
       {{"measured", measured, "1"}, {"expected", expected, "1"}}});
}

}  // namespace boresight::app
