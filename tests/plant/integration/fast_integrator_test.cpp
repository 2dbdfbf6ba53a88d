#include <cmath>
#include <functional>
#include <memory>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "random_stable_system.hpp"
#include "reference_values.hpp"
#include "refused_call.hpp"
#include <boresight/numerics/error.hpp>
#include <boresight/plant/integration/fast_integrator.hpp>
#include <boresight/plant/integration/feedback_ode.hpp>
#include <boresight/plant/integration/ode_integrator.hpp>
#include <boresight/plant/linear/time_response.hpp>

namespace boresight::plant {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr auto zoh = Interpolation::zero_order_hold;
constexpr auto foh = Interpolation::first_order_hold;

// Channels written as one function that fills n and dn/dz.
class Channels final : public NonlinearChannels {
 public:
  using Function = std::function<void(const Eigen::Ref<const Eigen::VectorXd>&,
                                      Eigen::Ref<Eigen::VectorXd>, Eigen::Ref<Eigen::MatrixXd>)>;
  Channels(Eigen::Index p, Eigen::Index q, Function function)
      : p_(p), q_(q), function_(std::move(function)) {}
  Eigen::Index inputs() const override { return p_; }
  Eigen::Index outputs() const override { return q_; }
  void evaluate(const Eigen::Ref<const Eigen::VectorXd>& z, Eigen::Ref<Eigen::VectorXd> n,
                Eigen::Ref<Eigen::MatrixXd> dn_dz) const override {
    function_(z, n, dn_dz);
  }

 private:
  Eigen::Index p_, q_;
  Function function_;
};

// n_i = sum over z_j of a smooth function: tanh, signed square root, cube.
std::shared_ptr<const Channels> smooth_channels(Eigen::Index p, Eigen::Index q) {
  return std::make_shared<const Channels>(p, q, [p, q](const auto& z, auto n, auto dn_dz) {
    for (Eigen::Index i = 0; i < q; ++i) {
      n[i] = 0.0;
      for (Eigen::Index j = 0; j < p; ++j) {
        const double root = std::pow(z[j] * z[j] + 0.01, 0.25);
        switch ((i + j) % 3) {
          case 0:
            n[i] -= std::tanh(2.0 * z[j]);
            dn_dz(i, j) = -2.0 / std::pow(std::cosh(2.0 * z[j]), 2);
            break;
          case 1:
            n[i] -= z[j] / root;
            dn_dz(i, j) = -1.0 / root + 0.5 * z[j] * z[j] / std::pow(root, 5);
            break;
          default:
            n[i] -= 0.1 * z[j] * z[j] * z[j];
            dn_dz(i, j) = -0.3 * z[j] * z[j];
        }
      }
    }
  });
}

// A stable system of modes; channels p to q around it, m inputs, two outputs.
FeedbackSystem random_feedback(reference::RandomNumbers& random, Eigen::Index p, Eigen::Index q,
                               Eigen::Index m) {
  reference::RandomSystemOptions shape;
  shape.inputs = m + q;
  shape.outputs = p + 2;
  shape.nearly_uncontrollable = 0.0;
  FeedbackSystem system{reference::random_stable_system(random, shape), q, p, nullptr};
  system.linear.d.topRightCorner(p, q).setZero();
  system.channels = smooth_channels(p, q);
  return system;
}

// dx/dt = A x + B [u; n], z = C x, y = Cy x.
FeedbackSystem around(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, const Eigen::MatrixXd& c,
                      std::shared_ptr<const Channels> channels) {
  return {reference::state_space(a, b, c, Eigen::MatrixXd::Zero(c.rows(), b.cols())),
          channels->outputs(), channels->inputs(), std::move(channels)};
}

// Absolute tolerances: 1e-2 of the relative one times `size` (of the channel inputs, or the
// states).
FastIntegratorOptions options_of(double interval, double tolerance,
                                 const Eigen::VectorXd& size = Eigen::VectorXd::Ones(1)) {
  FastIntegratorOptions options;
  options.interval = interval;
  options.relative_tolerance = tolerance;
  options.absolute_tolerance = 0.01 * tolerance * size;
  return options;
}

// By CVODES, started anew at every sample.
Eigen::MatrixXd by_cvodes(const FeedbackSystem& system, const Eigen::MatrixXd& input,
                          double interval, Interpolation interpolation, double tolerance,
                          const Eigen::VectorXd& size = Eigen::VectorXd::Ones(1)) {
  FeedbackOde ode(system);
  OdeOptions options;
  options.relative_tolerance = tolerance;
  options.absolute_tolerance = 0.01 * tolerance * size;
  const bool held = interpolation == zoh;
  OdeIntegrator integrator(ode, 0.0, Eigen::VectorXd::Zero(ode.states()), options);
  Eigen::MatrixXd output(input.rows() - (held ? 0 : 1),
                         system.linear.c.rows() - system.channel_inputs);
  for (Eigen::Index k = 0; k < output.rows(); ++k) {
    const double start = interval * static_cast<double>(k);
    ode.drive(start, input.row(k), start + interval, input.row(held ? k : k + 1));
    integrator.restart();
    integrator.advance(start + interval, Approach::stop_exactly);
    output.row(k) = ode.outputs(integrator.time(), integrator.state());
  }
  return output;
}

Eigen::MatrixXd by_fast_integrator(const FeedbackSystem& system, const Eigen::MatrixXd& input,
                                   Interpolation interpolation,
                                   const FastIntegratorOptions& options) {
  FastIntegrator integrator(system, options);
  Eigen::MatrixXd output(input.rows() - (interpolation == zoh ? 0 : 1),
                         system.linear.c.rows() - system.channel_inputs);
  integrator.simulate(input, output, interpolation);
  return output;
}

double difference(const Eigen::MatrixXd& one, const Eigen::MatrixXd& other) {
  return (one - other).cwiseAbs().maxCoeff() / (1e-3 + other.cwiseAbs().maxCoeff());
}

TEST(FastIntegrator, OfALinearSystemIsExactWhateverTheInterval) {
  reference::RandomNumbers random(61);
  for (int trial = 0; trial < 20; ++trial) {
    const FeedbackSystem system{
        reference::random_stable_system(random, {.inputs = 2, .outputs = 2}), 0, 0, nullptr};
    const Eigen::MatrixXd u = random.matrix(200, 2);
    FastIntegratorOptions options = options_of(random.log_uniform(1e-4, 10.0), 1e-6);
    for (const double largest_condition : {1e8, 0.0}) {
      options.largest_condition = largest_condition;
      LinearSimulation straight(system.linear, options.interval, {foh, largest_condition});
      EXPECT_LT(difference(by_fast_integrator(system, u, foh, options),
                           straight.simulate(u).bottomRows(199)),
                1e-12);
      // Just before the input changes: what follows, less what the change does at once.
      LinearSimulation held(system.linear, options.interval, {zoh, largest_condition});
      const Eigen::MatrixXd change = u.bottomRows(199) - u.topRows(199);
      EXPECT_LT(difference(by_fast_integrator(system, u.topRows(199), zoh, options),
                           held.simulate(u).bottomRows(199) - change * system.linear.d.transpose()),
                1e-12);
    }
  }
}

TEST(FastIntegrator, AgreesWithCvodesOnModesWithSmoothChannels) {
  reference::RandomNumbers random(62);
  for (const auto& [p, q] :
       {std::pair<Eigen::Index, Eigen::Index>{1, 1}, {2, 2}, {3, 1}, {1, 3}, {5, 4}, {12, 8}}) {
    const auto system = random_feedback(random, p, q, 1);
    const Eigen::MatrixXd u = 3.0 * random.matrix(21, 1);
    FastIntegratorOptions coarse = options_of(0.05, 1e-6), fine = options_of(0.05, 1e-9);
    for (const auto interpolation : {zoh, foh}) {
      const auto expected = by_cvodes(system, u, 0.05, interpolation, 1e-11);
      fine.largest_condition = highest_modal_condition;
      const auto found = by_fast_integrator(system, u, interpolation, fine);
      EXPECT_LT(difference(found, expected), 1e-8) << p << ' ' << q;
      EXPECT_LT(difference(by_fast_integrator(system, u, interpolation, coarse), expected), 1e-5);
      fine.largest_condition = 0.0;
      EXPECT_LT(difference(by_fast_integrator(system, u, interpolation, fine), found), 1e-10);
    }
  }
}

// A mass that slides on bristles, stiffness s0, damping s1: z' = v - s0 |v| z/g(v), force
// -(s0 z + s1 z').
FeedbackSystem mass_on_bristles(double s0, double s1) {
  const auto function = [s0](const auto& z, auto n, auto dn_dz) {
    const double v = z[0], bump = 0.05 * std::exp(-1e4 * v * v);
    const double level = 0.1 + bump, level_slope = -2e4 * v * bump;
    const double fraction = s0 * z[1] / level;
    n[0] = v - std::abs(v) * fraction;
    dn_dz(0, 0) =
        1.0 - std::copysign(1.0, v) * fraction + std::abs(v) * fraction / level * level_slope;
    dn_dz(0, 1) = -s0 * std::abs(v) / level;
  };
  const Eigen::Matrix2d a{{-0.2, -s0}, {0.0, 0.0}};
  const Eigen::Matrix2d b{{1.0, -s1}, {0.0, 1.0}};
  const Eigen::MatrixXd c{{1.0, 0.0}, {0.0, 1.0}, {1.0, 0.0}};
  return around(a, b, c, std::make_shared<const Channels>(2, 1, function));
}

TEST(FastIntegrator, FollowsStiffBristles) {
  // The bristle's rate reaches s0 v/g = 1e6 1/s.
  const double s0 = 1e5;
  const auto system = mass_on_bristles(s0, 3.0);
  const Eigen::Vector2d size(1.0, 0.1 / s0);
  const Eigen::VectorXd place = Eigen::VectorXd::LinSpaced(401, 0.0, 4.0);
  const Eigen::MatrixXd u = 1.2 * (std::numbers::pi * place.array()).sin();
  const auto expected = by_cvodes(system, u, 0.01, foh, 1e-11, size);
  EXPECT_GT(expected.maxCoeff() * s0 / 0.1, 5e5);
  FastIntegrator integrator(system, options_of(0.01, 1e-7, size));
  Eigen::MatrixXd found(400, 1);
  integrator.simulate(u, found, foh);
  EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_LT(integrator.statistics().steps, 40000);
}

TEST(FastIntegrator, PassesTheKinksOfBacklash) {
  // Motor and load, 1 kg m2 each, and a spring of 400 N m/rad with 0.1 rad of play between them.
  const auto function = [](const auto& z, auto n, auto dn_dz) {
    const double excess = std::abs(z[0]) - 0.05;
    n[0] = excess > 0.0 ? 400.0 * std::copysign(excess, z[0]) : 0.0;
    dn_dz(0, 0) = excess > 0.0 ? 400.0 : 0.0;
  };
  const Eigen::MatrixXd a{
      {0.0, 1.0, 0.0, 0.0}, {0.0, -1.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 1.0}, {0.0, 0.0, 0.0, -0.5}};
  const Eigen::MatrixXd b{{0.0, 0.0}, {1.0, -1.0}, {0.0, 0.0}, {0.0, 1.0}};
  const Eigen::MatrixXd c{
      {1.0, 0.0, -1.0, 0.0}, {1.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 1.0, 0.0}, {0.0, 0.0, 0.0, 1.0}};
  const auto system = around(a, b, c, std::make_shared<const Channels>(1, 1, function));
  reference::RandomNumbers random(63);
  const Eigen::MatrixXd u = 5.0 * random.matrix(20, 1);
  const auto expected = by_cvodes(system, u, 0.1, zoh, 1e-11);
  for (const double tolerance : {1e-5, 1e-7, 1e-9}) {
    const auto found = by_fast_integrator(system, u, zoh, options_of(0.1, tolerance));
    EXPECT_LT(difference(found, expected), 50.0 * tolerance);
  }
}

TEST(FastIntegrator, KeepsTheEnergyOfAHardeningSpring) {
  // x'' = -stiffness x - x^3, also without any linear spring: the dense route.
  const auto function = [](const auto& z, auto n, auto dn_dz) {
    n[0] = -z[0] * z[0] * z[0];
    dn_dz(0, 0) = -3.0 * z[0] * z[0];
  };
  for (const double stiffness : {0.0, 1.0, 400.0}) {
    const Eigen::Matrix2d a{{0.0, 1.0}, {-stiffness, 0.0}};
    const Eigen::Matrix2d b{{0.0, 0.0}, {1.0, 1.0}};
    const Eigen::MatrixXd c{{1.0, 0.0}};
    const auto system = around(a, b, c, std::make_shared<const Channels>(1, 1, function));
    const auto energy = [&](const Eigen::VectorXd& x) {
      return 0.5 * (x[1] * x[1] + stiffness * x[0] * x[0]) + 0.25 * std::pow(x[0], 4);
    };
    for (const double tolerance : {1e-6, 1e-9}) {
      FastIntegrator integrator(system, options_of(0.25, tolerance));
      EXPECT_EQ(integrator.by_modes(), stiffness > 0.0);
      integrator.start_from(Eigen::Vector2d(2.0, 0.0));
      const double start = energy(integrator.state());
      Eigen::MatrixXd y(400, 0);
      integrator.simulate(Eigen::MatrixXd::Zero(400, 1), y, zoh);
      const double drift = energy(integrator.state()) / start - 1.0;
      EXPECT_LT(std::abs(drift), 1000.0 * tolerance);
      EXPECT_EQ(integrator.time(), 100.0);
    }
  }
}

TEST(FastIntegrator, GivesTheSameBitsInPiecesAndFromACopy) {
  reference::RandomNumbers random(64);
  const auto system = random_feedback(random, 3, 2, 2);
  const Eigen::MatrixXd u = 4.0 * random.matrix(101, 2);
  const auto options = options_of(0.05, 1e-6);
  const auto expected = by_fast_integrator(system, u, foh, options);
  FastIntegrator integrator(system, options);
  const FastIntegrator untouched = integrator;
  Eigen::MatrixXd found(100, 2);
  for (const Eigen::Index k : {0, 1, 4, 9, 44}) {
    const Eigen::Index length = k == 44 ? 56 : k == 9 ? 35 : k == 4 ? 5 : k == 1 ? 3 : 1;
    integrator.simulate(u.middleRows(k, length + 1), found.middleRows(k, length), foh);
  }
  EXPECT_EQ(found, expected);
  EXPECT_NEAR(integrator.time(), 5.0, 1e-12);
  // Starting again forgets everything; so does a copy that never began.
  FastIntegrator copy = untouched;
  integrator.start_from(Eigen::VectorXd::Zero(system.linear.a.rows()));
  for (auto* other : {&integrator, &copy}) {
    other->simulate(u, found, foh);
    EXPECT_EQ(found, expected);
  }
}

TEST(FastIntegrator, TellsItsStateAndWhatTheChannelsSee) {
  reference::RandomNumbers random(65);
  const auto system = random_feedback(random, 2, 2, 1);
  FastIntegrator integrator(system, options_of(0.05, 1e-8));
  ASSERT_TRUE(integrator.by_modes());
  const Eigen::VectorXd start = random.matrix(system.linear.a.rows(), 1);
  integrator.start_from(start, 3.0);
  EXPECT_LT((integrator.state() - start).norm(), 1e-13);
  const Eigen::VectorXd u = Eigen::VectorXd::Constant(1, 0.4);
  integrator.advance(0.5 * u, u);
  EXPECT_EQ(integrator.time(), 3.05);
  Eigen::VectorXd drive(3), n(2);
  Eigen::MatrixXd slope(2, 2);
  drive << u, integrator.channel_outputs();
  const Eigen::VectorXd all = system.linear.c * integrator.state() + system.linear.d * drive;
  EXPECT_LT((all.head(2) - integrator.channel_inputs()).norm(), 1e-12);
  EXPECT_LT((all.tail(2) - integrator.outputs()).norm(), 1e-12);
  system.channels->evaluate(integrator.channel_inputs(), n, slope);
  EXPECT_LT((n - integrator.channel_outputs()).norm(), 1e-8);
}

TEST(FastIntegrator, NamesTimeAndChannelOfAFailure) {
  const Eigen::MatrixXd one = Eigen::MatrixXd::Ones(1, 1);
  const Eigen::MatrixXd both = Eigen::MatrixXd::Ones(1, 2);
  const auto integrator_of = [&](const Channels::Function& function, double pole, int finest_rung) {
    auto system = around(pole * one, both, one, std::make_shared<const Channels>(1, 1, function));
    system.linear.inputs = {"force", "valve"};
    system.linear.outputs = {"gap"};
    auto options = options_of(0.1, 1e-6);
    options.finest_rung = finest_rung;
    FastIntegrator result(system, options);
    result.start_from(Eigen::VectorXd::Ones(1));
    return result;
  };
  const Eigen::MatrixXd u = -Eigen::MatrixXd::Ones(30, 1);
  Eigen::MatrixXd y(30, 0);
  // Falls from 1 with rate 1, and the square root of a negative number is near t = 1 s.
  auto root = integrator_of(
      [](const auto& z, auto n, auto dn_dz) {
        n[0] = 1e-3 * std::sqrt(z[0]);
        dn_dz(0, 0) = 0.5e-3 / std::sqrt(z[0]);
      },
      0.0, 12);
  EXPECT_THAT(reference::Call([&] { root.simulate(u, y); }),
              ThrowsMessage<NumericalFailure>(
                  AllOf(HasSubstr("'valve' is not finite"), HasSubstr("t = 1.0"))));
  EXPECT_THAT(reference::Call([&] { root.simulate(u, y); }),
              ThrowsMessage<InvalidInput>(HasSubstr("start_from")));
  root.start_from(Eigen::VectorXd::Constant(1, 100.0));
  EXPECT_NO_THROW(root.simulate(u, y));
  root.start_from(Eigen::VectorXd::Constant(1, -1.0), 7.0);
  EXPECT_THAT(reference::Call([&] { root.simulate(u, y); }),
              ThrowsMessage<NumericalFailure>(
                  AllOf(HasSubstr("'valve' is not finite"), HasSubstr("t = 7 s"))));
  // Coulomb friction as a jump.
  auto jump = integrator_of(
      [](const auto& z, auto n, auto dn_dz) {
        n[0] = z[0] > 0.0 ? -5.0 : 5.0;
        dn_dz(0, 0) = 0.0;
      },
      0.0, 10);
  try {
    jump.simulate(u, y);
    ADD_FAILURE() << "a jump went unnoticed";
  } catch (const NumericalFailure& failure) {
    EXPECT_THAT(failure.what(), testing::AnyOf(HasSubstr("'valve'"), HasSubstr("'gap'")));
  }
  // The error of the only step allowed.
  auto coarse = integrator_of(
      [](const auto& z, auto n, auto dn_dz) {
        n[0] = -std::tanh(100.0 * z[0] - 95.0);
        dn_dz(0, 0) = -100.0 / std::pow(std::cosh(100.0 * z[0] - 95.0), 2);
      },
      0.0, 0);
  EXPECT_THAT(reference::Call([&] { coarse.simulate(u, y); }),
              ThrowsMessage<NumericalFailure>(
                  AllOf(HasSubstr("the error in 'gap'"), HasSubstr("finer rung than 0"))));
  auto runaway = integrator_of(
      [](const auto&, auto n, auto dn_dz) {
        n[0] = 0.0;
        dn_dz(0, 0) = 0.0;
      },
      5000.0, 3);
  Eigen::MatrixXd nothing(3, 0);
  EXPECT_THAT(reference::Call([&] { runaway.simulate(u.topRows(3), nothing); }),
              ThrowsMessage<NumericalFailure>(HasSubstr("overflows near t = 0.1")));
}

TEST(FastIntegrator, NamesWhatItRefuses) {
  reference::RandomNumbers random(66);
  const auto system = random_feedback(random, 2, 1, 1);
  const auto refused = [&](auto change, const char* words) {
    FastIntegratorOptions options = options_of(0.1, 1e-6);
    change(options);
    EXPECT_THAT(reference::Call([&] { FastIntegrator(system, options); }),
                ThrowsMessage<InvalidInput>(HasSubstr(words)));
  };
  refused([](auto& o) { o.interval = 0.0; }, "an interval above 0, found 0 s");
  refused([](auto& o) { o.interval = std::nan(""); }, "FastIntegrator: expected an interval");
  refused([](auto& o) { o.finest_rung = 31; }, "finest_rung of 0 to 30, found 31");
  refused([](auto& o) { o.relative_tolerance = -1.0; }, "relative_tolerance of 0 to 1, found -1");
  refused([](auto& o) { o.absolute_tolerance = Eigen::VectorXd::Ones(3); },
          "one absolute_tolerance or 2, one for each channel input, found 3");
  refused([](auto& o) { o.absolute_tolerance[0] = 0.0; }, "absolute_tolerance above 0, found 0");

  FastIntegrator integrator(system, options_of(0.1, 1e-6));
  Eigen::MatrixXd y(5, 2);
  EXPECT_THAT(reference::Call([&] { integrator.simulate(Eigen::MatrixXd::Ones(5, 1), y, foh); }),
              ThrowsMessage<InvalidInput>(HasSubstr("found 5 x 1 for 5 x 2")));
  EXPECT_THROW(integrator.simulate(Eigen::MatrixXd::Ones(6, 1), y, zoh), InvalidInput);
  EXPECT_THAT(reference::Call(
                  [&] { integrator.advance(Eigen::VectorXd::Ones(2), Eigen::VectorXd::Ones(1)); }),
              ThrowsMessage<InvalidInput>(HasSubstr("1 finite inputs")));
  const Eigen::VectorXd gap = Eigen::VectorXd::Constant(1, std::nan(""));
  EXPECT_THAT(reference::Call([&] { integrator.advance(gap, gap); }),
              ThrowsMessage<InvalidInput>(HasSubstr("not all finite")));
  EXPECT_THAT(reference::Call([&] { integrator.start_from(gap); }),
              ThrowsMessage<InvalidInput>(HasSubstr("not all finite")));
  FeedbackOde ode(system);
  EXPECT_THAT(reference::Call([&] { ode.drive(0.0, gap, 1.0, gap); }),
              ThrowsMessage<InvalidInput>(HasSubstr("1 finite inputs")));
  EXPECT_THAT(reference::Call(
                  [&] { ode.drive(1.0, Eigen::VectorXd::Ones(1), 1.0, Eigen::VectorXd::Ones(1)); }),
              ThrowsMessage<InvalidInput>(HasSubstr("two times that differ")));
}

TEST(FeedbackOde, HasTheJacobianOfItsRate) {
  reference::RandomNumbers random(67);
  const auto system = random_feedback(random, 3, 2, 1);
  FeedbackOde ode(system);
  ode.drive([](double t, Eigen::Ref<Eigen::VectorXd> u) { u[0] = std::sin(t); });
  const Eigen::Index n = ode.states();
  const Eigen::VectorXd x = random.matrix(n, 1);
  Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(n, n), difference_quotient(n, n);
  ode.jacobian(1.3, x, jacobian);
  for (Eigen::Index i = 0; i < n; ++i) {
    Eigen::VectorXd up = x, down = x, rate_up(n), rate_down(n);
    up[i] += 1e-5;
    down[i] -= 1e-5;
    ode.rate(1.3, up, rate_up);
    ode.rate(1.3, down, rate_down);
    difference_quotient.col(i) = (rate_up - rate_down) / 2e-5;
  }
  EXPECT_LT((jacobian - difference_quotient).norm(), 1e-7 * jacobian.norm());
}

}  // namespace
}  // namespace boresight::plant
