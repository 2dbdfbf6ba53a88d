
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boresight/identification/signals/local_polynomial_response.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/normal_numbers.hpp>

namespace boresight::identification {
namespace {

using Eigen::Index;

constexpr double dt = 0.01;

// y[n] = 2 r cos(turn) y[n-1] - r^2 y[n-2] + u[n], ringing already at the begin.
struct Resonator {
  double r = 0.995, turn = 0.05;
  Eigen::VectorXd run(const Eigen::VectorXd& u, double start) const {
    Eigen::VectorXd y(u.size());
    double last = start, before = -start;
    for (Index n = 0; n < u.size(); ++n) {
      y[n] = 2.0 * r * std::cos(turn) * last - r * r * before + u[n];
      before = last;
      last = y[n];
    }
    return y;
  }
  std::complex<double> at(double hertz) const {
    const auto z = std::polar(1.0, -two_pi * hertz * dt);
    return 1.0 / (1.0 - 2.0 * r * std::cos(turn) * z + r * r * z * z);
  }
};

Eigen::VectorXd sweep(Index samples, double lowest, double highest) {
  Eigen::VectorXd u(samples);
  const double length = dt * static_cast<double>(samples), octaves = std::log(highest / lowest);
  for (Index n = 0; n < samples; ++n) {
    const double t = dt * static_cast<double>(n);
    u[n] = std::sin(two_pi * lowest * length / octaves * std::expm1(octaves * t / length));
  }
  return u;
}

TEST(LocalPolynomialResponse, FindsAResonanceInOneSweepDespiteItsTransients) {
  const Resonator resonator;
  const Eigen::VectorXd u = sweep(12000, 0.1, 8.0);
  Eigen::MatrixXd y(u.size(), 2);
  y.col(0) = resonator.run(u, 50.0);
  y.col(1) = -3.0 * u;
  const auto estimate = local_polynomial_response(u, y, dt, {0.3, 6.0});
  EXPECT_NEAR(estimate.frequency[0], 0.3, 1.0 / 120.0);
  for (Index k = 0; k < estimate.frequency.size(); ++k) {
    const auto exact = resonator.at(estimate.frequency[k]);
    EXPECT_LT(std::abs(estimate.response(k, 0) - exact), 0.03 * std::abs(exact))
        << estimate.frequency[k];
    EXPECT_LT(std::abs(estimate.response(k, 1) + 3.0), 1e-9);
    EXPECT_GT(estimate.coherence(k, 0), 0.99);
  }
}

TEST(LocalPolynomialResponse, StatesTheErrorsItMakes) {
  const Resonator resonator;
  const Eigen::VectorXd u = sweep(12000, 0.1, 8.0);
  const Eigen::VectorXd clean = resonator.run(u, 0.0);
  double own = 0.0, cross = 0.0, count = 0.0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const numerics::NormalNumbers numbers(seed);
    Eigen::MatrixXd y(u.size(), 2);
    for (Index n = 0; n < u.size(); ++n) {
      // Half of the second output's noise is the first's.
      const auto noise = 5.0 * numbers.pair(static_cast<std::uint64_t>(n));
      y(n, 0) = clean[n] + noise.real();
      y(n, 1) = u[n] + noise.real() + noise.imag();
    }
    const auto estimate = local_polynomial_response(u, y, dt, {0.5, 5.0});
    for (Index k = 0; k < estimate.frequency.size(); k += 15) {
      const auto& covariance = estimate.covariance[static_cast<std::size_t>(k)];
      const auto first = estimate.response(k, 0) - resonator.at(estimate.frequency[k]);
      const auto second = estimate.response(k, 1) - 1.0;
      own += std::norm(first) / covariance(0, 0).real();
      cross += (first * std::conj(second)).real() /
               std::sqrt(covariance(0, 0).real() * covariance(1, 1).real());
      count += 1.0;
    }
  }
  // |e|^2/var of q degrees of freedom has mean q/(q - 1), q = 9; the correlation is sqrt(1/2).
  EXPECT_NEAR(own / count, 9.0 / 8.0, 0.12);
  EXPECT_NEAR(cross / count, std::sqrt(0.5) * 9.0 / 8.0, 0.12);
}

TEST(LocalPolynomialResponse, KnowsNoUnits) {
  const Eigen::VectorXd u = sweep(4000, 0.2, 8.0);
  const Eigen::MatrixXd y = Resonator().run(u, 1.0);
  const auto estimate = local_polynomial_response(u, y, dt, {0.5, 5.0});
  const auto scaled = local_polynomial_response(1e-6 * u, 1e9 * y, dt, {0.5, 5.0});
  EXPECT_LT((scaled.response / 1e15 - estimate.response).norm(), 1e-9 * estimate.response.norm());
  EXPECT_LT((scaled.coherence - estimate.coherence).norm(), 1e-9);
}

TEST(LocalPolynomialResponse, RefusesWhatSaysNothing) {
  const Eigen::VectorXd u = sweep(4000, 0.2, 8.0);
  const Eigen::MatrixXd y = u;
  const auto message = [&](const Eigen::VectorXd& input, const Eigen::MatrixXd& output, double step,
                           const LocalPolynomialOptions& options) -> std::string {
    try {
      local_polynomial_response(input, output, step, options);
    } catch (const Error& error) {
      return error.what();
    }
    return "nothing thrown";
  };
  using ::testing::HasSubstr;
  EXPECT_THAT(message(u, y.topRows(100), dt, {0.5, 5.0}), HasSubstr("as long as the input (4000"));
  EXPECT_THAT(message(u, y, dt, {5.0, 0.5}), HasSubstr("0 < lowest < highest"));
  EXPECT_THAT(message(u, y, dt, {0.5, 5.0, 2, 3}), HasSubstr("half width"));
  EXPECT_THAT(message(u, y, dt, {0.001, 0.002}), HasSubstr("use a longer record"));
  EXPECT_THAT(message(Eigen::VectorXd::Zero(4000), y, dt, {0.5, 5.0}), HasSubstr("no power there"));
  Eigen::VectorXd impulse = Eigen::VectorXd::Zero(4000);
  impulse[0] = 1.0;
  EXPECT_THAT(message(impulse, y, dt, {0.5, 5.0}), HasSubstr("or an impulse"));
}

}  // namespace
}  // namespace boresight::identification
