#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reference_antenna.hpp"
#include "refused_call.hpp"
#include <boresight/control/controllers/antenna_controller.hpp>
#include <boresight/control/controllers/conditional_integral.hpp>
#include <boresight/control/controllers/sampled_controller.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/linear/interconnection.hpp>

namespace boresight::control {
namespace {

using Eigen::VectorXd;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double sample_time = 0.02;

// In the middle of the bounds, with this width.
Controller with_width(const std::string& structure, double width) {
  Controller controller{LoopStructure::named(structure), {}};
  for (const auto& gain : controller.structure.gains()) {
    const bool is_width = gain.symbol == "dzp" || gain.symbol == "fzp";
    controller.gains.push_back(is_width ? width : std::sqrt(gain.lower * gain.upper));
  }
  return controller;
}

const std::vector<std::string>& names() {
  static const std::vector<std::string> all{"PI-0+D", "FULL+F", "LL+L+D", "DPF+L+F+N",
                                            "FULL+L+D+C"};
  return all;
}

// The fundamental of f over a sine, by the midpoint rule.
double measured_describing_function(const ConditionalIntegral& integral, double amplitude) {
  constexpr int points = 200000;
  double sum = 0.0;
  for (int i = 0; i < points; ++i) {
    const double sine = std::sin(2.0 * std::numbers::pi * (i + 0.5) / points);
    sum += conditional_input(integral, amplitude * sine) * sine;
  }
  return 2.0 * sum / points / amplitude;
}

TEST(ConditionalIntegral, HasTheDescribingFunctionOfItsSimulation) {
  for (const BlockKind kind : {BlockKind::dead_zone, BlockKind::freeze}) {
    const ConditionalIntegral integral{kind, 0.3, 1.0};
    for (const double ratio : {0.5, 1.0, 1.01, 1.2, 2.0, 5.0, 100.0}) {
      const double found = describing_function(integral, 0.3 * ratio);
      EXPECT_NEAR(found, measured_describing_function(integral, 0.3 * ratio), 2e-5) << ratio;
      EXPECT_TRUE(ratio > 1.0 || found == 0.0) << ratio;
    }
    EXPECT_NEAR(describing_function(integral, 3e6), 1.0, 1e-6);
  }
  // A freeze takes the whole of what a dead zone takes a part of.
  EXPECT_GT(describing_function({BlockKind::freeze, 1.0, 1.0}, 2.0),
            1.5 * describing_function({BlockKind::dead_zone, 1.0, 1.0}, 2.0));
}

// The sampled integral in a sine: its fundamental is that of corner/s times the function, turned by
// no more than rounding, as the trapezoidal rule lags by 90 degrees exactly.
TEST(ConditionalIntegrator, IntegratesTheFundamentalOfItsInput) {
  const ConditionalIntegral integral{BlockKind::dead_zone, 0.2, 0.7};
  const double amplitude = 0.5;
  constexpr int samples = 4000;
  const double w = 2.0 * std::numbers::pi / (samples * sample_time);
  ConditionalIntegrator integrator(integral, sample_time);
  double sine = 0.0, cosine = 0.0;
  for (int k = 0; k < samples; ++k) {
    const double angle = w * sample_time * k;
    const double x = amplitude * std::sin(angle);
    const double integrated = integrator.with_integral(x) - x;
    integrator.advance(x);
    sine += 2.0 / samples * integrated * std::sin(angle);
    cosine += 2.0 / samples * integrated * std::cos(angle);
  }
  const double expected = integral.corner / w * describing_function(integral, amplitude);
  EXPECT_NEAR(-cosine / amplitude, expected, 1e-4 * expected);
  EXPECT_NEAR(sine / amplitude, 0.0, 1e-4 * expected);
}

TEST(ConditionalIntegral, IsReadFromItsController) {
  const auto integral = conditional_integral(with_width("FULL+L+F", 0.25));
  ASSERT_TRUE(integral);
  EXPECT_EQ(integral->condition, BlockKind::freeze);
  EXPECT_EQ(integral->width, 0.25);
  EXPECT_FALSE(conditional_integral(with_width("FULL", 1.0)));
  const Controller held = without_conditional_integral(with_width("LL+D", 0.25));
  EXPECT_EQ(held.structure.count(LoopPath::position, BlockKind::integral), 0);
  EXPECT_EQ(held.gains.size(), with_width("LL+D", 0.25).gains.size() - 2);
  EXPECT_THAT(reference::Call([] { without_conditional_integral(with_width("FULL", 1.0)); }),
              ThrowsMessage<InvalidInput>(HasSubstr("expected a dead zone or freeze")));
}

TEST(ConditionalIntegral, AmountsToALowerCornerInASine) {
  const Controller controller = with_width("FULL+L+D+C", 0.5);
  Controller equivalent;
  set_linear_equivalent(controller, 1.0, equivalent);
  const auto integral = conditional_integral(controller);
  EXPECT_NEAR(gain(equivalent, "wip"), integral->corner * describing_function(*integral, 1.0),
              1e-15);
  set_linear_equivalent(controller, 0.4, equivalent);
  EXPECT_NEAR(gain(equivalent, "wip"), held_fraction * integral->corner, 1e-20);
  EXPECT_EQ(gain(equivalent, "kp"), gain(controller, "kp"));
  const Controller plain = with_width("FULL", 1.0);
  set_linear_equivalent(plain, 1.0, equivalent);
  EXPECT_EQ(equivalent.gains, plain.gains);
}

// Commands of two controllers for the same random measurements, from a steady motion, with a limit
// that both reach.
double largest_difference(const Controller& one, const Controller& other, double limit) {
  const AntennaControllerOptions options{.command_limit = limit};
  AntennaController first(one, sample_time, options), second(other, sample_time, options);
  EXPECT_EQ(first.inputs(), second.inputs());
  const SteadyMotion motion{0.3, 0.2, 0.4};
  EXPECT_NEAR(first.start_from(motion), second.start_from(motion), 1e-9);
  reference::RandomNumbers random(11);
  VectorXd measured(static_cast<Eigen::Index>(first.inputs().size())), expected(1), found(1);
  double largest = 0.0, scale = 0.0;
  for (int k = 0; k < 400; ++k) {
    for (double& value : measured) value = random.uniform(-1.0, 1.0);
    first.update(0.0, measured, expected);
    second.update(0.0, measured, found);
    largest = std::max(largest, std::abs(found[0] - expected[0]));
    scale = std::max(scale, std::abs(expected[0]));
  }
  return largest / scale;
}

// f is x itself: the linear controller, in sampled form with one state space for all of it.
TEST(AntennaController, WithADeadZoneOfNothingIsTheLinearController) {
  for (const auto& name : names()) {
    const Controller narrow = with_width(name, 1e-13);
    std::vector<LoopBlock> blocks = narrow.structure.blocks();
    std::vector<double> gains;
    std::size_t k = 0;
    for (const auto& block : blocks) {
      for (std::size_t i = 0; i < block.gains.size(); ++i, ++k) {
        if (block.kind != BlockKind::dead_zone && block.kind != BlockKind::freeze) {
          gains.push_back(narrow.gains[k]);
        }
      }
    }
    std::erase_if(blocks, [](const LoopBlock& block) {
      return block.kind == BlockKind::dead_zone || block.kind == BlockKind::freeze;
    });
    const Controller linear{LoopStructure("linear", blocks), gains};
    for (const double limit : {1e9, 0.5}) {
      EXPECT_LT(largest_difference(linear, narrow, limit), 1e-9) << name << ' ' << limit;
    }
  }
}

TEST(AntennaController, HoldsTheIntegralWithinADeadZoneOfEverything) {
  for (const auto& name : names()) {
    const Controller wide = with_width(name, 1e6);
    AntennaController controller(wide, sample_time);
    AntennaController held(without_conditional_integral(wide), sample_time);
    VectorXd measured = VectorXd::Zero(static_cast<Eigen::Index>(controller.inputs().size()));
    VectorXd found(1), expected(1);
    reference::RandomNumbers random(5);
    for (int k = 0; k < 300; ++k) {
      for (double& value : measured) value = random.uniform(-1.0, 1.0);
      controller.update(0.0, measured, found);
      held.update(0.0, measured, expected);
      ASSERT_NEAR(found[0], expected[0], 1e-12 * (1.0 + std::abs(expected[0]))) << name;
    }
  }
}

// At the limit for an hour, with the integral held and with one that takes every error.
TEST(AntennaController, UnwindsAConditionalIntegralHeldOrNot) {
  for (const auto& name : names()) {
    for (const double width : {1e6, 1e-13}) {
      const Controller controller = with_width(name, width);
      AntennaController limited(controller, sample_time, {.command_limit = 0.1});
      VectorXd measured = VectorXd::Zero(static_cast<Eigen::Index>(limited.inputs().size()));
      measured[controller.structure.feeds_torque_back() ? 3 : 2] = 1.0;  // reference
      VectorXd command(1);
      for (int k = 0; k < 180000; ++k) limited.update(0.0, measured, command);
      ASSERT_EQ(command[0], 0.1) << name;
      measured *= -1.0;
      int samples = 0;
      for (; samples < 20000 && command[0] > -0.1; ++samples) {
        limited.update(0.0, measured, command);
        ASSERT_TRUE(std::isfinite(command[0]));
      }
      EXPECT_LT(samples, 2000) << name << ' ' << width;
    }
  }
}

TEST(AntennaController, WithAConditionalIntegralHoldsTheMotionThatItIsStartedFrom) {
  for (const auto& name : names()) {
    const Controller start = with_width(name, 0.1);
    AntennaController controller(start, sample_time);
    const double lead = controller.start_from({4.0, 2.0, 60.0});
    const bool torque = start.structure.feeds_torque_back();
    const bool compliance = start.structure.has(LoopPath::compliance);
    EXPECT_NEAR(lead, compliance ? gain(start, "cs") * 60.0 : 0.0, 1e-12) << name;
    VectorXd measured(torque ? 6 : 5), command(1);
    for (int k = 0; k < 500; ++k) {
      const double reference = 2.0 * sample_time * k;
      if (torque) {
        measured << 2.0, reference + lead, 60.0, reference, 2.0, 0.0;
      } else {
        measured << 2.0, reference + lead, reference, 2.0, 0.0;
      }
      controller.update(0.0, measured, command);
      ASSERT_NEAR(command[0], 4.0, 1e-9) << name << " at sample " << k;
    }
  }
}

TEST(LoopStructure, TakesAConditionOnlyWithOneIntegralOfThePositionPath) {
  const auto structure = LoopStructure::named("FULL+L+D");
  EXPECT_FALSE(structure.has_integral_action());
  EXPECT_TRUE(structure.has_conditional_integral());
  EXPECT_EQ(structure.count(LoopPath::rate, BlockKind::integral), 0);
  EXPECT_EQ(structure.count(LoopPath::position, BlockKind::integral), 1);
  EXPECT_THROW(structure.with_freeze(), InvalidInput);
  const auto set = structure.with_integral_width(0.08);
  const auto& gain = set.gains().at(7);
  ASSERT_EQ(gain.symbol, "dzp");
  EXPECT_DOUBLE_EQ(std::sqrt(gain.lower * gain.upper), 0.08);
  EXPECT_EQ(set.with_bounds_for({20.0, 0.004}).gains().at(7).lower, gain.lower);
  EXPECT_THROW(structure.with_integral_width(0.0), InvalidInput);
  const LoopBlock dead_zone{LoopPath::rate, BlockKind::dead_zone, {{"d", "d", "rad", 0.1, 1.0}}};
  for (const auto* name : {"FULL", "FULL+L", "FULL+L+D"}) {
    auto blocks = LoopStructure::named(name).blocks();
    blocks.push_back(dead_zone);
    EXPECT_THAT(
        reference::Call([&] { LoopStructure("own", blocks); }),
        ThrowsMessage<InvalidInput>(HasSubstr(
            "expected a dead zone or freeze alone, with one integral in the position path")));
  }
}

// A dead zone leaves no more than its width, the proportional part no more than its own.
TEST(StaticEncoderGain, IsThatOfTheHeldLoop) {
  const Controller controller = with_width("LL+L+D", 0.1);
  EXPECT_EQ(static_encoder_gain(controller),
            static_encoder_gain(without_conditional_integral(controller)));
}

}  // namespace
}  // namespace boresight::control
