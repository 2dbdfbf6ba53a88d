#include <algorithm>
#include <cmath>

#include <boresight/app/figures/label_placement.hpp>

namespace boresight::app {
namespace {

constexpr double cell_size = 3.0;
constexpr double maximum = 4000.0;  // pixels of a segment that are looked at

bool overlap(const Box& a, const Box& b) {
  return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
}

}  // namespace

LabelPlacement::LabelPlacement(const Box& within)
    : within_(within),
      columns_(std::max(1, static_cast<int>(std::ceil((within.right - within.left) / cell_size)))),
      rows_(std::max(1, static_cast<int>(std::ceil((within.bottom - within.top) / cell_size)))),
      ink_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {}

std::uint8_t* LabelPlacement::cell(double x, double y) {
  const double column = std::floor((x - within_.left) / cell_size);
  const double row = std::floor((y - within_.top) / cell_size);
  if (column < 0.0 || column >= columns_ || row < 0.0 || row >= rows_) return nullptr;
  return &ink_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
               static_cast<std::size_t>(column)];
}

void LabelPlacement::avoid_segment(double x0, double y0, double x1, double y1) {
  const double length = std::hypot(x1 - x0, y1 - y0);
  if (!std::isfinite(length)) return;
  const int steps = static_cast<int>(std::ceil(std::min(length, maximum) / (0.7 * cell_size)));
  for (int i = 0; i <= steps; ++i) {
    const double along = steps == 0 ? 0.0 : static_cast<double>(i) / steps;
    if (auto* const here = cell(x0 + along * (x1 - x0), y0 + along * (y1 - y0))) *here = 1;
  }
}

double LabelPlacement::ink(const Box& box) const {
  const auto index = [](double distance, int count) {
    return static_cast<std::size_t>(
        std::clamp(static_cast<int>(std::floor(distance / cell_size)), 0, count - 1));
  };
  const std::size_t left = index(box.left - within_.left, columns_);
  const std::size_t right = index(box.right - within_.left, columns_);
  const std::size_t top = index(box.top - within_.top, rows_);
  const std::size_t bottom = index(box.bottom - within_.top, rows_);
  double sum = 0.0;
  for (std::size_t row = top; row <= bottom; ++row) {
    for (std::size_t column = left; column <= right; ++column) {
      sum += ink_[row * static_cast<std::size_t>(columns_) + column];
    }
  }
  return sum;
}

std::optional<std::size_t> LabelPlacement::place(const std::vector<LabelPlace>& places) {
  std::optional<std::size_t> best;
  double minimum = 0.0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Box& box = places[i].box;
    if (box.left < within_.left || box.right > within_.right || box.top < within_.top ||
        box.bottom > within_.bottom) {
      continue;
    }
    const bool free = std::none_of(taken_.begin(), taken_.end(),
                                   [&](const Box& other) { return overlap(box, other); });
    if (!free) continue;
    const double cost = places[i].penalty + 0.5 * ink(box);
    if (!best || cost < minimum) {
      best = i;
      minimum = cost;
    }
  }
  if (best) taken_.push_back(places[*best].box);
  return best;
}

}  // namespace boresight::app
