#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <boresight/app/redesign/oil_remark.hpp>
#include <boresight/app/redesign/resonance_verdict.hpp>
#include <boresight/io/case/antenna_of.hpp>
#include <boresight/io/case/drive_evidence.hpp>
#include <boresight/io/case/member_ranges.hpp>
#include <boresight/io/case/plant_numbers.hpp>
#include <boresight/io/case/resonating_mode.hpp>
#include <boresight/plant/antenna/antenna_change.hpp>

namespace boresight::app {
namespace {

constexpr double gigapascal = 1e9;  // Pa

double resonance(const io::Case& antenna, const std::vector<plant::AntennaChange>& changes) {
  return resonating_mode(antenna, make_plant(antenna, changes)).frequency;
}

// Where the frequency passes through the wanted one between two factors; nothing where it jumps
// over it, as the mode's place passes to another.
std::optional<double> crossing(const io::Case& antenna, double frequency, double lower,
                               double upper) {
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

double expected_uncertainty(const io::Case& antenna, double expected) {
  const auto stiffness =
      identification::identify_inertia(make_evidence(antenna), {1000, 1}).oil_stiffness;
  const double oil = stiffness.standard_uncertainty / stiffness.value;
  const auto upward = [](const io::Quantity& quantity) {
    return 1.0 + io::relative_uncertainty(quantity);
  };
  double variance = 0.0;
  const std::vector<std::vector<plant::AntennaChange>> all{
      bulk_modulus_times(antenna, 1.0 + oil),
      {plant::scaled_by("at_shaft.antenna_inertia", upward(antenna.antenna.inertia))},
      {plant::scaled_by("at_shaft.motor_inertia", upward(antenna.motor.inertia))},
      {plant::scaled_by("structure.frequencies",
                        upward(antenna.structure.locked_rotor_frequency))}};
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
  return deviation() > 3.0;
}

std::optional<double> bulk_modulus_for(const io::Case& antenna, double frequency) {
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

std::optional<ResonanceVerdict> resonance_verdict(const io::Case& antenna) {
  if (!antenna.resonance_frequency) return std::nullopt;
  ResonanceVerdict verdict;
  verdict.measured = antenna.resonance_frequency->value;
  const plant::AntennaPlant plant = make_plant(antenna);
  verdict.of_oil = antenna.resonance_of_oil;
  verdict.rigid = rings_as_rigid(antenna);
  verdict.mode = resonating_mode(antenna, plant);
  verdict.oil_mode = plant::mode_of_oil(plant::plant_modes(plant));
  verdict.expected = verdict.mode.frequency;
  verdict.standard_uncertainty = std::hypot(antenna.resonance_frequency->standard_uncertainty,
                                            expected_uncertainty(antenna, verdict.expected));
  verdict.stated_bulk_modulus = bulk_modulus(antenna);
  verdict.bulk_modulus = bulk_modulus_for(antenna, verdict.measured);
  const auto oil = member_ranges(antenna).oil_stiffness;
  verdict.least_oil = oil.lower;
  verdict.most_oil = oil.upper;
  return verdict;
}

std::optional<ResonanceVerdict> resonance_verdict(const io::DesignedAntenna& designed) {
  if (designed.from_records) return std::nullopt;
  return resonance_verdict(designed.antenna);
}

std::string which_was_measured(const ResonanceVerdict& verdict) {
  const std::string remark = verdict.of_oil ? "" : oil_remark(verdict.mode, verdict.oil_mode);
  return remark.empty() ? ""
                        : remark + " Make sure which of them was measured; resonance.mode says it.";
}

// Beyond so many the first order of the uncertainty says no more than that.
constexpr double most_by_first_order = 5.0;

std::string resonance_sentence(const ResonanceVerdict& verdict) {
  const double own = verdict.stated_bulk_modulus / gigapascal;
  const std::string modulus =
      verdict.bulk_modulus
          ? fmt::format(
                "a bulk modulus of {:.3g} GPa in the place of {:.3g} would make it, all "
                "else as the case has it",
                *verdict.bulk_modulus / gigapascal, own)
          : fmt::format("no bulk modulus within a factor of 30 of the case's {:.3g} GPa makes it",
                        own);
  return fmt::format(
      "The hydraulic frequency measured, {:.3g} Hz, {} the {:.3g} Hz of the case's flexible "
      "antenna{} ({} standard uncertainties apart): {}.{}",
      verdict.measured, verdict.contradicts() ? "contradicts" : "does not contradict",
      verdict.expected, verdict.of_oil ? ", in its mode of most oil" : "",
      verdict.deviation() > most_by_first_order ? fmt::format("more than {:g}", most_by_first_order)
                                                : fmt::format("{:.3g}", verdict.deviation()),
      modulus, which_was_measured(verdict));
}

std::string resonance_warning(const std::optional<ResonanceVerdict>& verdict) {
  if (!verdict || !verdict->contradicts()) return "";
  std::string text = resonance_sentence(*verdict);
  if (!verdict->bulk_modulus) return text;
  const double wanted = *verdict->bulk_modulus / verdict->stated_bulk_modulus;
  constexpr double same = 0.01;
  if (wanted >= verdict->least_oil * (1.0 - same) && wanted <= verdict->most_oil * (1.0 + same)) {
    return text;
  }
  return text + fmt::format(
                    " The plants that laws are held on here have {:.3g} to {:.3g} times the case's "
                    "oil stiffness, and that would be {:.3g} times: none of them is the antenna "
                    "that was measured.",
                    verdict->least_oil, verdict->most_oil, wanted);
}

std::string unread_resonance(const std::optional<ResonanceVerdict>& verdict) {
  if (!verdict || verdict->rigid) return "";
  return fmt::format(
      "No inertia is read off the {:.3g} Hz measured: they are not those of the whole antenna, "
      "rigid, on the oil spring.",
      verdict->measured);
}

std::string rigid_resonance_remark(const std::optional<ResonanceVerdict>& verdict,
                                   const identification::InertiaMethod& least,
                                   const identification::InertiaMethod& most) {
  constexpr auto resonance = identification::MethodKind::resonance;
  const bool of_rigid = least.kind == resonance || most.kind == resonance;
  if (!of_rigid || !verdict || verdict->contradicts()) return "";
  return "; the resonance's figure is of a rigid antenna, and the flexible one does not contradict "
         "the masses";
}

}  // namespace boresight::app
