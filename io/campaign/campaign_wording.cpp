#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include <boresight/io/campaign/campaign_wording.hpp>

namespace boresight::io {

ShownUnit shown_unit(const std::string& unit) {
  if (unit == "Pa") return {"MPa", 1e-6};
  if (unit == "s") return {"ms", 1e3};
  if (unit.empty() || unit == "1") return {"1", 1.0};
  std::string name = unit;
  std::replace(name.begin(), name.end(), ' ', '.');
  return {std::move(name), 1.0};
}

std::string significant(double value) {
  return std::isfinite(value) ? fmt::format("{:.4g}", value) : "inf";
}

std::string range(const numerics::Interval& interval, double scale) {
  return fmt::format("{} .. {}", significant(scale * interval.lower),
                     significant(scale * interval.upper));
}

bool advised_quantity(std::string_view name) {
  constexpr std::array<std::string_view, 4> advised{"inertia", "oil stiffness", "leakage rate",
                                                    "Coulomb level"};
  return std::find(advised.begin(), advised.end(), name) != advised.end();
}

std::vector<const identification::GreyBoxInformationGain*> ranked(
    const std::vector<identification::GreyBoxInformationGain>& gains, std::size_t quantity) {
  std::vector<const identification::GreyBoxInformationGain*> sorted;
  sorted.reserve(gains.size());
  for (const auto& gain : gains) sorted.push_back(&gain);
  std::stable_sort(sorted.begin(), sorted.end(), [&](const auto* a, const auto* b) {
    return a->remaining[quantity] < b->remaining[quantity];
  });
  return sorted;
}

}  // namespace boresight::io
