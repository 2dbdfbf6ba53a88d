#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/match/match_verdict.hpp>
#include <boresight/app/report/negligible.hpp>

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
  std::vector<std::pair<double, std::string>> moves;
  const auto add = [&](double change, std::string what) {
    if (std::isfinite(change) && change > negligible_change) {
      moves.emplace_back(change, std::move(what));
    }
  };
  const MatchValue* least = nullptr;
  const MatchValue* largest = nullptr;
  for (const auto& series : section.series) {
    const MatchValue& value = series.values[as_built(section)];
    if (!value.found) continue;
    if (least == nullptr || value.beam_rms < least->beam_rms) least = &value;
    if (largest == nullptr || value.beam_rms > largest->beam_rms) largest = &value;
  }
  if (least != nullptr && largest != nullptr) {
    add(largest->beam_rms / least->beam_rms - 1.0, "the loop structure");
  }
  for (const auto& variants : section.variants) {
    const MatchVariant& own = variants.variants.front();
    if (!own.best) continue;
    for (const auto& variant : variants.variants) {
      if (!variant.best) continue;
      add(std::abs(variant.rms[*variant.best] / own.rms[*own.best] - 1.0),
          fmt::format("'{}' with {}", variant.name, variants.structure));
    }
  }
  if (moves.empty()) return "";
  std::ranges::stable_sort(moves, std::greater{}, [](const auto& move) { return move.first; });
  std::vector<std::string> texts;
  for (const auto& [change, what] : moves) {
    if (texts.size() == 3) break;
    texts.push_back(fmt::format("{} (by {:.0f} %)", what, 100.0 * change));
  }
  return fmt::format(" More hangs on {}.", fmt::join(texts, ", "));
}

std::size_t as_built(const MatchSection& section) {
  const auto point = std::ranges::find_if(section.points, [](const MatchPoint& one) {
    return one.label.find("as built") != std::string::npos;
  });
  return point == section.points.end() ? section.points.size() - 1
                                       : static_cast<std::size_t>(point - section.points.begin());
}

}  // namespace boresight::app
