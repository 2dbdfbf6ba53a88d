#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "peer_family.hpp"
#include "random_numbers.hpp"
#include "reference_values.hpp"
#include "refused_call.hpp"
#include <boresight/control/analysis/h2_norm.hpp>
#include <boresight/control/equations/lyapunov.hpp>
#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::control {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using reference::relative_error;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double infinity = std::numeric_limits<double>::infinity();

plant::StateSpace random_system(reference::RandomNumbers& random, Index n, bool sampled) {
  MatrixXd a = random.matrix(n, n);
  if (sampled) {
    a *= random.uniform(0.3, 0.99) / numerics::eigenvalues(a).cwiseAbs().maxCoeff();
  } else {
    a.diagonal().array() -= numerics::spectral_abscissa(a) + random.log_uniform(0.01, 1.0);
  }
  return reference::state_space(a, random.matrix(n, 2), random.matrix(3, n),
                                sampled ? random.matrix(3, 2) : MatrixXd::Zero(3, 2),
                                sampled ? 0.1 : 0.0);
}

// sqrt(1/(2 pi) integral of |H|^2): over the axis by w = tan(x/2), over the circle directly; the
// trapezoid rule on a periodic integrand converges geometrically.
double by_quadrature(const plant::StateSpace& system, int points) {
  const bool sampled = system.sample_time > 0.0;
  double sum = 0.0;
  for (int k = 0; k < points; ++k) {
    const double x = std::numbers::pi * ((2.0 * k + 1.0) / points - 1.0);
    const double w = sampled ? x / system.sample_time : std::tan(0.5 * x);
    const double weight = sampled ? 1.0 : 0.5 * (1.0 + w * w);
    sum += weight * plant::frequency_response(system, w).squaredNorm();
  }
  return std::sqrt(sum / points);
}

TEST(H2Norm, OfTheReferenceSystems) {
  const auto file = reference::reference_values("norms_gramians");
  for (const char* id : {"pc_G1", "pc_G4"}) {
    const auto entry = reference::case_of(file.at("hinf_h2"), id);
    const auto system = reference::system_of(entry.at("system"));
    EXPECT_LT(relative_error(h2_norm(system).value, entry.at("h2")), 1e-12) << id;
    EXPECT_LT(relative_error(l2_norm(system).value, entry.at("h2")), 1e-12) << id;
    const auto held = reference::zero_order_hold(system, 0.1);
    EXPECT_LT(relative_error(l2_norm(held).value, h2_norm(held).value), 1e-14) << id;
    if (std::string(id) == "pc_G1") continue;
    EXPECT_LT(relative_error(h2_norm(held).value, entry.at("zoh_Ts0.1").at("h2")), 1e-12) << id;
  }
}

TEST(H2Norm, OfASampledLagIsTheClosedFormNotTheReference) {
  // y[k+1] = p y[k] + (1 - p) u[k] with p = exp(-T): (1 - p)/sqrt(1 - p^2) = sqrt(tanh(T/2)). The
  // reference is 1.1e-8 low.
  const auto file = reference::reference_values("norms_gramians");
  const auto entry = reference::case_of(file.at("hinf_h2"), "pc_G1");
  const double closed_form = std::sqrt(std::tanh(0.05));
  const double reference_value = entry.at("zoh_Ts0.1").at("h2");
  EXPECT_NEAR(relative_error(reference_value, closed_form), 1.08e-8, 1e-10);
  const auto held = reference::zero_order_hold(reference::system_of(entry.at("system")), 0.1);
  EXPECT_LT(relative_error(h2_norm(held).value, closed_form), 1e-14);
  EXPECT_LT(relative_error(by_quadrature(held, 2000), closed_form), 1e-13);
}

TEST(H2Norm, OfWhatIsNotStableIsInfiniteWithItsReason) {
  const auto file = reference::reference_values("norms_gramians");
  const auto unstable =
      reference::system_of(reference::case_of(file.at("hinf_h2"), "pc_G2_unstable").at("system"));
  const H2Norm norm = h2_norm(unstable);
  EXPECT_EQ(norm.value, infinity);
  EXPECT_THAT(norm.reason, HasSubstr("found one at 1"));
  EXPECT_EQ(norm.stability_margin, -1.0);
  // Its mirror image has the same magnitude on the axis.
  EXPECT_NEAR(l2_norm(unstable).value, std::sqrt(0.5), 1e-15);
  EXPECT_EQ(l2_norm(unstable).reason, "");

  const auto oscillator =
      reference::system_of(reference::case_of(file.at("hinf_h2"), "pc_G3_imag_axis").at("system"));
  EXPECT_EQ(h2_norm(oscillator).value, infinity);
  EXPECT_THAT(h2_norm(oscillator).reason, HasSubstr("not stable"));
  EXPECT_EQ(l2_norm(oscillator).value, infinity);
  EXPECT_THAT(l2_norm(oscillator).reason, HasSubstr("on the imaginary axis"));

  auto through = plant::rational({1.0, 2.0}, {1.0, 1.0}, "u", "y", "x");
  EXPECT_EQ(h2_norm(through).value, infinity);
  EXPECT_THAT(h2_norm(through).reason, HasSubstr("feedthrough"));
  EXPECT_EQ(l2_norm(through).value, infinity);
  EXPECT_EQ(h2_norm(through).stability_margin, 1.0);

  auto integrator = reference::state_space(MatrixXd::Ones(1, 1), MatrixXd::Ones(1, 1),
                                           MatrixXd::Ones(1, 1), MatrixXd::Zero(1, 1), 0.1);
  EXPECT_THAT(h2_norm(integrator).reason, HasSubstr("unit circle"));
  EXPECT_THAT(l2_norm(integrator).reason, HasSubstr("unit circle"));
}

TEST(H2Norm, OfSlicotsUnstableExampleAlongTheAxis) {
  reference::SlicotData data("AB13BD.dat");
  const MatrixXd a = data.next_matrix(7, 7);
  const MatrixXd b = data.next_matrix(7, 2);
  const MatrixXd c = data.next_matrix(3, 7);
  const auto system = reference::state_space(a, b, c, data.next_matrix(3, 2));
  const auto printed = reference::slicot_result("AB13BD.res", "L2-norm of the system =")[0][0];
  // SLICOT takes the numerator of a coprime factorisation; here the two sides are added; and the
  // integral itself is a third route.
  EXPECT_NEAR(l2_norm(system).value, printed.value, printed.half_unit);
  EXPECT_LT(relative_error(l2_norm(system).value, by_quadrature(system, 2000)), 1e-12);
  EXPECT_EQ(h2_norm(system).value, infinity);
}

TEST(H2Norm, IsTheIntegralOverFrequency) {
  reference::RandomNumbers random(61);
  for (int trial = 0; trial < 20; ++trial) {
    const auto system = random_system(random, random.integer(1, 8), trial % 2 == 1);
    EXPECT_LT(relative_error(h2_norm(system).value, by_quadrature(system, 20000)), 1e-10);
    EXPECT_LT(relative_error(l2_norm(system).value, h2_norm(system).value), 1e-12);
  }
}

TEST(H2Norm, OfRandomTwoSidedSystemsAlongTheAxis) {
  reference::RandomNumbers random(62);
  int compared = 0;
  while (compared < 20) {
    const bool sampled = compared % 2 == 1;
    auto system = random_system(random, random.integer(2, 8), sampled);
    // Poles on both sides, none near the boundary.
    if (sampled) {
      system.a *= 1.7;
    } else {
      system.a.diagonal().array() += 1.0;
    }
    const Eigen::VectorXcd poles = numerics::eigenvalues(system.a);
    const double nearest = sampled ? (poles.cwiseAbs().array() - 1.0).abs().minCoeff()
                                   : poles.real().cwiseAbs().minCoeff();
    if (nearest < 0.01) continue;
    ++compared;
    EXPECT_LT(relative_error(l2_norm(system).value, by_quadrature(system, 20000)), 1e-9);
  }
}

TEST(H2Norm, GivesThePeersRms) {
  const auto peers = reference::peer_values();
  for (const int modes : {5, 50}) {
    const auto loop = reference::channel(reference::peer_closed_loop(modes), "n", "y");
    const double expected = peers.at("h2").at(std::to_string(modes)).at("val").at(0);
    EXPECT_LT(relative_error(h2_norm(loop).value, expected), 1e-9);
  }
}

TEST(H2Norm, KeepsTheDigitsOfAnOutputThatSeesLittle) {
  // H = 1/(s + 1) - 1/(s + 1 + e): of the covariance's elements, all near 1/2, 13 digits cancel.
  const double e = 1e-6;
  MatrixXd a = MatrixXd::Zero(2, 2);
  a(0, 0) = -1.0;
  a(1, 1) = -1.0 - e;
  MatrixXd c(1, 2);
  c << 1.0, -1.0;
  const auto system = reference::state_space(a, MatrixXd::Ones(2, 1), c, MatrixXd::Zero(1, 1));
  // 1/2 + 1/(2 + 2 e) - 2/(2 + e) = e^2/(2 (1 + e) (2 + e)), with the e that -1 - e rounds to.
  const double difference = a(0, 0) - a(1, 1);
  const double expected = difference / std::sqrt(2.0 * (1.0 + e) * (2.0 + e));
  EXPECT_LT(relative_error(h2_norm(system).value, expected), 1e-9);
}

TEST(H2Norm, IsNotLedAstrayByACouplingThatIsARoundingError) {
  // A chain of lags into an oscillator, and a rounding error back within the chain, which balancing
  // A alone takes for a coupling: scales then run apart by 10^56 and the chain is lost.
  constexpr Index stages = 6, n = stages + 2;
  MatrixXd a = MatrixXd::Zero(n, n);
  for (Index i = 0; i < stages; ++i) {
    a(i, i) = -0.01 * std::pow(5.0, static_cast<double>(i));
    for (Index j = 0; j < i; ++j) {
      a(i, j) = -0.2 * a(i, i) / (1.0 + static_cast<double>(i - j));
    }
  }
  a(stages, stages - 1) = 70.0;
  a(stages, stages) = a(stages + 1, stages + 1) = -0.5;
  a(stages, stages + 1) = 3.0;
  a(stages + 1, stages) = -3.0;
  MatrixXd b = MatrixXd::Zero(n, 1);
  b(0, 0) = 1.0;
  const MatrixXd clean = solve_lyapunov(a, b * b.transpose()).covariance;
  a(0, 1) = 1e-18;
  for (Index i = 0; i < n; ++i) {
    MatrixXd c = MatrixXd::Zero(1, n);
    c(0, i) = 1.0;
    const auto system = reference::state_space(a, b, c, MatrixXd::Zero(1, 1));
    EXPECT_LT(relative_error(h2_norm(system).value, std::sqrt(clean(i, i))), 1e-10);
    EXPECT_LT(relative_error(l2_norm(system).value, std::sqrt(clean(i, i))), 1e-10);
    const auto covariance = output_covariance(system, MatrixXd::Ones(1, 1)).covariance;
    EXPECT_LT(relative_error(covariance(0, 0), clean(i, i)), 1e-10);
  }
}

TEST(H2Norm, OfSystemsWithoutStates) {
  const auto gain = plant::static_gain(MatrixXd::Constant(1, 2, 3.0), {"a", "b"}, {"y"});
  EXPECT_EQ(h2_norm(gain).value, infinity);
  EXPECT_EQ(l2_norm(gain).value, infinity);
  auto sampled = gain;
  sampled.sample_time = 0.1;
  EXPECT_NEAR(h2_norm(sampled).value, std::sqrt(18.0), 1e-15);
  EXPECT_NEAR(l2_norm(sampled).value, std::sqrt(18.0), 1e-15);
  EXPECT_EQ(h2_norm(sampled).stability_margin, infinity);
  const auto zero = plant::static_gain(MatrixXd::Zero(1, 1), {"a"}, {"y"});
  EXPECT_EQ(h2_norm(zero).value, 0.0);
  EXPECT_EQ(output_covariance(zero, MatrixXd::Ones(1, 1)).covariance(0, 0), 0.0);
}

TEST(OutputCovariance, OfTheReferenceSystem) {
  const auto entry = reference::reference_values("norms_gramians").at("covariance").at(0);
  const MatrixXd a = reference::matrix(entry.at("A"));
  const MatrixXd b = reference::matrix(entry.at("B"));
  const MatrixXd identity = MatrixXd::Identity(2, 2);
  const auto system = reference::state_space(a, b, identity, MatrixXd::Zero(2, 2));
  const MatrixXd expected = reference::matrix(entry.at("cov"));
  const auto found = output_covariance(system, identity);
  EXPECT_LT((found.covariance - expected).cwiseAbs().maxCoeff(), 0.5e-15);
  EXPECT_EQ(found.reason, "");

  // With D, continuous: infinite where D W D' is, finite between outputs of independent noise.
  auto through = reference::state_space(a, b, identity, identity);
  const auto infinite = output_covariance(through, identity);
  EXPECT_EQ(infinite.covariance(0, 0), infinity);
  EXPECT_EQ(infinite.covariance(1, 1), infinity);
  EXPECT_NEAR(infinite.covariance(0, 1), expected(0, 1), 1e-15);
  EXPECT_THAT(infinite.reason, HasSubstr("feedthrough"));
  MatrixXd against = identity;
  against(0, 1) = against(1, 0) = -0.5;
  EXPECT_EQ(output_covariance(through, against).covariance(0, 1), -infinity);

  // The same matrices as a sampled system.
  through.sample_time = 1.0;
  const MatrixXd sampled = reference::matrix(entry.at("discrete_Ts1_D_I"));
  EXPECT_LT((output_covariance(through, identity).covariance - sampled).cwiseAbs().maxCoeff(),
            0.5e-14);
}

TEST(OutputCovariance, AgreesWithTheLyapunovEquationForAnyIntensity) {
  reference::RandomNumbers random(63);
  for (int trial = 0; trial < 10; ++trial) {
    const bool sampled = trial % 2 == 1;
    const auto system = random_system(random, random.integer(1, 9), sampled);
    const MatrixXd root = random.matrix(2, random.integer(1, 2));
    const MatrixXd w = root * root.transpose();
    const MatrixXd q = system.b * w * system.b.transpose();
    const MatrixXd p = sampled ? solve_discrete_lyapunov(system.a, q).covariance
                               : solve_lyapunov(system.a, q).covariance;
    MatrixXd expected = system.c * p * system.c.transpose();
    if (sampled) expected += system.d * w * system.d.transpose();
    const auto found = output_covariance(system, w);
    EXPECT_LT((found.covariance - expected).norm(), 1e-12 * expected.norm());
    EXPECT_EQ((found.covariance - found.covariance.transpose()).norm(), 0.0);
    EXPECT_NEAR(output_covariance(system, MatrixXd::Identity(2, 2)).covariance.trace(),
                std::pow(h2_norm(system).value, 2), 1e-12 * std::pow(h2_norm(system).value, 2));
  }
}

TEST(OutputCovariance, RefusesAnIntensityThatIsNone) {
  const auto lag = plant::rational({1.0}, {1.0, 1.0}, "u", "y", "x");
  EXPECT_THAT(reference::Call([&] { output_covariance(lag, MatrixXd::Ones(2, 2)); }),
              ThrowsMessage<InvalidInput>(HasSubstr("found 2 x 2")));
  EXPECT_THAT(reference::Call([&] { output_covariance(lag, MatrixXd::Constant(1, 1, -1.0)); }),
              ThrowsMessage<InvalidInput>(HasSubstr("positive semidefinite")));
  EXPECT_THROW(output_covariance(lag, MatrixXd::Constant(1, 1, std::nan(""))), InvalidInput);
  const auto unstable = plant::rational({1.0}, {-1.0, 1.0}, "u", "y", "x");
  const auto found = output_covariance(unstable, MatrixXd::Ones(1, 1));
  EXPECT_EQ(found.covariance(0, 0), infinity);
  EXPECT_THAT(found.reason, HasSubstr("not stable"));
}

}  // namespace
}  // namespace boresight::control
