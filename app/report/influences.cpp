#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/report/influences.hpp>

namespace boresight::app {

void Influences::add(double change, std::string what) {
  if (std::isfinite(change) && change > negligible_change) {
    changes_.emplace_back(change, std::move(what));
  }
}

std::string Influences::sentence() const {
  if (changes_.empty()) return "";
  auto sorted = changes_;
  std::ranges::stable_sort(sorted, std::greater{}, [](const auto& change) { return change.first; });
  std::vector<std::string> texts;
  for (const auto& [change, what] : sorted) {
    if (texts.size() == 3) break;
    texts.push_back(fmt::format("{} (by {:.0f} %)", what, 100.0 * change));
  }
  return fmt::format(" The rms depends more on {}.", fmt::join(texts, ", "));
}

}  // namespace boresight::app
