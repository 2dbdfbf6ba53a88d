#include <boresight/numerics/golden_section.hpp>

namespace boresight::numerics {

double golden_section_maximum(const std::function<double(double)>& value, double low, double high,
                              double tolerance) {
  constexpr double golden = 0.6180339887498949;
  double left = high - golden * (high - low), right = low + golden * (high - low);
  double at_left = value(left), at_right = value(right);
  while (high - low > tolerance) {
    if (at_left < at_right) {
      low = left;
      left = right;
      at_left = at_right;
      right = low + golden * (high - low);
      at_right = value(right);
    } else {
      high = right;
      right = left;
      at_right = at_left;
      left = high - golden * (high - low);
      at_left = value(left);
    }
  }
  return 0.5 * (low + high);
}

}  // namespace boresight::numerics
