#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "random_numbers.hpp"
#include "reference_values.hpp"
#include "refused_call.hpp"
#include <boresight/control/analysis/transmission_zeros.hpp>
#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/linear_solve.hpp>
#include <boresight/plant/linear/transfer_function.hpp>

namespace boresight::control {
namespace {

using Complex = std::complex<double>;
using testing::HasSubstr;
using testing::ThrowsMessage;

// Each expected zero has a found one of its own, as near as `tolerance` times its size.
void expect_zeros(const Eigen::VectorXcd& found, std::vector<Complex> expected, double tolerance,
                  const std::string& id) {
  ASSERT_EQ(found.size(), static_cast<Eigen::Index>(expected.size())) << id << "\n" << found;
  for (const Complex zero : found) {
    const auto nearest = std::min_element(
        expected.begin(), expected.end(),
        [&](Complex a, Complex b) { return std::abs(a - zero) < std::abs(b - zero); });
    EXPECT_LT(std::abs(*nearest - zero), tolerance * std::abs(*nearest) + 1e-13) << id;
    expected.erase(nearest);
  }
}

TEST(TransmissionZeros, OfTheReferenceCases) {
  const auto file = reference::reference_values("transmission_zeros");
  for (const auto& entry : file.at("cases")) {
    const std::string id = entry.at("id");
    // The double zero of ex8 is known to the root of the precision only.
    expect_zeros(transmission_zeros(reference::matrices_of(entry)),
                 reference::complex_numbers(entry.at("zeros")), id == "ex8" ? 1e-7 : 1e-10, id);
  }
}

TEST(TransmissionZeros, AreTheZerosOfATransferFunction) {
  reference::RandomNumbers random(71);
  for (int trial = 0; trial < 60; ++trial) {
    std::vector<Complex> zeros, poles;
    const int order = random.integer(1, 8), count = random.integer(0, order);
    const auto fill = [&](std::vector<Complex>& roots, int size) {
      while (static_cast<int>(roots.size()) < size) {
        const double magnitude = random.log_uniform(0.1, 50.0), angle = random.uniform(0.3, 2.8);
        if (random.integer(0, 1) == 0 || static_cast<int>(roots.size()) + 1 == size) {
          roots.emplace_back(random.integer(0, 3) == 0 ? magnitude : -magnitude, 0.0);
        } else {
          roots.push_back(std::polar(magnitude, angle));
          roots.push_back(std::conj(roots.back()));
        }
      }
    };
    fill(zeros, count);
    fill(poles, order);
    auto system =
        plant::zeros_poles_gain(zeros, poles, random.log_uniform(1e-6, 1e6), "u", "y", "x");
    // In units that hide everything.
    for (Eigen::Index i = 0; i < order; ++i) {
      const double unit = random.log_uniform(1e-6, 1e6);
      system.a.row(i) *= unit;
      system.a.col(i) /= unit;
      system.b.row(i) *= unit;
      system.c.col(i) /= unit;
    }
    expect_zeros(transmission_zeros(system), zeros, 1e-7, "trial " + std::to_string(trial));
  }
}

TEST(TransmissionZeros, OfASquareSystemAreThePolesOfItsInverse) {
  reference::RandomNumbers random(72);
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::Index n = random.integer(1, 8), m = random.integer(1, 3);
    const auto system =
        reference::state_space(random.matrix(n, n), random.matrix(n, m), random.matrix(m, n),
                               random.matrix(m, m) + 2.0 * Eigen::MatrixXd::Identity(m, m));
    const Eigen::VectorXcd poles = numerics::eigenvalues(
        system.a - system.b * numerics::linear_solve(system.d, system.c, "inverse"));
    expect_zeros(transmission_zeros(system), {poles.begin(), poles.end()}, 1e-9, "");
    // An added output that repeats another one changes nothing; a generic one leaves no zero.
    auto more = system;
    more.c.conservativeResize(m + 1, n);
    more.d.conservativeResize(m + 1, m);
    more.c.row(m) = -3.0 * system.c.row(0);
    more.d.row(m) = -3.0 * system.d.row(0);
    more.outputs.emplace_back("more");
    expect_zeros(transmission_zeros(more), {poles.begin(), poles.end()}, 1e-8, "repeated");
    more.c.row(m) = random.matrix(1, n);
    EXPECT_EQ(transmission_zeros(more).size(), 0);
    // Transposed: more inputs than outputs.
    auto turned = reference::state_space(more.a.transpose(), more.c.transpose(), more.b.transpose(),
                                         more.d.transpose());
    EXPECT_EQ(transmission_zeros(turned).size(), 0);
  }
}

TEST(TransmissionZeros, LieWhereTheTransferMatrixIsSingular) {
  reference::RandomNumbers random(73);
  for (int trial = 0; trial < 20; ++trial) {
    // Strictly proper, two by two: n - 2 zeros (C B regular).
    const Eigen::Index n = random.integer(3, 9);
    const auto system = reference::state_space(random.matrix(n, n), random.matrix(n, 2),
                                               random.matrix(2, n), Eigen::MatrixXd::Zero(2, 2));
    const auto zeros = transmission_zeros(system);
    EXPECT_EQ(zeros.size(), n - 2);
    for (const Complex zero : zeros) {
      const auto determinant = [&](Complex s) {
        const Eigen::MatrixXcd h =
            numerics::transfer_matrix(system.a, system.b, system.c, system.d, s);
        return h(0, 0) * h(1, 1) - h(0, 1) * h(1, 0);
      };
      EXPECT_LT(std::abs(determinant(zero)), 1e-6 * std::abs(determinant(zero + 0.1)));
    }
  }
}

TEST(TransmissionZeros, OfSystemsWithoutStatesInputsOrResponseNeedNoCare) {
  EXPECT_EQ(
      transmission_zeros(plant::static_gain(Eigen::MatrixXd::Ones(1, 1), {"u"}, {"y"})).size(), 0);
  const auto lag = plant::rational({1.0}, {3.0, 1.0}, "u", "y", "x");
  auto silent = lag;
  silent.b.setZero();
  // No input reaches the lag: its pole is an input decoupling zero, but the pencil's rank is then
  // carried by A alone, and y = 0 forces the state to 0.
  EXPECT_EQ(transmission_zeros(silent).size(), 0);
  auto mute = lag;
  mute.c.resize(0, 1);
  mute.d.resize(0, 1);
  mute.outputs.clear();
  EXPECT_EQ(transmission_zeros(mute).size(), 0);
  EXPECT_THAT(reference::Call([&] { transmission_zeros(lag, {-1.0}); }),
              ThrowsMessage<InvalidInput>(HasSubstr("found -1")));
  auto broken = lag;
  broken.a(0, 0) = std::nan("");
  EXPECT_THROW(transmission_zeros(broken), InvalidInput);
}

}  // namespace
}  // namespace boresight::control
