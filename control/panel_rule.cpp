#include <cmath>
#include <numbers>

#include <boresight/control/panel_rule.hpp>

namespace boresight::control {
namespace {

constexpr std::size_t size = plant::pack_size;

// P_0 to P_size at x.
std::array<double, size + 1> legendre(double x) {
  std::array<double, size + 1> p{1.0, x};
  for (std::size_t k = 1; k < size; ++k) {
    const auto degree = static_cast<double>(k);
    p[k + 1] = ((2.0 * degree + 1.0) * x * p[k] - degree * p[k - 1]) / (degree + 1.0);
  }
  return p;
}

PanelRule make_rule() {
  PanelRule rule{};
  constexpr auto n = static_cast<double>(size);
  for (std::size_t i = 0; i < size; ++i) {
    double x = -std::cos(std::numbers::pi * (static_cast<double>(i) + 0.75) / (n + 0.5));
    double slope = 0.0;
    for (int step = 0; step < 8; ++step) {
      const auto p = legendre(x);
      slope = n * (x * p[size] - p[size - 1]) / (x * x - 1.0);
      x -= p[size] / slope;
    }
    rule.node[i] = x;
    rule.weight[i] = 2.0 / ((1.0 - x * x) * slope * slope);
    const double sign = i % 2 == 0 ? 1.0 : -1.0;
    rule.barycentric[i] = sign * std::sqrt((1.0 - x * x) * rule.weight[i]);
    const auto p = legendre(x);
    for (std::size_t k = 0; k < 4; ++k) {
      const double value = 0.5 * (2.0 * static_cast<double>(k + 4) + 1.0) * p[k + 4];
      rule.first_tail[i].set(k, value);
      rule.second_tail[i].set(k + 4, value);
    }
  }
  return rule;
}

}  // namespace

const PanelRule& panel_rule() {
  static const PanelRule rule = make_rule();
  return rule;
}

}  // namespace boresight::control
