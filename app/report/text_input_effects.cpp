#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <boresight/app/redesign/input_effects.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/app/report/text_input_effects.hpp>

namespace boresight::app {
namespace {

std::string mdeg(double angle) {
  return std::isfinite(angle) ? fmt::format("{:.4f}", angle / millidegree) : "unstable";
}

// By how much it is changed.
std::string moved_text(const InputEffect& effect) {
  const char* mark = effect.unstated ? "*" : "";
  if (effect.range) {
    return fmt::format("{:.3g} .. {:.3g}{}", effect.range->first, effect.range->second, mark);
  }
  return fmt::format("{:.3g} %{}", 100.0 * effect.moved_by / std::abs(effect.quantity.value), mark);
}

}  // namespace

Document input_effects_part(const TuningSection& section) {
  if (section.input_effects.empty()) return {};
  Document text =
      essential(subheading("Rms with one input changed, gains fixed (* a range assumed)"));
  text += wrapped(
      "Each input is changed alone: by its standard uncertainty, or by 10 % (*) if it is assumed "
      "and none is stated. An assumed wind or boresight fraction (*, with its range) is changed to "
      "its body's inertia fraction and as far the other way, by half of it at least. The other "
      "fractions are rescaled so that they sum to 1. Structural frequencies stay fixed, so a "
      "lighter antenna is softer.",
      "  ");
  std::vector<std::vector<std::string>> rows{
      {"input", "basis", "value", "changed by", "rms mdeg, lower", "higher"}};
  for (const auto& effect : section.input_effects) {
    const io::Quantity& quantity = effect.quantity;
    rows.push_back({quantity.key, std::string(to_string(quantity.basis)), quantity.text,
                    moved_text(effect), mdeg(effect.low_rms), mdeg(effect.high_rms)});
  }
  const auto range = combined_range(section.input_effects, section.design.boresight_rms);
  constexpr std::size_t first = 8;
  return text + shortened(essential(table(rows, "lllrrr")), first) +
         wrapped(fmt::format("All of these in quadrature: {} to {} mdeg.", mdeg(range.lower),
                             mdeg(range.upper)),
                 "  ");
}

}  // namespace boresight::app
