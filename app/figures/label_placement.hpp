#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace boresight::app {

/// A rectangle of the drawing, y downwards.
struct Box {
  double left = 0.0, top = 0.0, right = 0.0, bottom = 0.0;
};

/// A possible place of a label; a lower penalty, of the order of 1, is better.
struct LabelPlace {
  Box box;
  double penalty = 0.0;
};

/// Chooses places for labels, one after the other, within a rectangle: never over another label,
/// and over as little of the curves as can be.
class LabelPlacement {
 public:
  explicit LabelPlacement(const Box& within);

  /// Ink on the way from one point to another.
  void avoid_segment(double x0, double y0, double x1, double y1);
  void avoid(const Box& box) { taken_.push_back(box); }

  /// The index of the best place, which is occupied from then on; none if every place overlaps
  /// another label or lies outside.
  std::optional<std::size_t> place(const std::vector<LabelPlace>& places);

 private:
  double ink(const Box& box) const;
  std::uint8_t* cell(double x, double y);

  Box within_;
  int columns_ = 0, rows_ = 0;
  std::vector<std::uint8_t> ink_;
  std::vector<Box> taken_;
};

}  // namespace boresight::app
