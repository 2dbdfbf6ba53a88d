#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reference_nonlinear_antenna.hpp"
#include "refused_call.hpp"
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/antenna/hydraulics.hpp>
#include <boresight/plant/integration/feedback_interconnection.hpp>
#include <boresight/plant/linear/interconnection.hpp>
#include <boresight/plant/linear/time_response.hpp>
#include <boresight/plant/nonlinear/operating_point.hpp>
#include <boresight/plant/nonlinear/simulation.hpp>

namespace boresight::plant {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

Index column_index(const SimulationResult& result, const std::string& name) {
  const auto found = std::ranges::find(result.names, name);
  EXPECT_NE(found, result.names.end()) << name;
  return found - result.names.begin();
}

// x' = -x + u without channels, y = x.
FeedbackSystem lag() {
  const auto one = MatrixXd::Ones(1, 1);
  return {{-one, one, one, MatrixXd::Zero(1, 1), {"u"}, {"y"}, {"x"}}, 0, 0, nullptr};
}

StateSpace proportional(double gain, double sample_time) {
  MatrixXd d(1, 2);
  d << gain, -gain;
  return {MatrixXd(0, 0), MatrixXd(0, 2), MatrixXd(1, 0), d, {"reference", "y"}, {"u"}, {},
          sample_time};
}

TEST(Simulation, SampledLoopFollowsItsRecursion) {
  // One sample of delay: x[k+1] = e^-T x[k] + (1 - e^-T) u[k-1], u[k] = g (r - x[k]).
  const double sample_time = 0.1;
  LinearSampledController controller(proportional(3.0, sample_time));
  SimulationPlan plan;
  plan.interval = 0.02;
  plan.signals = {"reference"};
  plan.values = MatrixXd::Ones(101, 1);
  plan.controller = &controller;
  plan.computation_delay = sample_time;
  for (const auto integrator : {Integrator::exponential_collocation, Integrator::cvodes}) {
    const double error = integrator == Integrator::cvodes ? 1e-8 : 1e-12;
    plan.integrator = integrator;
    plan.relative_tolerance = 1e-10;
    plan.absolute_tolerance.setConstant(1e-12);
    const auto result = simulate(lag(), plan);
    ASSERT_TRUE(result.complete);
    EXPECT_GE(result.statistics.steps, 100);
    const Index y = column_index(result, "y");
    const Index u = column_index(result, "u");
    const double decay = std::exp(-sample_time);
    double x = 0.0;
    double acting = 0.0;
    for (Index k = 0; k < 20; ++k) {
      EXPECT_NEAR(result.values(5 * k, y), x, error);
      const double asked = 3.0 * (1.0 - x);
      EXPECT_NEAR(result.values(5 * k + 2, u), acting, error);
      x = decay * x + (1.0 - decay) * acting;
      acting = asked;
    }
    EXPECT_NEAR(result.final_state[0], x, error);
  }
}

TEST(Simulation, CvodesGivesUpOnASystemTooStiffForItsFixedPoints) {
  // Samples a hundred thousand times as long as the time constant.
  FeedbackSystem stiff = lag();
  stiff.linear.a *= 1e6;
  SimulationPlan plan;
  plan.interval = 0.1;
  plan.signals = {"u"};
  plan.values = MatrixXd::Ones(3, 1);
  EXPECT_NO_THROW(simulate(stiff, plan));
  plan.integrator = Integrator::cvodes;
  EXPECT_THAT(reference::Call([&] { simulate(stiff, plan); }),
              testing::ThrowsMessage<NumericalFailure>(
                  testing::HasSubstr("solve a stiff system by Newton's")));
}

TEST(Simulation, DelayOfPartOfASampleShiftsTheCommand) {
  LinearSampledController controller(proportional(1.0, 0.1));
  SimulationPlan plan;
  plan.interval = 0.02;
  plan.signals = {"reference"};
  plan.values = MatrixXd::Ones(11, 1);
  plan.controller = &controller;
  plan.computation_delay = 0.04;
  const auto result = simulate(lag(), plan);
  const Index u = column_index(result, "u");
  EXPECT_EQ(result.values(1, u), 0.0);
  EXPECT_EQ(result.values(2, u), 1.0);
  EXPECT_EQ(result.values(6, u), 1.0);
  EXPECT_NEAR(result.values(7, u), 1.0 - result.values(5, column_index(result, "y")), 1e-15);
}

TEST(LinearSampledController, DoesNotWindUp) {
  // An integrator that asks for more than the limit: back calculation keeps it at the limit.
  const auto one = MatrixXd::Ones(1, 1);
  const StateSpace integrator{one, one, one, one, {"e"}, {"u"}, {"i"}, 1.0};
  LinearSampledController limited(integrator, {VectorXd::Constant(1, 5.0), one});
  LinearSampledController unlimited(integrator);
  VectorXd u(1);
  for (int k = 0; k < 100; ++k) limited.update(k, VectorXd::Ones(1), u);
  EXPECT_EQ(u[0], 5.0);
  for (int k = 0; k < 3; ++k) limited.update(k, -VectorXd::Ones(1), u);
  EXPECT_LT(u[0], 5.0);
  for (int k = 0; k < 100; ++k) unlimited.update(k, VectorXd::Ones(1), u);
  EXPECT_EQ(u[0], 100.0);
}

TEST(Simulation, SmallMotionIsThatOfTheLinearisedAntenna) {
  const auto antenna = reference::nonlinear_antenna();
  const auto system = to_feedback_system(antenna);
  for (const double rate : {1.0, 12.0}) {
    const auto point = trim(antenna, {rate, 0.0, {}});
    SimulationPlan plan;
    plan.interval = 0.005;
    plan.state = point.state;
    plan.signals = {"valve_command", "wind_torque"};
    const Index samples = 801;
    plan.values = MatrixXd::Zero(samples, 2);
    MatrixXd small(samples, 2);
    for (Index k = 0; k < samples; ++k) {
      const double t = plan.interval * static_cast<double>(k);
      small(k, 0) = 1e-5 * std::sin(5.0 * t) * std::min(1.0, t);
      small(k, 1) = 1e-4 * std::sin(14.0 * t);
    }
    plan.values = small.rowwise() + point.input.transpose();
    plan.relative_tolerance = 1e-12;
    plan.absolute_tolerance = VectorXd::Constant(1, 1e-12);
    const auto result = simulate(system, plan);
    LinearSimulation linear(linearise(system, point.state, point.input), plan.interval,
                            {.interpolation = Interpolation::first_order_hold});
    const MatrixXd expected = linear.simulate(small);
    VectorXd steady = VectorXd::Zero(samples);
    for (const char* name : {"tachometer", "motor_torque", "encoder", "beam", "inlet_pressure_2"}) {
      const Index c = column_index(result, name);
      const bool angle = std::string(name) == "encoder" || std::string(name) == "beam";
      for (Index k = 0; k < samples; ++k) {
        steady[k] =
            result.values(0, c) + (angle ? rate * plan.interval * static_cast<double>(k) : 0.0);
      }
      const VectorXd found = result.values.col(c) - steady;
      EXPECT_LT((found - expected.col(c)).cwiseAbs().maxCoeff(),
                1e-4 * expected.col(c).cwiseAbs().maxCoeff())
          << name << " at " << rate;
    }
  }
}

// Frequency at which a record, less its mean and under a Hann window, has its largest line.
double strongest_frequency(const VectorXd& record, double interval, double lowest, double highest) {
  const VectorXd signal = record.array() - record.mean();
  const auto magnitude = [&](double hertz) {
    std::complex<double> sum = 0.0;
    const auto n = static_cast<double>(signal.size());
    for (Index k = 0; k < signal.size(); ++k) {
      const auto i = static_cast<double>(k);
      const double window = 0.5 - 0.5 * std::cos(two_pi * i / n);
      sum += window * signal[k] * std::polar(1.0, -two_pi * hertz * interval * i);
    }
    return std::abs(sum);
  };
  double best = lowest;
  double step = 0.05;
  for (double f = lowest; f < highest; f += step) {
    if (magnitude(f) > magnitude(best)) best = f;
  }
  for (; step > 1e-4; step *= 0.5) {
    for (const double f : {best - 0.5 * step, best + 0.5 * step}) {
      if (magnitude(f) > magnitude(best)) best = f;
    }
  }
  return best;
}

TEST(Simulation, SloshFrequenciesReturnTheBulkModulus) {
  const auto antenna = reference::nonlinear_antenna();
  SimulationPlan plan;
  plan.interval = 1e-3;
  plan.state = state_at_rest(antenna);
  plan.signals = {"valve_command"};
  plan.values = MatrixXd::Zero(3001, 1);
  plan.values.topRows(1000).setConstant(5.0);
  plan.held = {true};
  const auto result = simulate(to_feedback_system(antenna), plan);
  const auto lengths = reference::drive_details().line_lengths;
  for (std::size_t motor = 0; motor < lengths.size(); ++motor) {
    // After the valve has closed.
    const VectorXd record =
        result.values.col(column_index(result, "inlet_pressure_" + std::to_string(motor + 1)))
            .tail(1950);
    const double slosh = strongest_frequency(record, plan.interval, 30.0, 60.0);
    EXPECT_NEAR(bulk_modulus_from_slosh(lengths[motor], slosh, 850.0), 1229e6, 0.005 * 1229e6);
  }
}

TEST(Simulation, StopsWhereItIsTold) {
  SimulationPlan plan;
  plan.interval = 0.01;
  plan.signals = {"u"};
  plan.values = MatrixXd::Ones(5001, 1);
  plan.progress = [](Index done, Index all) {
    EXPECT_EQ(all, 5000);
    return done < 2000;
  };
  const auto result = simulate(lag(), plan);
  EXPECT_FALSE(result.complete);
  EXPECT_LT(result.values.rows(), 5001);
  EXPECT_NEAR(result.values(1000, 0), 1.0 - std::exp(-10.0), 1e-12);
}

TEST(Simulation, RefusesWhatDoesNotFit) {
  LinearSampledController controller(proportional(1.0, 0.1));
  SimulationPlan good;
  good.interval = 0.02;
  good.signals = {"reference"};
  good.values = MatrixXd::Ones(11, 1);
  good.controller = &controller;
  const auto refused = [&](auto change, const char* what) {
    SimulationPlan plan = good;
    change(plan);
    try {
      simulate(lag(), plan);
      ADD_FAILURE() << what;
    } catch (const InvalidInput& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr(what));
    }
  };
  refused([](auto& p) { p.interval = 0.03; }, "multiple of the interval");
  refused([](auto& p) { p.computation_delay = 0.01; }, "computation delay");
  refused([](auto& p) { p.signals = {"u"}; }, "'u'");
  refused([](auto& p) { p.signals = {"elsewhere"}; }, "'elsewhere'");
  refused([](auto& p) { p.signals = {"y"}; }, "'y'");
  refused(
      [](auto& p) {
        p.signals.clear();
        p.values.resize(11, 0);
      },
      "'reference'");
  refused([](auto& p) { p.computation_delay = std::numeric_limits<double>::infinity(); },
          "computation delay");
  refused([](auto& p) { p.values.resize(1, 1); }, "at least 2 samples");
  refused([](auto& p) { p.sensors.resize(2); }, "1 sensors");
  refused([](auto& p) { p.sensors = {Sensor{.gain = 0.0}}; }, "gain");
  refused([](auto& p) { p.held = {true, false}; }, "held");
  EXPECT_THROW(LinearSampledController(proportional(1.0, 0.0)), InvalidInput);
}

TEST(Sensor, ClipsThenRounds) {
  const Sensor sensor{.gain = 1.1, .zero = 0.5, .resolution = 0.25, .lowest = -2.0, .highest = 2.1};
  EXPECT_DOUBLE_EQ(reading(sensor, 0.0, 0.0), 0.5);
  EXPECT_DOUBLE_EQ(reading(sensor, 1.0, 0.0), 1.5);   // 1.6
  EXPECT_DOUBLE_EQ(reading(sensor, 10.0, 0.0), 2.0);  // 2.1
  EXPECT_DOUBLE_EQ(reading(sensor, -9.0, 0.0), -2.0);
  const VectorXd ramp = VectorXd::LinSpaced(10001, -5.0, 5.0);
  const auto read = readings(sensor, ramp, 1, 0);
  // (2.1 - 0.5)/1.1 and (-2 - 0.5)/1.1 are the ends of the range.
  EXPECT_NEAR(static_cast<double>(read.at_limit), 1e3 * (5.0 - 1.6 / 1.1 + 5.0 - 2.5 / 1.1), 2.0);
  EXPECT_EQ(read.values, readings(sensor, ramp, 1, 0).values);
}

TEST(Sensor, NoiseHasItsRms) {
  const Sensor sensor{.noise = 0.3};
  const VectorXd zero = VectorXd::Zero(100000);
  const auto first = readings(sensor, zero, 5, 0).values;
  const auto second = readings(sensor, zero, 5, 1).values;
  EXPECT_NEAR(std::sqrt(first.squaredNorm() / 1e5), 0.3, 4.0 * 0.3 / std::sqrt(2e5));
  EXPECT_LT(std::abs(first.dot(second)) / 1e5, 4.0 * 0.09 / std::sqrt(1e5));
}

}  // namespace
}  // namespace boresight::plant
