#include <cmath>
#include <complex>
#include <numbers>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <boresight/control/controllers/sampled_controller.hpp>
#include <boresight/control/program/digital_sections.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/linear/interconnection.hpp>

namespace boresight::control::program {
namespace {

using Complex = std::complex<double>;
constexpr double sample_time = 0.02;

Controller loops(const std::string& name) {
  Controller controller{LoopStructure::named(name), {}};
  for (const auto& gain : controller.structure.gains()) {
    controller.gains.push_back(std::sqrt(gain.lower * gain.upper));
  }
  return controller;
}

Complex response(const plant::StateSpace& system, Eigen::Index input, Complex z) {
  const Eigen::Index n = system.a.rows();
  const Eigen::MatrixXcd resolvent =
      z * Eigen::MatrixXcd::Identity(n, n) - system.a.cast<Complex>();
  const Eigen::VectorXcd states =
      resolvent.partialPivLu().solve(system.b.col(input).cast<Complex>());
  return (system.c.row(0).cast<Complex>() * states)(0) + system.d(0, input);
}

// u = R (r - tachometer) - Q torque, r = -P (encoder - C torque).
TEST(DigitalSections, MakeTheResponseOfTheSampledController) {
  for (const char* name : {"PI-0", "PI+N", "FULL+C", "FULL+L+C"}) {
    const Controller controller = loops(name);
    const auto sampled = sampled_controller(controller, sample_time);
    for (const double frequency : {0.03, 0.7, 5.0, 20.0}) {
      const Complex z = std::polar(1.0, 2.0 * std::numbers::pi * frequency * sample_time);
      const auto path = [&](LoopPath which) -> Complex {
        if (!controller.structure.has(which)) return which <= LoopPath::rate ? 1.0 : 0.0;
        Complex product = 1.0;
        for (const auto& section : digital_sections(controller, which, sample_time)) {
          product *= (section.b[0] + section.b[1] / z + section.b[2] / (z * z)) /
                     (1.0 + section.a[0] / z + section.a[1] / (z * z));
        }
        return product;
      };
      const Complex rate = path(LoopPath::rate), position = path(LoopPath::position);
      const auto expected = [&](const char* input) {
        return response(sampled, plant::input_index(sampled, input), z);
      };
      const double tolerance = 1e-11 * std::abs(rate * position);
      EXPECT_LT(std::abs(expected("tachometer") + rate), 1e-11 * std::abs(rate)) << name;
      EXPECT_LT(std::abs(expected("encoder") + rate * position), tolerance) << name;
      if (!controller.structure.feeds_torque_back()) continue;
      const Complex torque =
          rate * position * path(LoopPath::compliance) - path(LoopPath::pressure);
      EXPECT_LT(std::abs(expected("motor_torque") - torque), 1e-11 * std::abs(torque)) << name;
    }
  }
}

TEST(DigitalSections, HaveTheirStaticGains) {
  const auto rate = digital_sections(loops("PI"), LoopPath::rate, sample_time);
  ASSERT_EQ(rate.size(), 2U);
  EXPECT_EQ(rate[0].name, "rate_integral");
  EXPECT_EQ(rate[0].inverse_static_gain, 0.0);
  EXPECT_EQ(rate[1].name, "rate_lag");
  EXPECT_DOUBLE_EQ(rate[1].static_gain, 1.0);
  EXPECT_NEAR((rate[1].b[0] + rate[1].b[1]) / (1.0 + rate[1].a[0]), 1.0, 1e-12);
  const auto pressure = digital_sections(loops("DPF"), LoopPath::pressure, sample_time);
  EXPECT_EQ(pressure[0].static_gain, 0.0);
  EXPECT_TRUE(digital_sections(loops("PI"), LoopPath::pressure, sample_time).empty());
}

plant::StateSpace system_of(const Eigen::Matrix3d& a) {
  plant::StateSpace system;
  system.a = a;
  system.b = (Eigen::Matrix<double, 3, 2>() << 0.3, -0.2, 0.1, 0.4, -0.2, 0.1).finished();
  system.c = Eigen::RowVector3d{-0.4, -0.7, 0.3};
  system.d = Eigen::RowVector2d{-0.5, -0.8};
  system.states = {"first", "second", "third"};
  system.inputs = {"tachometer", "encoder"};
  system.outputs = {"valve_demand"};
  system.sample_time = sample_time;
  return system;
}

TEST(ModalBlocks, HaveTheResponseOfTheStateSpace) {
  Eigen::Matrix3d a;
  a << 0.9, 0.2, 0.1, -0.2, 0.9, 0.3, 0.0, 0.1, 0.6;
  const auto system = system_of(a);
  const auto blocks = in_modal_blocks(system);
  EXPECT_EQ(blocks.a(0, 2) * blocks.a(2, 0), 0.0);
  int coupled = 0;
  for (Eigen::Index i = 0; i < 3; ++i) {
    for (Eigen::Index j = 0; j < 3; ++j) coupled += i != j && blocks.a(i, j) != 0.0;
  }
  EXPECT_EQ(coupled, 2) << "one pair";
  for (const double angle : {0.001, 0.1, 1.0, 3.0}) {
    for (const Eigen::Index input : {0, 1}) {
      const Complex z = std::polar(1.0, angle);
      EXPECT_LT(std::abs(response(blocks, input, z) - response(system, input, z)), 1e-13);
    }
  }
}

TEST(ModalBlocks, LeaveBlocksAsTheyAre) {
  Eigen::Matrix3d a;
  a << 0.5, 0.0, 0.0, 0.0, 0.9, 0.1, 0.0, -0.1, 1.0;
  const auto system = system_of(a);
  const auto blocks = in_modal_blocks(system);
  EXPECT_EQ(blocks.a, system.a);
  EXPECT_EQ(blocks.b, system.b);
}

TEST(ModalBlocks, LeaveAChainOfEqualPolesAsItIs) {
  Eigen::Matrix3d a;
  a << 0.5, 1.0, 0.0, 0.0, 0.5, 1.0, 0.0, 0.0, 0.5;
  const auto system = system_of(a);
  EXPECT_EQ(in_modal_blocks(system).a, system.a);
}

}  // namespace
}  // namespace boresight::control::program
