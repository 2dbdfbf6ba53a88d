#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <boresight/io/audit/resonance_verdict.hpp>
#include <boresight/io/case/antenna_of.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_mechanics.hpp>
#include <boresight/io/case/case_motor.hpp>
#include <boresight/io/case/case_structure.hpp>
#include <boresight/io/case/case_tests.hpp>
#include <boresight/io/case/drive_evidence.hpp>
#include <boresight/io/case/member_ranges.hpp>
#include <boresight/io/case/plant_numbers.hpp>
#include <boresight/io/case/resonating_mode.hpp>
#include <boresight/plant/antenna/antenna_change.hpp>

namespace boresight::io {
namespace {

double resonance(const Case& antenna, const std::vector<plant::AntennaChange>& changes) {
  return resonating_mode(antenna, make_plant(antenna, changes)).frequency;
}

// Where the frequency passes through the wanted one between two factors; nothing where it jumps
// over it, as the mode's place passes to another.
std::optional<double> crossing(const Case& antenna, double frequency, double lower, double upper) {
  const auto above = [&](double factor) {
    return resonance(antenna, bulk_modulus_times(antenna, factor)) > frequency;
  };
  const bool above_lower = above(lower);
  if (above(upper) == above_lower) return std::nullopt;
  constexpr int halvings = 40;
  for (int i = 0; i < halvings; ++i) {
    const double middle = std::sqrt(lower * upper);
    (above(middle) == above_lower ? lower : upper) = middle;
  }
  const double found = resonance(antenna, bulk_modulus_times(antenna, lower));
  constexpr double same = 1e-6;
  return std::abs(found / frequency - 1.0) < same ? std::optional(lower) : std::nullopt;
}

double expected_uncertainty(const Case& antenna, double expected) {
  const auto stiffness =
      identification::identify_inertia(make_evidence(antenna), {1000, 1}).oil_stiffness;
  const double oil = stiffness.standard_uncertainty / stiffness.value;
  const auto upward = [](const Quantity& quantity) { return 1.0 + relative_uncertainty(quantity); };
  double variance = 0.0;
  const std::vector<std::vector<plant::AntennaChange>> all{
      bulk_modulus_times(antenna, 1.0 + oil),
      {plant::scaled_by("at_shaft.antenna_inertia", upward(antenna.antenna->inertia))},
      {plant::scaled_by("at_shaft.motor_inertia", upward(antenna.motor->inertia))},
      {plant::scaled_by("structure.frequencies",
                        upward(antenna.structure->locked_rotor_frequency))}};
  for (const auto& moved : all) {
    variance += std::pow(resonance(antenna, moved) - expected, 2);
  }
  return std::sqrt(variance);
}

}  // namespace

double ResonanceVerdict::deviation() const {
  return std::abs(measured - expected) / standard_uncertainty;
}

bool ResonanceVerdict::contradicts() const {
  return deviation() > contradicting_deviation;
}

std::optional<double> bulk_modulus_for(const Case& antenna, double frequency) {
  constexpr double farthest = 30.0;
  constexpr int steps = 20;  // to either side
  const double step = std::pow(farthest, 1.0 / steps);
  // From the case's own outwards: of several the nearest.
  for (int i = 0; i < steps; ++i) {
    const double inner = std::pow(step, i), outer = std::pow(step, i + 1);
    for (const auto& [lower, upper] : {std::pair{inner, outer}, {1.0 / outer, 1.0 / inner}}) {
      if (const auto factor = crossing(antenna, frequency, lower, upper)) {
        return *factor * bulk_modulus(antenna);
      }
    }
  }
  return std::nullopt;
}

std::optional<ResonanceVerdict> resonance_verdict(const Case& antenna) {
  if (!antenna.resonance->frequency) return std::nullopt;
  ResonanceVerdict verdict;
  verdict.measured = antenna.resonance->frequency->value;
  const plant::AntennaPlant plant = make_plant(antenna);
  verdict.of_oil = antenna.resonance->of_oil;
  verdict.rigid = rings_as_rigid(antenna);
  verdict.mode = resonating_mode(antenna, plant);
  verdict.oil_mode = plant::mode_of_oil(plant::plant_modes(plant));
  verdict.expected = verdict.mode.frequency;
  verdict.standard_uncertainty = std::hypot(antenna.resonance->frequency->standard_uncertainty,
                                            expected_uncertainty(antenna, verdict.expected));
  verdict.stated_bulk_modulus = bulk_modulus(antenna);
  verdict.bulk_modulus = bulk_modulus_for(antenna, verdict.measured);
  const auto oil = member_ranges(antenna).oil_stiffness;
  verdict.min_oil = oil.lower;
  verdict.max_oil = oil.upper;
  return verdict;
}

std::optional<ResonanceVerdict> resonance_verdict(const DesignedAntenna& designed) {
  if (designed.from_records) return std::nullopt;
  return resonance_verdict(designed.antenna);
}

}  // namespace boresight::io
