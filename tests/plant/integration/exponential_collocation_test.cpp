#include <cmath>
#include <complex>
#include <memory>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "random_stable_system.hpp"
#include "refused_call.hpp"
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/matrix_exponential.hpp>
#include <boresight/plant/integration/exponential_collocation.hpp>
#include <boresight/plant/integration/stage_solver.hpp>

namespace boresight::plant {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;
using Complex = std::complex<double>;
using Wide = std::complex<long double>;

// n = -z^3, channel by channel.
class Cubes final : public NonlinearChannels {
 public:
  explicit Cubes(Eigen::Index count) : count_(count) {}
  Eigen::Index inputs() const override { return count_; }
  Eigen::Index outputs() const override { return count_; }
  void evaluate(const Eigen::Ref<const Eigen::VectorXd>& z, Eigen::Ref<Eigen::VectorXd> n,
                Eigen::Ref<Eigen::MatrixXd> dn_dz) const override {
    n = -z.array().cube();
    dn_dz.setZero();
    dn_dz.diagonal() = -3.0 * z.array().square();
  }

 private:
  Eigen::Index count_;
};

// n = -rate z
class Decay final : public NonlinearChannels {
 public:
  explicit Decay(double rate) : rate_(rate) {}
  Eigen::Index inputs() const override { return 1; }
  Eigen::Index outputs() const override { return 1; }
  void evaluate(const Eigen::Ref<const Eigen::VectorXd>& z, Eigen::Ref<Eigen::VectorXd> n,
                Eigen::Ref<Eigen::MatrixXd> dn_dz) const override {
    n = -rate_ * z;
    dn_dz(0, 0) = -rate_;
  }

 private:
  double rate_;
};

FeedbackSystem with_cubes(const StateSpace& linear, Eigen::Index count) {
  return {linear, count, count, std::make_shared<const Cubes>(count)};
}

// dx/dt = a x + n, z = y = x
FeedbackSystem scalar_system(double a) {
  StateSpace linear;
  linear.a = Eigen::MatrixXd::Constant(1, 1, a);
  linear.b = Eigen::MatrixXd::Ones(1, 1);
  linear.c = Eigen::MatrixXd::Ones(2, 1);
  linear.d = Eigen::MatrixXd::Zero(2, 1);
  linear.inputs = {"n"};
  linear.outputs = {"z", "y"};
  linear.states = {"x"};
  return with_cubes(linear, 1);
}

// The integral itself, by Gauss's rule of five points in many panels.
Wide phi_by_quadrature(int k, Complex z) {
  const int panels = 100 + static_cast<int>(8.0 * std::abs(z));
  const std::array<long double, 3> places{0.0L, 0.538469310105683091036314420700208805L,
                                          0.906179845938663992797626878299392965L};
  const std::array<long double, 3> weights{0.568888888888888888888888888888888889L,
                                           0.478628670499366468041291514835638193L,
                                           0.236926885056189087514264040719917363L};
  Wide sum = 0.0L;
  const auto add = [&](long double s, long double weight) {
    sum += weight * std::exp(Wide(z) * (1.0L - s)) * std::pow(s, static_cast<long double>(k - 1));
  };
  for (int i = 0; i < panels; ++i) {
    const long double half = 0.5L / static_cast<long double>(panels), middle = (2 * i + 1) * half;
    add(middle, weights[0] * half);
    for (std::size_t j = 1; j < 3; ++j) {
      add(middle - half * places[j], weights[j] * half);
      add(middle + half * places[j], weights[j] * half);
    }
  }
  return sum / std::tgamma(static_cast<long double>(k));
}

TEST(PhiFunctions, AreTheirIntegralsFromTinyToLargeArguments) {
  for (const double size : {1e-12, 1e-6, 1e-3, 0.1, 0.9, 2.0, 3.9, 4.1, 10.0, 100.0, 1000.0}) {
    for (const double angle : {0.4, 0.5, 0.503, 0.6, 0.75, 0.9, 1.0}) {  // half turns
      if (angle < 0.5 && size > 100.0) continue;
      const Complex z = std::polar(size, angle * std::numbers::pi);
      const auto phi = phi_functions(z);
      EXPECT_LT(std::abs(phi[0] - std::exp(z)), 1e-300 + 1e-15 * std::abs(phi[0]));
      for (int k = 1; k <= 4; ++k) {
        const Complex expected(phi_by_quadrature(k, z));
        const double scale =
            std::max(std::abs(expected), 1.0 / (std::max(size, 1.0) * std::tgamma(k)));
        EXPECT_LT(std::abs(phi[static_cast<std::size_t>(k)] - expected),
                  (2e-15 + 2e-16 * std::abs(z.imag())) * scale)
            << k << " of " << z;
      }
    }
  }
}

TEST(CollocationPolynomials, AreThoseOfRadau) {
  const Eigen::Matrix4d polynomials = collocation_polynomials();
  const auto value = [&](int row, double s) {
    return polynomials.row(row).dot(Eigen::RowVector4d(1.0, s, s * s, s * s * s));
  };
  const auto moment = [&](int row, int power) {
    double sum = 0.0;
    for (int i = 0; i < 4; ++i) sum += polynomials(row, i) / (i + power + 1);
    return sum;
  };
  for (int k = 0; k < 4; ++k) {
    for (int j = 0; j < 3; ++j) {
      EXPECT_NEAR(value(k, collocation_points[static_cast<std::size_t>(j)]), k == j ? 1.0 : 0.0,
                  1e-14);
    }
  }
  EXPECT_NEAR(value(3, 0.0), 1.0, 1e-15);
  EXPECT_EQ(polynomials.topRightCorner(3, 1).norm(), 0.0);
  // The weights of the rule (Hairer, Wanner, table IV.5.6), and that it is exact to degree 4.
  EXPECT_NEAR(moment(0, 0), (16.0 - std::sqrt(6.0)) / 36.0, 1e-15);
  EXPECT_NEAR(moment(1, 0), (16.0 + std::sqrt(6.0)) / 36.0, 1e-15);
  EXPECT_NEAR(moment(2, 0), 1.0 / 9.0, 1e-15);
  EXPECT_NEAR(moment(3, 0), 0.0, 1e-15);
  EXPECT_NEAR(moment(3, 1), 0.0, 1e-15);
}

TEST(ExponentialCollocation, OfAnIntegratorIsTheRungeKuttaMethodItself) {
  // dx/dt = n: the coefficients of Radau IIA (Hairer, Wanner, table IV.5.6).
  const double h = 0.3, root = std::sqrt(6.0);
  Eigen::Matrix3d radau;
  radau << (88.0 - 7.0 * root) / 360.0, (296.0 - 169.0 * root) / 1800.0,
      (-2.0 + 3.0 * root) / 225.0, (296.0 + 169.0 * root) / 1800.0, (88.0 + 7.0 * root) / 360.0,
      (-2.0 - 3.0 * root) / 225.0, (16.0 - root) / 36.0, (16.0 + root) / 36.0, 1.0 / 9.0;
  for (const double largest_condition : {1e8, 0.0}) {
    const auto step = ExponentialCollocation(scalar_system(0.0), largest_condition).step(h);
    EXPECT_LT((step.channels_to_stages - h * radau).norm(), 1e-15);
    EXPECT_LT((step.drive_to_end - h * radau.row(2)).norm(), 1e-15);
    EXPECT_LT((step.start_to_stages - Eigen::Vector3d::Ones()).norm(), 1e-15);
  }
}

TEST(ExponentialCollocation, IsTheSameByModesAndDensely) {
  reference::RandomNumbers random(51);
  for (int trial = 0; trial < 30; ++trial) {
    reference::RandomSystemOptions shape;
    shape.inputs = random.integer(2, 5);
    shape.outputs = random.integer(2, 5);
    shape.feedthrough = false;
    const auto system = with_cubes(reference::random_stable_system(random, shape), 2);
    const ExponentialCollocation modal(system, 1e12), dense(system, 0.0);
    ASSERT_TRUE(modal.by_modes());
    ASSERT_FALSE(dense.by_modes());
    const Eigen::Index n = system.linear.a.rows(), m = shape.inputs - 2;
    const Eigen::VectorXd x = random.matrix(n, 1);
    EXPECT_LT((modal.to_state(modal.to_coordinates(x)) - x).norm(), 1e-12 * x.norm());
    for (const double h : {1e-9, 1e-4, 0.02, 1.0, 30.0}) {
      const CollocationStep one = modal.step(h), two = dense.step(h);
      const auto near = [&](const Eigen::MatrixXd& found, const Eigen::MatrixXd& expected) {
        const double scale = expected.size() > 0 ? expected.cwiseAbs().maxCoeff() : 0.0;
        return found.size() == 0 || (found - expected).cwiseAbs().maxCoeff() <= 2e-11 * scale;
      };
      Eigen::VectorXd v = modal.to_coordinates(x), w = x, scratch(n);
      EXPECT_TRUE(near(one.start_to_stages.leftCols(n) * v, two.start_to_stages.leftCols(n) * w));
      one.propagate(v, scratch);
      two.propagate(w, scratch);
      EXPECT_TRUE(near(modal.to_state(v), w));
      EXPECT_TRUE(near(one.start_to_stages.rightCols(2 * m), two.start_to_stages.rightCols(2 * m)));
      EXPECT_TRUE(near(one.channels_to_stages, two.channels_to_stages));
      for (Eigen::Index i = 0; i < two.drive_to_end.cols(); ++i) {
        EXPECT_TRUE(near(modal.to_state(one.drive_to_end.col(i)), two.drive_to_end.col(i)));
      }
      // Tiny differences of large terms: relative to what the channels' outputs do themselves.
      EXPECT_LT((one.error_to_stages - two.error_to_stages).norm(),
                1e-10 * system.linear.c.norm() * two.drive_to_end.norm());
      // The last stage is the end of the step.
      const numerics::HeldTransition held =
          numerics::held_transition(system.linear.a, system.linear.b.leftCols(m), h);
      EXPECT_TRUE(near(two.transition, held.state));
      EXPECT_TRUE(near(two.drive_to_end.middleCols(m, m), held.ramp));
      EXPECT_TRUE(near(two.drive_to_end.leftCols(m), held.step - held.ramp));
      EXPECT_TRUE(near(two.start_to_stages.bottomLeftCorner(2, n),
                       system.linear.c.topRows(2) * held.state));
    }
  }
}

// Steps of one length, Newton's method to rounding.
double with_steps(const FeedbackSystem& system, double start, double end, int count) {
  const ExponentialCollocation collocation(system, highest_modal_condition);
  const CollocationStep step = collocation.step(end / count);
  StageSolver solver(system.channels, 1, 1);
  Eigen::VectorXd v = collocation.to_coordinates(Eigen::VectorXd::Constant(1, start)), scratch(1);
  Eigen::VectorXd n = Eigen::VectorXd::Zero(3);
  for (int i = 0; i < count; ++i) {
    const auto outcome =
        solver.solve(step, step.start_to_stages * v, Eigen::VectorXd::Constant(1, 1e-13), n);
    EXPECT_EQ(outcome, StageSolver::Outcome::converged);
    step.propagate(v, scratch);
    v += step.drive_to_end * n;
  }
  return collocation.to_state(v)[0];
}

TEST(ExponentialCollocation, IsOfOrderFive) {
  // dx/dt = a x - x^3: 1/x^2 = (1/x0^2 - 1/a) e^(-2 a t) + 1/a.
  for (const double a : {-1.0, -0.1, 0.7}) {
    const double expected = 1.0 / std::sqrt((1.0 - 1.0 / a) * std::exp(-2.0 * a) + 1.0 / a);
    double last = 0.0;
    for (const int count : {4, 8, 16, 32}) {
      const double error = std::abs(with_steps(scalar_system(a), 1.0, 1.0, count) - expected);
      if (count > 4) {
        EXPECT_NEAR(std::log2(last / error), 5.0, 0.4) << a << ' ' << count;
      }
      last = error;
    }
  }
}

TEST(ExponentialCollocation, DampsWhatIsStiffAsRadauDoes) {
  // dx/dt = n = -rate x: one step is the stability function, (1 + 2 z/5 + z^2/20)/(1 - 3 z/5 +
  // 3 z^2/20 - z^3/60), which vanishes at -infinity (Hairer, Wanner, table IV.3.1).
  for (const double rate : {1.0, 30.0, 1e3, 1e6, 1e12}) {
    FeedbackSystem system = scalar_system(0.0);
    system.channels = std::make_shared<const Decay>(rate);
    const double z = -rate;
    const double expected =
        (1.0 + 0.4 * z + z * z / 20.0) / (1.0 - 0.6 * z + 0.15 * z * z - z * z * z / 60.0);
    EXPECT_NEAR(with_steps(system, 1.0, 1.0, 1), expected, 1e-14);
  }
}

TEST(ExponentialCollocation, NamesWhatItRefuses) {
  const ExponentialCollocation lag(scalar_system(-1.0), highest_modal_condition);
  for (const double bad : {0.0, -1.0, std::nan("")}) {
    EXPECT_THAT(reference::Call([&] { lag.step(bad); }),
                ThrowsMessage<InvalidInput>(HasSubstr("a step above 0")));
  }
  for (const double largest_condition : {1e8, 0.0}) {
    EXPECT_THROW(ExponentialCollocation(scalar_system(5.0), largest_condition).step(1e3),
                 NumericalFailure);
  }
  FeedbackSystem system = scalar_system(-1.0);
  system.linear.d(0, 0) = 0.5;
  EXPECT_THAT(reference::Call([&] { feedback_matrices(system); }),
              ThrowsMessage<InvalidInput>(HasSubstr("found 'z' = 0.5 'n'")));
  system = scalar_system(-1.0);
  system.channel_inputs = 3;
  EXPECT_THAT(reference::Call([&] { feedback_matrices(system); }),
              ThrowsMessage<InvalidInput>(HasSubstr("at most 1 channel outputs and 2")));
  system.channel_inputs = 2;
  EXPECT_THAT(reference::Call([&] { feedback_matrices(system); }),
              ThrowsMessage<InvalidInput>(HasSubstr("1 outputs and 2 inputs, found 1 and 1")));
  system.channels = nullptr;
  EXPECT_THAT(reference::Call([&] { feedback_matrices(system); }),
              ThrowsMessage<InvalidInput>(HasSubstr("found none")));
  system = scalar_system(-1.0);
  system.linear.sample_time = 0.1;
  EXPECT_THAT(reference::Call([&] { feedback_matrices(system); }),
              ThrowsMessage<InvalidInput>(HasSubstr("sample time of 0.1 s")));
}

}  // namespace
}  // namespace boresight::plant
