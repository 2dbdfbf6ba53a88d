#include <algorithm>
#include <cmath>
#include <vector>

#include <boresight/io/audit/case_checks.hpp>
#include <boresight/io/case/antenna_of.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_mechanics.hpp>
#include <boresight/io/case/case_oil.hpp>
#include <boresight/io/case/case_statements.hpp>
#include <boresight/io/case/case_tests.hpp>
#include <boresight/io/case/plant_numbers.hpp>
#include <boresight/io/case/resonating_mode.hpp>
#include <boresight/plant/antenna/antenna_change.hpp>
#include <boresight/plant/antenna/hydraulics.hpp>

namespace boresight::io {
namespace {

plant::PlantMode flexible_mode(const Case& antenna,
                               const std::vector<plant::AntennaChange>& changes = {}) {
  return resonating_mode(antenna, make_plant(antenna, changes));
}

}  // namespace

void check_expected_resonance(const Case& antenna, PhysicalChecks& found) {
  if (!found.resonance) return;
  const ResonanceVerdict& verdict = *found.resonance;
  const ShaftNumbers& shaft = found.shaft;
  const auto rigid = [&](double load) {
    return plant::hydraulic_frequency(shaft.oil_stiffness, shaft.motors + shaft.gear_train + load);
  };
  auto& check =
      begin_check(found, "resonance_expected", "resonance.frequency", !verdict.contradicts());
  check.add("measured", verdict.measured, "Hz");
  check.add("expected", verdict.expected, "Hz");
  check.add("all masses rigid", rigid(shaft.antenna), "Hz");
  check.add("without the antenna", rigid(0.0), "Hz");
  check.add("standard uncertainties", verdict.deviation(), "1", 0.0,
            ResonanceVerdict::contradicting_deviation);
  if (!check.holds) {
    for (const AntennaAlternative& alternative : antenna.antenna->alternatives) {
      check.add(alternative.name,
                flexible_mode(antenna, changes_of(antenna, alternative)).frequency, "Hz");
    }
    if (verdict.bulk_modulus) check.add("bulk modulus for it", *verdict.bulk_modulus, "Pa");
  }
}

void check_resonance_damping(const Case& antenna, PhysicalChecks& found) {
  if (!antenna.resonance->damping) return;
  // Read off a decay by eye, and of a plant whose friction is a straight line.
  constexpr double agrees = 2.0;
  const double expected = flexible_mode(antenna).damping_ratio;
  auto& check = begin_check(found, "resonance_damping", "resonance.damping_ratio");
  check.add("measured", antenna.resonance->damping->value, "1", expected / agrees,
            expected * agrees);
  check.add("expected", expected, "1");
}

void check_wave_speeds(const Case& antenna, PhysicalChecks& found) {
  struct Wave {
    std::string id;
    double speed, uncertainty;
    bool restated;
  };
  std::vector<Wave> waves;
  const auto add = [&](const OilLine& line, const Quantity& frequency, bool restated) {
    const double speed = 2.0 * line.length.value * frequency.value;
    const double relative =
        std::hypot(relative_uncertainty(line.length), relative_uncertainty(line.slosh_frequency));
    waves.push_back({"line." + line.name + ".slosh_frequency", speed, speed * relative, restated});
  };
  for (const OilLine& line : antenna.oil->lines) {
    add(line, line.slosh_frequency, false);
    for (const StatedEntry& stated : antenna.stated) {
      if (stated.quantity == waves.back().id) add(line, stated.value, true);
    }
  }
  for (std::size_t i = 0; i < waves.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const bool same_line = waves[i].id == waves[k].id;
      if (waves[k].restated || waves[i].restated != same_line) continue;
      const double allowed = 2.0 * std::hypot(waves[i].uncertainty, waves[k].uncertainty);
      const auto name = [](const Wave& wave) {
        return wave.id + (wave.restated ? " as printed again" : "");
      };
      auto& check = begin_check(found, "wave_speed", waves[i].id);
      check.add(name(waves[k]), waves[k].speed, "m/s");
      check.add(name(waves[i]), waves[i].speed, "m/s", waves[k].speed - allowed,
                waves[k].speed + allowed);
    }
  }
}

}  // namespace boresight::io
