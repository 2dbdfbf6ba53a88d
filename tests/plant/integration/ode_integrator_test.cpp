#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "plant/ode_systems.hpp"
#include <boresight/numerics/matrix_exponential.hpp>
#include <boresight/plant/integration/ode_integrator.hpp>

namespace boresight::plant {
namespace {

using namespace reference;

OdeOptions tolerances(double relative, double absolute) {
  OdeOptions options;
  options.relative_tolerance = relative;
  options.absolute_tolerance = vector({absolute});
  return options;
}

double largest(const Eigen::MatrixXd& matrix) {
  return matrix.cwiseAbs().maxCoeff();
}

TEST(OdeIntegrator, KeepsThePhaseOfAnOscillatorToItsTolerance) {
  const double w = 2.0 * std::numbers::pi, cycles = 10.0;
  for (const OdeMethod method : {OdeMethod::bdf, OdeMethod::adams}) {
    for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10}) {
      OdeOptions options = tolerances(tolerance, 1e-2 * tolerance);
      options.method = method;
      const Linear system = oscillator(w);
      OdeIntegrator integrator(system, 0.0, vector({1.0, 0.0}), options);
      integrator.advance(cycles);
      const Eigen::VectorXd& x = integrator.state();
      const double phase = std::atan2(-x(1) / w, x(0));
      EXPECT_LT(std::abs(phase), 5.0 * cycles * tolerance) << tolerance;
      EXPECT_NEAR(x(0), 1.0, 50.0 * cycles * tolerance) << tolerance;
    }
  }
}

// An oscillator without the derivatives that Newton's method would ask for.
class WithoutJacobian final : public Linear {
 public:
  using Linear::Linear;
  void jacobian(double, const StateRef&, MatrixRef) const override {
    ADD_FAILURE() << "asked for a Jacobian";
  }
};

TEST(OdeIntegrator, IteratesToFixedPointsByTheRateAlone) {
  Eigen::MatrixXd a(2, 2);
  a << 0.0, 1.0, -9.0, 0.0;
  const WithoutJacobian system(a, Eigen::VectorXd::Zero(2));
  for (const OdeMethod method : {OdeMethod::bdf, OdeMethod::adams}) {
    OdeOptions options = tolerances(1e-9, 1e-11);
    options.method = method;
    options.iteration = OdeIteration::fixed_point;
    OdeIntegrator integrator(system, 0.0, vector({1.0, 0.0}), options);
    for (int k = 1; k <= 20; ++k) {
      integrator.restart();
      integrator.advance(0.1 * k, Approach::stop_exactly);
      EXPECT_NEAR(integrator.state()(0), std::cos(0.3 * k), 2e-7);
    }
    EXPECT_EQ(integrator.statistics().jacobians, 0);
  }
}

TEST(OdeIntegrator, IsTheClosedFormOfAStiffSystemWithItsSensitivities) {
  const LagOfDecay system;
  OdeOptions options = tolerances(1e-8, 1e-10);
  options.sensitivities = true;
  options.parameter_scale = vector({1.0, 1000.0});
  OdeIntegrator integrator(system, 0.0, vector({1.0, 0.0}), options);

  const OdeStop root = integrator.advance(2.0);
  EXPECT_TRUE(root.event);
  EXPECT_EQ(root.directions, Eigen::VectorXi::Constant(1, -1));
  EXPECT_NEAR(root.time, std::numbers::ln2, 1e-7);
  EXPECT_EQ(root.time, integrator.time());
  // The time at which y0(t, k) = level moves by -(dy0/dk)/(dy0/dt) = -ln 2/k^2.
  const double moves = -integrator.sensitivities()(0, 0) / (-system.k * integrator.state()(0));
  EXPECT_NEAR(moves, -std::numbers::ln2, 1e-6);

  const OdeStop end = integrator.advance(2.0);
  EXPECT_FALSE(end.event);
  EXPECT_EQ(end.time, 2.0);
  EXPECT_LT(largest(integrator.state() - system.solution(2.0)), 1e-7);
  const Eigen::MatrixXd error = integrator.sensitivities() - system.sensitivity(2.0);
  EXPECT_LT(largest(error * options.parameter_scale.asDiagonal()), 1e-6);
  // Stiffness costs nothing: the fast time constant passes 2000 times.
  EXPECT_LT(integrator.statistics().steps, 500);
}

TEST(OdeIntegrator, IsTheMatrixExponentialOfALinearSystemWhoseInputJumps) {
  Eigen::MatrixXd a(3, 3);
  a << -0.2, 3.0, 0.0, -3.0, -0.2, 1.0, 0.5, 0.0, -40.0;
  const Eigen::MatrixXd b = Eigen::MatrixXd::Identity(3, 3);
  Linear system(a, Eigen::VectorXd::Zero(3));
  OdeIntegrator integrator(system, 0.0, Eigen::VectorXd::Zero(3), tolerances(1e-10, 1e-12));
  const double step = 0.37;
  const numerics::HeldTransition transition = numerics::held_transition(a, b, step);
  Eigen::VectorXd exact = Eigen::VectorXd::Zero(3);
  for (int k = 0; k < 6; ++k) {
    const Eigen::VectorXd u = vector({1.0, -2.0 * k, k % 2 == 0 ? 30.0 : -10.0});
    system.push(u);
    integrator.restart();
    integrator.advance((k + 1) * step);
    exact = transition.state * exact + transition.step * u;
    EXPECT_LT(largest(integrator.state() - exact), 1e-8 * largest(exact)) << k;
  }
}

// A rate that jumps by the clock alone, and notes the latest time it is asked for.
class Switched : public OdeSystem {
 public:
  double jump = 1.0;
  mutable double latest = 0.0;
  Eigen::Index states() const override { return 1; }
  void rate(double t, const StateRef& x, VectorRef dx) const override {
    latest = std::max(latest, t);
    dx(0) = (t > jump ? -5.0 : 3.0) - x(0);
  }
  void jacobian(double, const StateRef&, MatrixRef j) const override { j(0, 0) = -1.0; }
};

TEST(OdeIntegrator, NeverAsksForATimeBehindAnExactStop) {
  const Switched system;
  for (const bool interpolated_before : {false, true}) {
    system.latest = 0.0;
    OdeIntegrator integrator(system, 0.0, vector({0.0}), tolerances(1e-9, 1e-11));
    if (interpolated_before) integrator.advance(0.5);
    integrator.advance(1.0, Approach::stop_exactly);
    if (!interpolated_before) {
      EXPECT_LE(system.latest, 1.0);
    }
    EXPECT_EQ(integrator.time(), 1.0);
    const double at_jump = 3.0 * (1.0 - std::exp(-1.0));
    EXPECT_NEAR(integrator.state()(0), at_jump, 1e-7);
    integrator.restart();
    integrator.advance(2.0);
    EXPECT_GT(system.latest, 2.0);  // the stop is no longer there
    EXPECT_NEAR(integrator.state()(0), -5.0 + (at_jump + 5.0) * std::exp(-1.0), 1e-7);
  }
}

TEST(OdeIntegrator, DropsAStepPastAnExactStopThatComesLater) {
  const Linear system = oscillator(1.0);
  OdeIntegrator integrator(system, 0.0, vector({1.0, 0.0}), tolerances(1e-10, 1e-12));
  for (int k = 1; k <= 200; ++k) {
    const double t = 0.013 * k;
    const OdeStop stop =
        integrator.advance(t, k % 3 == 0 ? Approach::stop_exactly : Approach::interpolate);
    EXPECT_EQ(stop.time, t);
    EXPECT_NEAR(integrator.state()(0), std::cos(t), 1e-7);
    EXPECT_NEAR(integrator.state()(1), -std::sin(t), 1e-7);
  }
}

TEST(OdeIntegrator, KeepsTheEnergyOfAPendulum) {
  const Pendulum system;
  const Eigen::VectorXd start = vector({2.5, 0.0});
  for (const double tolerance : {1e-6, 1e-9}) {
    OdeOptions options = tolerances(tolerance, 1e-2 * tolerance);
    OdeIntegrator integrator(system, 0.0, start, options);
    double worst = 0.0;
    while (integrator.time() < 20.0) {
      integrator.advance(20.0);
      worst =
          std::max(worst, std::abs(system.energy(integrator.state()) / system.energy(start) - 1.0));
    }
    EXPECT_LT(worst, 1e3 * tolerance);
  }
}

TEST(OdeIntegrator, FindsEachBounce) {
  const Fall system;
  const double restitution = 0.8, height = 2.0;
  OdeIntegrator integrator(system, 0.0, vector({height, 0.0}), tolerances(1e-9, 1e-11));
  double expected = std::sqrt(2.0 * height / system.gravity);
  double speed = system.gravity * expected;
  for (int bounce = 0; bounce < 20; ++bounce) {
    const OdeStop stop = integrator.advance(10.0);
    ASSERT_TRUE(stop.event) << bounce;
    EXPECT_EQ(stop.directions(0), -1) << bounce;
    EXPECT_NEAR(stop.time, expected, 2e-8) << bounce;
    EXPECT_NEAR(integrator.state()(1), -speed, 2e-8) << bounce;
    // Exactly on the ground, where the event must not fire again.
    integrator.restart(vector({0.0, -restitution * integrator.state()(1)}));
    speed *= restitution;
    expected += 2.0 * speed / system.gravity;
  }
}

TEST(OdeIntegrator, TellsTheDirectionsOfItsEvents) {
  // Let go at the turning point, where the event of the speed is zero, and going on without a
  // restart: bottom falling, turn rising, bottom rising, turn falling.
  const Pendulum system;
  OdeIntegrator integrator(system, 0.0, vector({1.0, 0.0}), tolerances(1e-9, 1e-11));
  std::vector<Eigen::VectorXi> found;
  std::vector<double> times;
  for (int k = 0; k < 5; ++k) {
    const OdeStop stop = integrator.advance(100.0);
    ASSERT_TRUE(stop.event);
    found.push_back(stop.directions);
    times.push_back(stop.time);
  }
  const auto directions = [](int turn, int bottom) { return Eigen::Vector2i(turn, bottom); };
  EXPECT_EQ(found[0], directions(0, -1));
  EXPECT_EQ(found[1], directions(1, 0));
  EXPECT_EQ(found[2], directions(0, 1));
  EXPECT_EQ(found[3], directions(-1, 0));
  EXPECT_EQ(found[4], directions(0, -1));
  // Quarter period K(sin(q0/2))/w, by the arithmetic-geometric mean.
  double a = 1.0, g = std::cos(0.5);
  for (int k = 0; k < 6; ++k) {
    const double next = 0.5 * (a + g);
    g = std::sqrt(a * g);
    a = next;
  }
  const double quarter = std::numbers::pi / (2.0 * a) / system.w;
  for (std::size_t k = 0; k < times.size(); ++k) {
    EXPECT_NEAR(times[k], (static_cast<double>(k) + 1.0) * quarter, 1e-7);
  }
}

TEST(OdeIntegrator, StopsAtAnEventThatFallsOnTheTimeAskedFor) {
  // Height 1 - t, and the ground exactly at the time asked for.
  Fall system;
  system.gravity = 0.0;
  OdeIntegrator integrator(system, 0.0, vector({1.0, -1.0}));
  const OdeStop stop = integrator.advance(1.0, Approach::stop_exactly);
  EXPECT_EQ(stop.time, 1.0);
  const OdeStop after = integrator.advance(2.0);
  EXPECT_TRUE(stop.event || (after.event && std::abs(after.time - 1.0) < 1e-12));
  EXPECT_NE(stop.event, after.event);  // once
}

// x' = speed, with the event x = 0.
class Drift : public OdeSystem {
 public:
  double speed = -1.0;
  Eigen::Index states() const override { return 1; }
  void rate(double, const StateRef&, VectorRef dx) const override { dx(0) = speed; }
  void jacobian(double, const StateRef&, MatrixRef) const override {}
  Eigen::Index events() const override { return 1; }
  void event_values(double, const StateRef& x, VectorRef g) const override { g(0) = x(0); }
};

TEST(OdeIntegrator, CountsAZeroWhereItStoppedAsCrossed) {
  // Found falling through zero, perhaps exactly at it. If the equation then turns it back it
  // rises through zero; from a zero that the caller sets it does not.
  for (const double start : {1.0, 0.7, 0.3}) {
    Drift system;
    OdeIntegrator integrator(system, 0.0, vector({start}));
    ASSERT_EQ(integrator.advance(2.0).directions(0), -1);
    system.speed = 1.0;
    integrator.restart();
    const OdeStop back = integrator.advance(2.0);
    EXPECT_TRUE(back.event);
    EXPECT_EQ(back.directions(0), 1);
    EXPECT_NEAR(back.time, start, 1e-9);
    integrator.restart(vector({0.0}));
    EXPECT_FALSE(integrator.advance(2.0).event);
    EXPECT_NEAR(integrator.state()(0), 2.0 - start, 1e-9);
  }
}

TEST(OdeIntegrator, TakesAStepOfRoundingForNoStep) {
  const Linear system = oscillator(1.0);
  OdeIntegrator integrator(system, 1.0, vector({1.0, 0.0}));
  EXPECT_EQ(integrator.advance(1.0).time, 1.0);
  EXPECT_EQ(integrator.statistics().rate_evaluations, 0);
  const double next = std::nextafter(1.0, 2.0);
  EXPECT_EQ(integrator.advance(next).time, next);
  EXPECT_EQ(integrator.state(), vector({1.0, 0.0}));
  integrator.advance(1.0 + 1e-13);
  EXPECT_NEAR(integrator.state()(1), -1e-13, 1e-15);
  integrator.advance(2.0);
  EXPECT_NEAR(integrator.state()(0), std::cos(1.0), 1e-5);
}

// Central differences of the end state of integrations at tight tolerances.
template <class System>
Eigen::MatrixXd differences(System system, const std::vector<double System::*>& parameters,
                            const Eigen::VectorXd& x0, double t) {
  Eigen::MatrixXd result(system.states(), static_cast<Eigen::Index>(parameters.size()));
  const auto end = [&] {
    OdeIntegrator integrator(system, 0.0, x0, tolerances(1e-12, 1e-14));
    while (integrator.advance(t).event) {
    }
    return integrator.state();
  };
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    double& parameter = system.*parameters[k];
    const double value = parameter, h = 1e-4 * std::abs(value);
    parameter = value + h;
    const Eigen::VectorXd above = end();
    parameter = value - h;
    result.col(static_cast<Eigen::Index>(k)) = (above - end()) / (2.0 * h);
    parameter = value;
  }
  return result;
}

template <class System>
void expect_sensitivities(const System& system, const std::vector<double System::*>& parameters,
                          const Eigen::VectorXd& x0, double t) {
  OdeOptions options = tolerances(1e-9, 1e-11);
  options.sensitivities = true;
  OdeIntegrator integrator(system, 0.0, x0, options);
  while (integrator.advance(t).event) {
  }
  const Eigen::MatrixXd expected = differences(system, parameters, x0, t);
  EXPECT_LT(largest(integrator.sensitivities() - expected), 1e-5 * largest(expected));
}

TEST(OdeIntegrator, GivesTheSensitivitiesOfFiniteDifferences) {
  expect_sensitivities<VanDerPol>({}, {&VanDerPol::mu}, vector({2.0, 0.0}), 6.0);
  Pendulum damped;
  damped.d = 0.15;
  expect_sensitivities<Pendulum>(damped, {&Pendulum::w, &Pendulum::d}, vector({2.0, 0.5}), 5.0);
}

TEST(OdeIntegrator, CarriesSensitivitiesToTheInitialState) {
  // With dx/dx0 = I at the start, a linear system's is exp(A t); parameters that the rate does not
  // have are the initial state.
  class Started : public Linear {
   public:
    using Linear::Linear;
    Eigen::Index parameters() const override { return states(); }
  };
  Eigen::MatrixXd a(2, 2);
  a << 0.0, 1.0, -4.0, -0.3;
  const Started system(a, vector({1.0, 2.0}));
  OdeOptions options = tolerances(1e-10, 1e-12);
  options.sensitivities = true;
  options.initial_sensitivities = Eigen::MatrixXd::Identity(2, 2);
  OdeIntegrator integrator(system, 0.0, vector({0.3, 0.0}), options);
  integrator.advance(1.5);
  EXPECT_LT(largest(integrator.sensitivities() - numerics::matrix_exponential(1.5 * a)), 1e-8);
  // And from a jump on, from those that the caller gives.
  integrator.restart(vector({0.0, 0.0}), 2.0 * Eigen::MatrixXd::Identity(2, 2));
  integrator.advance(2.0);
  EXPECT_LT(largest(integrator.sensitivities() - 2.0 * numerics::matrix_exponential(0.5 * a)),
            1e-8);
}

TEST(OdeIntegrator, GivesTheSameBitsAgain) {
  const auto run = [] {
    const Pendulum system;
    OdeOptions options = tolerances(1e-7, 1e-9);
    options.sensitivities = true;
    OdeIntegrator integrator(system, 0.0, vector({1.0, 0.0}), options);
    Eigen::MatrixXd record(6, 40);
    for (Eigen::Index k = 0; k < record.cols(); ++k) {
      integrator.advance(0.1 * static_cast<double>(k + 1));
      record.col(k) << integrator.state(), integrator.sensitivities().reshaped();
    }
    return record;
  };
  EXPECT_EQ(run(), run());
}

TEST(OdeIntegrator, CountsItsWorkAcrossRestartsAndMoves) {
  const Linear system = oscillator(1.0);
  OdeIntegrator first(system, 0.0, vector({1.0, 0.0}));
  first.advance(1.0);
  const OdeStatistics before = first.statistics();
  EXPECT_GT(before.steps, 0);
  EXPECT_GE(before.rate_evaluations, before.steps);
  EXPECT_GT(before.jacobians, 0);
  EXPECT_EQ(before.sensitivity_evaluations, 0);
  first.restart(vector({0.0, 1.0}));
  OdeIntegrator second = std::move(first);
  second.advance(2.0);
  EXPECT_NEAR(second.state()(0), std::sin(1.0), 1e-5);
  EXPECT_GT(second.statistics().steps, before.steps);
}

TEST(OdeIntegrator, TakesLongStepsOverASilentModeAtLowOrder) {
  // 300 rad/s with 1 % damping beside a slow drive: stable however long the step up to order 2.
  Eigen::MatrixXd a(3, 3);
  a << -0.1, 0.0, 0.0, 0.0, 0.0, 1.0, 300.0 * 300.0, -300.0 * 300.0, -6.0;
  const Linear system(a, vector({1.0, 0.0, 0.0}));
  OdeOptions options = tolerances(1e-4, 1e-6);
  const auto steps = [&] {
    OdeIntegrator integrator(system, 0.0, Eigen::VectorXd::Zero(3), options);
    integrator.advance(20.0);
    EXPECT_NEAR(integrator.state()(1), 10.0 * (1.0 - std::exp(-2.0)), 0.05);
    return integrator.statistics().steps;
  };
  const long high = steps();
  options.highest_order = 2;
  const long low = steps();
  EXPECT_LT(2 * low, high);
}

}  // namespace
}  // namespace boresight::plant
