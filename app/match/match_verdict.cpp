#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <boresight/app/match/match_verdict.hpp>
#include <boresight/app/report/influences.hpp>

namespace boresight::app {

double span_of(const MatchSeries& series) {
  double least = HUGE_VAL, largest = 0.0;
  for (const auto& value : series.values) {
    if (!value.found) continue;
    least = std::min(least, value.beam_rms);
    largest = std::max(largest, value.beam_rms);
  }
  return largest > 0.0 ? largest / least - 1.0 : 0.0;
}

bool hardly_matters(const MatchSection& section) {
  bool any = false;
  for (const auto& series : section.series) {
    const auto found = std::ranges::count_if(series.values, &MatchValue::found);
    if (found == 0) continue;
    any = true;
    if (found != std::ssize(series.values) || span_of(series) >= negligible_change) return false;
  }
  return any;
}

std::string what_matters_more(const MatchSection& section) {
  Influences influences;
  const MatchValue* least = nullptr;
  const MatchValue* largest = nullptr;
  for (const auto& series : section.series) {
    const MatchValue& value = series.values[as_built(section)];
    if (!value.found || hunts(section, series)) continue;
    if (least == nullptr || value.beam_rms < least->beam_rms) least = &value;
    if (largest == nullptr || value.beam_rms > largest->beam_rms) largest = &value;
  }
  if (least != nullptr && largest != nullptr) {
    influences.add(largest->beam_rms / least->beam_rms - 1.0, "the loop structure");
  }
  for (const auto& variants : section.variants) {
    const MatchVariant& own = variants.variants.front();
    if (!own.best) continue;
    for (const auto& variant : variants.variants) {
      if (!variant.best) continue;
      influences.add(std::abs(variant.rms[*variant.best] / own.rms[*own.best] - 1.0),
                     fmt::format("'{}' with {}", variant.name, variants.structure));
    }
  }
  return influences.sentence();
}

std::vector<design::HuntingResult> hunting_of(const MatchSection& section,
                                              const MatchSeries& series) {
  const std::size_t built = as_built(section);
  const std::size_t best = series.best.value_or(built);
  const auto& run = series.values[series.values[best].time_domain ? best : built].time_domain;
  return run ? run->hunting : std::vector<design::HuntingResult>();
}

bool hunts(const MatchSection& section, const MatchSeries& series) {
  return !design::holds_still(hunting_of(section, series), section.tightest_budget);
}

bool one_friction(const MatchSection& section) {
  constexpr double same = 1e-9;
  return std::abs(section.tracking_friction - section.friction) <= same * section.friction;
}

std::size_t as_built(const MatchSection& section) {
  const auto point = std::ranges::find_if(section.points, [](const MatchPoint& one) {
    return one.label.find("as built") != std::string::npos;
  });
  return point == section.points.end() ? section.points.size() - 1
                                       : static_cast<std::size_t>(point - section.points.begin());
}

}  // namespace boresight::app
