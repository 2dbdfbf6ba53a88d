#include <algorithm>

#include <boost/math/special_functions/legendre.hpp>

#include <boresight/control/loops/panel_rule.hpp>
#include <boresight/numerics/gauss_rule.hpp>

namespace boresight::control {
namespace {

constexpr std::size_t size = numerics::pack_size;

PanelRule make_rule() {
  PanelRule rule{};
  const numerics::GaussRule gauss = numerics::gauss_rule(size);
  std::ranges::copy(gauss.node, rule.node.begin());
  std::ranges::copy(gauss.weight, rule.weight.begin());
  std::ranges::copy(gauss.barycentric, rule.barycentric.begin());
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t k = 0; k < 4; ++k) {
      const auto order = static_cast<int>(k) + 4;
      rule.tail[i].set(k, 0.5 * (2.0 * order + 1.0) * boost::math::legendre_p(order, rule.node[i]));
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
