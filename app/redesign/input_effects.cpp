#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/redesign/input_effects.hpp>
#include <boresight/app/report/influences.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_structure.hpp>
#include <boresight/io/case/mission_of.hpp>
#include <boresight/io/case/structure_numbers.hpp>

namespace boresight::app {
namespace {

std::string mode_text(const io::StructureEntry& structure, const io::MovableNumber& number) {
  if (!number.fraction_of_mode) return "";
  return fmt::format(
      "the mode of {:.3g} Hz{}",
      io::structure_specification(structure).modes.at(*number.fraction_of_mode).frequency,
      structure.motors_held ? " with the bull gear locked" : "");
}

std::string range_text(const InputEffect& effect) {
  const auto mdeg = [](double rms) {
    return std::isfinite(rms) ? fmt::format("{:.3f}", rms / millidegree) : std::string("unstable");
  };
  const double fraction = 100.0 * effect.moved_by / std::abs(effect.quantity.value);
  const std::string over =
      effect.range ? fmt::format("{:.3g} to {:.3g}", effect.range->first, effect.range->second)
                   : fmt::format("+-{:.3g} %", fraction);
  return fmt::format("{}{}{} ({} to {} mdeg over {})", effect.quantity.key,
                     effect.mode.empty() ? "" : " of ", effect.mode, mdeg(effect.low_rms),
                     mdeg(effect.high_rms), over);
}

}  // namespace

double telling_friction(const std::optional<TimeDomainSection>& time_domain, double rms) {
  if (!time_domain) return 0.0;
  for (const auto& one : time_domain->result.wind.influences) {
    if (one.influence != design::Influence::friction || !std::isfinite(one.difference)) continue;
    if (one.difference > telling_change * rms) return one.difference;
  }
  return 0.0;
}

std::vector<InputEffect> input_effects(const io::Case& antenna,
                                       const control::Controller& controller,
                                       const design::Constraints& goals, double rms,
                                       std::size_t maximum, unsigned threads) {
  const auto numbers = movable_numbers(antenna);
  std::vector<design::MovedNumber> moved_numbers;
  for (const auto& number : numbers) {
    const auto to = [&antenna, &number](bool upwards) {
      return [&antenna, &number, upwards] { return make_problem(moved(antenna, number, upwards)); };
    };
    moved_numbers.push_back({to(false), to(true)});
  }
  std::vector<InputEffect> effects;
  for (const auto& effect :
       number_effects(moved_numbers, controller, goals, rms, maximum, threads)) {
    const io::MovableNumber& number = numbers[effect.number];
    effects.push_back({number, effect, mode_text(*antenna.structure, number)});
  }
  return effects;
}

design::RmsRange combined_range(const std::vector<InputEffect>& effects, double rms) {
  return design::combined_range({effects.begin(), effects.end()}, rms);
}

std::string measure_first(const std::vector<InputEffect>& effects, double rms,
                          const std::optional<TimeDomainSection>& time_domain,
                          bool friction_measured) {
  constexpr std::size_t maximum = 3;
  std::vector<std::string> named;
  for (const auto& effect : effects) {
    if (named.size() == maximum || effect.change(rms) < negligible_change) break;
    named.push_back(range_text(effect));
  }
  std::vector<std::string> sentences;
  if (!named.empty()) {
    sentences.push_back(fmt::format("The rms depends most on {}: measure {} first.",
                                    fmt::join(named, ", "), named.size() == 1 ? "that" : "those"));
  }
  const double friction = friction_measured ? 0.0 : telling_friction(time_domain, rms);
  if (friction > 0.0) {
    sentences.push_back(
        fmt::format("Friction adds {:.3f} mdeg in simulation: measure the friction curve about the "
                    "tracking rate and the bristle stiffness.",
                    friction / millidegree));
  }
  return fmt::format("{}", fmt::join(sentences, " "));
}

}  // namespace boresight::app
