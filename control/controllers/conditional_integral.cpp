#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include <boresight/control/controllers/conditional_integral.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::control {
namespace {

bool is_position_integral(const LoopBlock& block) {
  return block.path == LoopPath::position && block.kind == BlockKind::integral;
}

}  // namespace

std::optional<ConditionalIntegral> conditional_integral(const Controller& controller) {
  validate(controller);
  if (!controller.structure.has_conditional_integral()) return std::nullopt;
  ConditionalIntegral integral;
  std::size_t k = 0;
  for (const LoopBlock& block : controller.structure.blocks()) {
    if (is_integral_condition(block.kind)) {
      integral.condition = block.kind;
      integral.width = controller.gains[k];
    }
    if (is_position_integral(block)) integral.corner = controller.gains[k];
    k += block.gains.size();
  }
  return integral;
}

double conditional_input(const ConditionalIntegral& integral, double x) {
  if (integral.condition == BlockKind::freeze) return std::abs(x) < integral.width ? 0.0 : x;
  return x - std::clamp(x, -integral.width, integral.width);
}

double describing_function(const ConditionalIntegral& integral, double amplitude) {
  if (!(amplitude > integral.width)) return 0.0;
  const double ratio = integral.width / amplitude;
  const double product = ratio * std::sqrt(1.0 - ratio * ratio);
  const double sign = integral.condition == BlockKind::freeze ? -1.0 : 1.0;
  return 1.0 - 2.0 / std::numbers::pi * (std::asin(ratio) + sign * product);
}

void set_linear_equivalent(const Controller& controller, double amplitude, Controller& equivalent) {
  equivalent = controller;
  const auto integral = conditional_integral(controller);
  if (!integral) return;
  std::size_t k = 0;
  for (const LoopBlock& block : controller.structure.blocks()) {
    if (is_position_integral(block)) {
      equivalent.gains[k] *= std::max(describing_function(*integral, amplitude), held_fraction);
    }
    k += block.gains.size();
  }
}

Controller linear_equivalent(const Controller& controller, double amplitude) {
  const auto integral = conditional_integral(controller);
  if (integral && describing_function(*integral, amplitude) == 0.0) {
    return without_conditional_integral(controller);
  }
  Controller equivalent;
  set_linear_equivalent(controller, amplitude, equivalent);
  return equivalent;
}

Controller without_conditional_integral(const Controller& controller) {
  if (!conditional_integral(controller)) {
    throw InvalidInput(fmt::format(
        "without_conditional_integral: expected a dead zone or freeze, found none in {}",
        controller.structure.name()));
  }
  std::vector<LoopBlock> blocks;
  std::vector<double> gains;
  std::size_t k = 0;
  for (const LoopBlock& block : controller.structure.blocks()) {
    if (!is_integral_condition(block.kind) && !is_position_integral(block)) {
      blocks.push_back(block);
      const auto first = controller.gains.begin() + static_cast<std::ptrdiff_t>(k);
      gains.insert(gains.end(), first, first + static_cast<std::ptrdiff_t>(block.gains.size()));
    }
    k += block.gains.size();
  }
  return {LoopStructure(controller.structure.name() + ", integral held", std::move(blocks)), gains};
}

ConditionalIntegrator::ConditionalIntegrator(const ConditionalIntegral& integral,
                                             double sample_time)
    : integral_(integral), step_(integral.corner * sample_time) {}

double ConditionalIntegrator::with_integral(double x) const {
  return x + (state_ + 0.5 * step_ * conditional_input(integral_, x));
}

void ConditionalIntegrator::advance(double x) {
  state_ = state_ + step_ * conditional_input(integral_, x);
}

}  // namespace boresight::control
