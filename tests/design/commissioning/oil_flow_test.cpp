#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <boresight/design/commissioning/oil_flow.hpp>
#include <boresight/design/commissioning/stage_quantities.hpp>

namespace boresight::design {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double sample_time = 0.02;
constexpr double stiffness = 50.0;
constexpr double leakage = 1.2;
const FlowModel model{200.0, 0.04, 0.03, 3.0};

// An oil spring between a flow that steps and a motor that follows it with any friction: a ring at
// 1 Hz, and more friction with the rate. The flow is two samples late, the tachometer a lag.
identification::ServoRecord ringing(double friction, double noise) {
  constexpr int finer = 50;
  constexpr double inertia = 1.3;
  constexpr Index samples = 1500;
  VectorXd valve(samples), rate(samples), torque(samples);
  double w = 5.0, shown = 5.0;
  double t = friction * std::sqrt(w);
  std::mt19937 numbers(5);
  std::normal_distribution<double> normal(0.0, noise);
  for (Index k = 0; k < samples; ++k) {
    const double flow = 5.0 + leakage * t / stiffness + ((k / 300) % 2 == 1 ? 2.0 : 0.0);
    torque[k] = t + normal(numbers);
    rate[k] = shown + 0.02 * normal(numbers);
    // Of the load at its flow, which the record has two samples later.
    valve[std::max<Index>(0, k - 2)] = flow / std::sqrt(1.0 - t / model.supply_torque);
    for (int step = 0; step < finer; ++step) {
      const double dt = sample_time / finer;
      const double held = 5.0 + leakage * t / stiffness + ((k / 300) % 2 == 1 ? 2.0 : 0.0);
      t += dt * (stiffness * (held - w) - leakage * t);
      w += dt * (t - friction * std::sqrt(std::max(w, 0.0))) / inertia;
      shown += dt * (w - shown) / model.tachometer_lag;
    }
  }
  valve.tail(2).setConstant(valve[samples - 3]);
  identification::ServoRecord record;
  record.sample_time = sample_time;
  record.valve_command = identification::Signal{valve, {}};
  record.motor_rate = identification::Signal{rate, {}};
  record.motor_torque = identification::Signal{torque, {}};
  return record;
}

TEST(OilSpring, IsThatOfTheRecordWhateverTheFriction) {
  for (const double friction : {2.0, 10.0, 30.0}) {
    const auto found = oil_spring(ringing(friction, 0.0), model);
    ASSERT_TRUE(found.has_value()) << friction;
    EXPECT_NEAR(found->stiffness, stiffness, stiffness_resolution * stiffness) << friction;
    const auto noisy = oil_spring(ringing(friction, 0.3), model);
    ASSERT_TRUE(noisy.has_value()) << friction;
    EXPECT_NEAR(noisy->stiffness, stiffness,
                4.0 * noisy->uncertainty + stiffness_resolution * stiffness);
    EXPECT_GT(noisy->uncertainty, found->uncertainty);
  }
}

// Noise alone, and signals that are missing or not valid, tell nothing.
TEST(OilSpring, IsNoneWhereTheRecordDoesNotTellIt) {
  auto record = ringing(10.0, 0.0);
  std::mt19937 numbers(3);
  std::normal_distribution<double> normal;
  for (auto* signal : {&*record.valve_command, &*record.motor_rate, &*record.motor_torque}) {
    for (double& value : signal->values) value = normal(numbers);
  }
  EXPECT_FALSE(oil_spring(record, model).has_value());
  record = ringing(10.0, 0.0);
  record.motor_torque->valid.assign(1500, true);
  record.motor_torque->valid[700] = false;
  EXPECT_FALSE(oil_spring(record, model).has_value());
  record.motor_torque.reset();
  EXPECT_FALSE(oil_spring(record, model).has_value());
}

// Half of the supply's pressure is left at the orifice: the root of it in flow.
TEST(ValveFlow, IsLessUnderLoadAndMoreWithIt) {
  identification::ServoRecord record;
  record.sample_time = sample_time;
  record.valve_command = identification::Signal{VectorXd::Constant(2, 10.0), {}};
  record.motor_torque = identification::Signal{(VectorXd(2) << 100.0, -100.0).finished(), {}};
  const auto flow = valve_flow(record, model);
  EXPECT_DOUBLE_EQ(flow.values[0], 10.0 * std::sqrt(0.5));
  EXPECT_DOUBLE_EQ(flow.values[1], 10.0 * std::sqrt(1.5));
  record.valve_command->values *= -1.0;
  EXPECT_DOUBLE_EQ(valve_flow(record, model).values[0], -10.0 * std::sqrt(1.5));
  record.motor_torque->valid = {true, false};
  EXPECT_FALSE(valve_flow(record, model).is_valid(1));
}

}  // namespace
}  // namespace boresight::design
