#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "plant/ode_systems.hpp"
#include "refused_call.hpp"
#include <boresight/numerics/error.hpp>
#include <boresight/plant/integration/ode_integrator.hpp>

namespace boresight::plant {
namespace {

using namespace reference;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// x' = -x of two states, which does what a test wants before it answers.
class Disturbed : public OdeSystem {
 public:
  using Disturbance =
      std::function<void(double t, const StateRef& x, Eigen::Ref<Eigen::MatrixXd>& values)>;
  Disturbance in_rate, in_jacobian, in_events, in_parameters;

  Eigen::Index states() const override { return 2; }
  void rate(double t, const StateRef& x, VectorRef dx) const override {
    dx = -x;
    disturb(in_rate, t, x, dx);
  }
  void jacobian(double t, const StateRef& x, MatrixRef j) const override {
    j.diagonal().setConstant(-1.0);
    disturb(in_jacobian, t, x, j);
  }
  Eigen::Index events() const override { return 2; }
  void event_values(double t, const StateRef& x, VectorRef g) const override {
    g.setOnes();
    disturb(in_events, t, x, g);
  }
  Eigen::Index parameters() const override { return 2; }
  void rate_by_parameters(double t, const StateRef& x, MatrixRef df_dp) const override {
    disturb(in_parameters, t, x, df_dp);
  }

 private:
  static void disturb(const Disturbance& how, double t, const StateRef& x,
                      Eigen::Ref<Eigen::MatrixXd> values) {
    if (how) how(t, x, values);
  }
};

OdeIntegrator integrator_of(const Disturbed& system) {
  OdeOptions options;
  options.sensitivities = true;
  return {system, 0.0, vector({1.0, 2.0}), options};
}

// From 0.5 s on.
Disturbed::Disturbance late(const std::function<void(Eigen::Ref<Eigen::MatrixXd>&)>& what) {
  return [what](double t, const StateRef&, Eigen::Ref<Eigen::MatrixXd>& values) {
    if (t > 0.5) what(values);
  };
}

TEST(OdeIntegrator, LetsExceptionsOfTheSystemThroughUnchanged) {
  struct Own : std::runtime_error {
    int code;
    explicit Own(int c) : std::runtime_error("own"), code(c) {}
  };
  for (const auto member : {&Disturbed::in_rate, &Disturbed::in_jacobian, &Disturbed::in_events,
                            &Disturbed::in_parameters}) {
    Disturbed system;
    OdeIntegrator integrator = integrator_of(system);
    integrator.advance(0.25);
    const Eigen::VectorXd before = integrator.state();
    system.*member = late([](Eigen::Ref<Eigen::MatrixXd>&) { throw Own(42); });
    try {
      integrator.advance(3.0);
      ADD_FAILURE() << "did not throw";
    } catch (const Own& own) {
      EXPECT_EQ(own.code, 42);
    }
    // It stands where it stood, and can go on once the system is in order.
    EXPECT_EQ(integrator.time(), 0.25);
    EXPECT_EQ(integrator.state(), before);
    system.*member = nullptr;
    EXPECT_EQ(integrator.advance(3.0).time, 3.0);
    EXPECT_NEAR(integrator.state()(1), 2.0 * std::exp(-3.0), 1e-4);
  }
}

TEST(OdeIntegrator, NamesWhatIsNotFinite) {
  struct Case {
    Disturbed::Disturbance Disturbed::*member = nullptr;
    Eigen::Index row = 0, column = 0;
    const char* words = "";
  };
  for (const Case& c : {Case{&Disturbed::in_rate, 1, 0, "rate(1) is nan"},
                        Case{&Disturbed::in_events, 1, 0, "event_values(1) is nan"},
                        Case{&Disturbed::in_jacobian, 1, 0, "jacobian(1, 0) is nan"},
                        Case{&Disturbed::in_parameters, 0, 1, "rate_by_parameters(0, 1) is nan"}}) {
    Disturbed system;
    system.*c.member =
        late([&](Eigen::Ref<Eigen::MatrixXd>& values) { values(c.row, c.column) = nan; });
    OdeIntegrator integrator = integrator_of(system);
    EXPECT_THAT(reference::Call([&] { integrator.advance(3.0); }),
                ThrowsMessage<NumericalFailure>(AllOf(HasSubstr(c.words), HasSubstr("at t = 0.5"),
                                                      HasSubstr("from 0 s to 3 s"))))
        << c.words;
  }
  // From the first evaluation on.
  Disturbed system;
  system.in_rate = [](double, const StateRef&, Eigen::Ref<Eigen::MatrixXd>& dx) {
    dx(0, 0) = std::numeric_limits<double>::infinity();
  };
  OdeIntegrator integrator = integrator_of(system);
  EXPECT_THAT(reference::Call([&] { integrator.advance(3.0); }),
              ThrowsMessage<NumericalFailure>(HasSubstr("rate(0) is inf at t = 0 s")));
}

// dx/dt = -2 sqrt(x), so that sqrt(x) = sqrt(x0) - t until it stays at zero; nothing below.
class Draining : public OdeSystem {
 public:
  mutable int refused = 0;
  Eigen::Index states() const override { return 1; }
  void rate(double, const StateRef& x, VectorRef dx) const override {
    if (x(0) < 0.0) ++refused;
    dx(0) = -2.0 * std::sqrt(x(0));
  }
  void jacobian(double, const StateRef& x, MatrixRef j) const override {
    j(0, 0) = -1.0 / std::sqrt(x(0));
  }
};

TEST(OdeIntegrator, TriesASmallerStepWhereTheSystemIsNotDefined) {
  const Draining system;
  OdeOptions options;
  options.relative_tolerance = 1e-2;  // steps that overshoot
  options.absolute_tolerance = vector({1e-3});
  OdeIntegrator integrator(system, 0.0, vector({1.0}), options);
  integrator.advance(0.999, Approach::stop_exactly);
  EXPECT_GT(system.refused, 0);
  EXPECT_NEAR(std::sqrt(integrator.state()(0)), 1e-3, 0.05);
  EXPECT_THAT(reference::Call([&] { integrator.advance(3.0); }),
              ThrowsMessage<NumericalFailure>(HasSubstr("(0) is")));
}

TEST(OdeIntegrator, StopsAtTheCapOfSteps) {
  OdeOptions options;
  options.max_steps = 50;
  const Linear system = oscillator(1.0);
  OdeIntegrator integrator(system, 0.0, vector({1.0, 0.0}), options);
  EXPECT_THAT(reference::Call([&] { integrator.advance(1000.0); }),
              ThrowsMessage<NumericalFailure>(
                  AllOf(HasSubstr("mxstep steps taken"), HasSubstr("raise max_steps"))));
  EXPECT_EQ(integrator.time(), 0.0);
  // For each advance anew.
  for (int k = 1; k <= 20; ++k) integrator.advance(0.5 * k);
  EXPECT_GT(integrator.statistics().steps, options.max_steps);
}

TEST(OdeIntegrator, SaysThatNoStepIsSmallEnough) {
  // x' = x^2 from 1 is infinite at t = 1.
  class Runaway : public OdeSystem {
   public:
    Eigen::Index states() const override { return 1; }
    void rate(double, const StateRef& x, VectorRef dx) const override { dx(0) = x(0) * x(0); }
    void jacobian(double, const StateRef& x, MatrixRef j) const override { j(0, 0) = 2.0 * x(0); }
  };
  const Runaway system;
  OdeIntegrator integrator(system, 0.0, vector({1.0}));
  EXPECT_THAT(reference::Call([&] { integrator.advance(2.0); }),
              ThrowsMessage<NumericalFailure>(AllOf(HasSubstr("below the rounding of the time"),
                                                    HasSubstr("given up at 0.9999"),
                                                    HasSubstr("singularity"))));
}

TEST(OdeIntegrator, SaysThatTolerancesAreBelowRounding) {
  OdeOptions options;
  options.relative_tolerance = 0.0;
  options.absolute_tolerance = vector({1e-20});
  const Linear system = oscillator(1.0);
  OdeIntegrator integrator(system, 0.0, vector({1.0, 0.0}), options);
  EXPECT_THAT(reference::Call([&] { integrator.advance(1.0); }),
              ThrowsMessage<NumericalFailure>(
                  AllOf(HasSubstr("too much accuracy"), HasSubstr("raise relative_tolerance"))));
}

TEST(OdeIntegrator, NeitherGoesBackNorNowhere) {
  const Linear system = oscillator(1.0);
  OdeIntegrator integrator(system, 1.0, vector({1.0, 0.0}));
  integrator.advance(2.0);
  for (const double t : {1.5, nan, std::numeric_limits<double>::infinity()}) {
    EXPECT_THAT(
        reference::Call([&] { integrator.advance(t); }),
        ThrowsMessage<InvalidInput>(AllOf(HasSubstr("OdeIntegrator::advance"), HasSubstr("2 s"))));
  }
  EXPECT_THAT(reference::Call([&] { integrator.restart(vector({1.0})); }),
              ThrowsMessage<InvalidInput>(HasSubstr("length 2, found 1")));
  EXPECT_THAT(reference::Call([&] {
                integrator.restart(vector({1.0, nan}));
              }),
              ThrowsMessage<InvalidInput>(HasSubstr("not finite")));
  EXPECT_THAT(reference::Call([&] {
                integrator.restart(vector({1.0, 0.0}), Eigen::MatrixXd::Zero(2, 1));
              }),
              ThrowsMessage<InvalidInput>(HasSubstr("0 x 0, found 2 x 1")));
}

TEST(OdeIntegrator, RefusesOptionsThatDoNotFit) {
  const Disturbed system;
  const auto refusal = [&](const std::function<void(OdeOptions&)>& spoil, const char* words) {
    OdeOptions options;
    options.sensitivities = true;
    spoil(options);
    EXPECT_THAT(reference::Call([&] {
                  OdeIntegrator(system, 0.0, vector({1.0, 2.0}), options);
                }),
                ThrowsMessage<InvalidInput>(HasSubstr(words)));
  };
  refusal([](OdeOptions& o) { o.relative_tolerance = -1e-6; }, "relative_tolerance");
  refusal([](OdeOptions& o) { o.relative_tolerance = nan; }, "relative_tolerance");
  refusal([](OdeOptions& o) { o.absolute_tolerance = vector({1e-6, 0.0}); }, "above 0, found 0");
  refusal([](OdeOptions& o) { o.absolute_tolerance = vector({1e-6, nan}); }, "absolute_tolerance");
  refusal([](OdeOptions& o) { o.absolute_tolerance.resize(0); }, "one absolute_tolerance or 2");
  refusal([](OdeOptions& o) { o.absolute_tolerance.setOnes(3); }, "or 2, found 3");
  refusal([](OdeOptions& o) { o.highest_order = 0; }, "highest_order");
  refusal([](OdeOptions& o) { o.longest_step = 0.0; }, "longest_step");
  refusal([](OdeOptions& o) { o.max_steps = 0; }, "max_steps");
  refusal([](OdeOptions& o) { o.iteration = OdeIteration::fixed_point; }, "found fixed_point");
  refusal([](OdeOptions& o) { o.initial_sensitivities.setZero(1, 2); }, "2 x 2, found 1 x 2");
  refusal([](OdeOptions& o) { o.initial_sensitivities.setConstant(2, 2, nan); }, "finite");
  refusal([](OdeOptions& o) { o.parameter_scale = vector({1.0}); }, "parameter_scale of length 2");
  refusal([](OdeOptions& o) { o.parameter_scale = vector({1.0, 0.0}); }, "above 0, found 0");

  OdeOptions options;
  options.sensitivities = true;
  const Linear plain = oscillator(1.0);
  EXPECT_THAT(reference::Call([&] {
                OdeIntegrator(plain, 0.0, vector({1.0, 0.0}), options);
              }),
              ThrowsMessage<InvalidInput>(HasSubstr("a system with parameters")));
  EXPECT_THAT(reference::Call([&] { OdeIntegrator(plain, 0.0, vector({1.0})); }),
              ThrowsMessage<InvalidInput>(HasSubstr("length 2, found 1")));
  EXPECT_THAT(reference::Call([&] {
                OdeIntegrator(plain, nan, vector({1.0, 0.0}));
              }),
              ThrowsMessage<InvalidInput>(HasSubstr("start time")));
  EXPECT_THAT(reference::Call([&] {
                OdeIntegrator(plain, 0.0, vector({nan, 0.0}));
              }),
              ThrowsMessage<InvalidInput>(HasSubstr("not finite")));
  const Linear empty(Eigen::MatrixXd(0, 0), Eigen::VectorXd(0));
  EXPECT_THAT(reference::Call([&] { OdeIntegrator(empty, 0.0, Eigen::VectorXd(0)); }),
              ThrowsMessage<InvalidInput>(HasSubstr("a system with states")));
}

}  // namespace
}  // namespace boresight::plant
