#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "peer_family.hpp"
#include "random_numbers.hpp"
#include "reference_values.hpp"
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/linear_solve.hpp>
#include <boresight/numerics/vector_clones.hpp>
#include <boresight/plant/linear/dense_response.hpp>

namespace boresight::plant {
namespace {

using Complex = std::complex<double>;
using reference::RandomNumbers;
using reference::relative_error;

template <typename Action>
std::string message_of(Action action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

StateSpace random_system(RandomNumbers& random, Eigen::Index n, Eigen::Index inputs,
                         Eigen::Index outputs, double sample_time) {
  return reference::state_space(random.matrix(n, n), random.matrix(n, inputs),
                                random.matrix(outputs, n), random.matrix(outputs, inputs),
                                sample_time);
}

TEST(DenseResponse, HasTheSameBitsInRegistersOfEveryWidth) {
  RandomNumbers random(40);
  DenseResponse response(random_system(random, 23, 1, 1, 0.0));
  const Eigen::ArrayXd w = Eigen::ArrayXd::LinSpaced(21, 0.01, 20.0);
  Eigen::ArrayXcd expected(w.size()), found(w.size());
  response.evaluate(w, expected, 0, 0);
  for (const std::size_t lanes : {2U, 4U}) {
    const numerics::NarrowRegisters narrow(lanes);
    response.evaluate(w, found, 0, 0);
    EXPECT_TRUE((found == expected).all()) << lanes;
  }
}

TEST(DenseResponse, IsThatOfLinearSolvesAtAnyPoint) {
  RandomNumbers random(401);
  Eigen::MatrixXcd found;
  for (int trial = 0; trial < 300; ++trial) {
    const double sample_time = trial % 3 == 0 ? 0.01 : 0.0;
    const StateSpace system = random_system(random, random.integer(0, 14), random.integer(1, 3),
                                            random.integer(1, 3), sample_time);
    DenseResponse response(system);
    for (int k = 0; k < 10; ++k) {
      const Complex s{random.uniform(-4.0, 4.0), random.uniform(-4.0, 4.0)};
      const Eigen::MatrixXcd expected =
          numerics::transfer_matrix(system.a, system.b, system.c, system.d, s);
      ASSERT_TRUE(response.evaluate(s, found));
      EXPECT_LT((found - expected).norm(), 1e-10 * (1.0 + expected.squaredNorm()))
          << "trial " << trial;
    }
  }
}

TEST(DenseResponse, OfManyFrequenciesIsBitForBitThatOfOne) {
  RandomNumbers random(402);
  for (const double sample_time : {0.0, 0.05}) {
    const StateSpace system = random_system(random, 9, 2, 2, sample_time);
    DenseResponse response(system);
    for (const Eigen::Index count : {1, 7, 8, 9, 50}) {
      const Eigen::ArrayXd frequency = Eigen::ArrayXd::LinSpaced(count, 0.1, 60.0);
      Eigen::ArrayXcd found;
      for (Eigen::Index channel = 0; channel < 4; ++channel) {
        response.evaluate(frequency, found, channel / 2, channel % 2);
        for (Eigen::Index i = 0; i < count; ++i) {
          EXPECT_EQ(found[i], response.channel(frequency[i], channel / 2, channel % 2));
          const Complex expected =
              frequency_response(system, frequency[i])(channel / 2, channel % 2);
          EXPECT_LT(std::abs(found[i] - expected), 1e-11 * (1.0 + std::abs(expected)));
        }
      }
    }
  }
}

TEST(DenseResponse, OfABadlyScaledSystemKeepsItsDigits) {
  const auto file =
      reference::reference_values("riccati_scaling").at("badly_scaled_frequency_response");
  DenseResponse response(reference::matrices_of(file));
  for (const auto& row : file.at("exact").at("values")) {
    EXPECT_LT(relative_error(response.channel(row.at(0)),
                             Complex{row.at(1).get<double>(), row.at(2).get<double>()}),
              1e-12)
        << "at " << row.at(0) << " rad/s";
  }
}

TEST(DenseResponse, IsNotMisledByABalancingPermutation) {
  // Slycot issue 11: 1/(s + 1/2)^2 beside states that the input does not reach.
  const auto file =
      reference::reference_values("riccati_scaling").at("slycot11_tb05ad_balancing_bug");
  DenseResponse response(reference::matrices_of(file));
  const Complex s{file.at("s").at(0), file.at("s").at(1)};
  const Complex found = response.at(s)(0, 0);
  EXPECT_LT(relative_error(found, 1.0 / ((s + 0.5) * (s + 0.5))), 1e-15);
  EXPECT_LT(relative_error(found, Complex{file.at("H").at(0), file.at("H").at(1)}), 1e-15);
}

TEST(DenseResponse, IsThatOfTheSlicotExample) {
  reference::SlicotData data("TB05AD.dat");
  const Eigen::MatrixXd a = data.next_matrix(3, 3), b = data.next_matrix(3, 1),
                        c = data.next_matrix(2, 3);
  const Complex s{0.0, 0.5};
  const auto compare = [&](const Eigen::MatrixXd& rows, const Eigen::MatrixXcd& printed) {
    DenseResponse response(
        reference::state_space(a, b, rows, Eigen::MatrixXd::Zero(rows.rows(), 1)));
    const Eigen::MatrixXcd found = response.at(s);
    for (Eigen::Index i = 0; i < rows.rows(); ++i) {
      EXPECT_NEAR(found(i, 0).real(), printed(i, 0).real(), 0.005);
      EXPECT_NEAR(found(i, 0).imag(), printed(i, 0).imag(), 0.005);
    }
  };
  // TB05AD.res: the response, and (s I - A)^-1 B.
  compare(c, Eigen::Vector2cd(Complex{0.69, 0.35}, Complex{-0.80, -0.40}));
  compare(Eigen::MatrixXd::Identity(3, 3),
          Eigen::Vector3cd(Complex{-0.11, -0.05}, Complex{-0.43, 0.00}, Complex{-0.80, -0.40}));
}

TEST(DenseResponse, OfTheAntennaFamilyIsThatOfOthers) {
  const auto peers = reference::peer_values().at("fr");
  for (const int modes : {5, 50}) {
    DenseResponse response(reference::channel(reference::peer_closed_loop(modes), "t", "y"));
    Eigen::ArrayXcd found;
    response.evaluate(reference::peer_frequencies(), found);
    const auto& value = peers.at(std::to_string(modes)).at("val");
    const double highest = value.at(0);
    EXPECT_LT(relative_error(found.abs().maxCoeff(), highest), 1e-9);
    // Sums of a thousand values that largely cancel.
    EXPECT_NEAR(found.sum().real(), value.at(1), 1e-10 * found.abs().sum());
    EXPECT_NEAR(found.sum().imag(), value.at(2), 1e-10 * found.abs().sum());
  }
}

TEST(DenseResponse, OfSlowSampledPolesKeepsItsDigits) {
  // 1/(z - p1)/(z - p2) with 1 - p of 2^-20 and 2^-21, at w T = 1e-6: z itself has ten digits
  // there.
  const double slow = 0x1p-20, slower = 0x1p-21;
  Eigen::MatrixXd a(2, 2);
  a << 1.0 - slow, 0.0, 1.0, 1.0 - slower;
  DenseResponse response(reference::state_space(a, Eigen::Vector2d(1.0, 0.0),
                                                Eigen::RowVector2d(0.0, 1.0),
                                                Eigen::MatrixXd::Zero(1, 1), 1.0));
  for (const double w : {1e-7, 1e-6, 1e-5, 1e-2}) {
    const Complex offset{-2.0 * std::pow(std::sin(0.5 * w), 2), std::sin(w)};
    EXPECT_LT(relative_error(response.channel(w), 1.0 / ((offset + slow) * (offset + slower))),
              1e-14);
  }
}

TEST(DenseResponse, OfALongWeakChainNeitherOverflowsNorVanishes) {
  // n equal lags, coupled by g: (g/(s + 1))^n/g; balancing may not even out what differs by 1e-250.
  for (const double coupling : {1e-9, 1.0, 1e6}) {
    const Eigen::Index n = 30;
    Eigen::MatrixXd a = -Eigen::MatrixXd::Identity(n, n);
    a.diagonal(-1).setConstant(coupling);
    DenseResponse response(reference::state_space(a, Eigen::VectorXd::Unit(n, 0),
                                                  Eigen::RowVectorXd::Unit(n, n - 1),
                                                  Eigen::MatrixXd::Zero(1, 1)));
    const Complex s{0.0, 0.7};
    const Complex expected = std::pow(coupling / (s + 1.0), 30) / coupling;
    EXPECT_LT(relative_error(response.channel(0.7), expected), 1e-12) << coupling;
  }
}

TEST(DenseResponse, SaysWherePolesAre) {
  // 1/s in the first column, 1/(s + 1) in the second.
  DenseResponse response(
      reference::state_space(Eigen::Vector2d(0.0, -1.0).asDiagonal(), Eigen::Matrix2d::Identity(),
                             Eigen::RowVector2d(1.0, 1.0), Eigen::MatrixXd::Zero(1, 2)));
  Eigen::MatrixXcd found;
  EXPECT_FALSE(response.evaluate(0.0, found));
  EXPECT_TRUE(std::isinf(found(0, 0).real()));
  EXPECT_EQ(found(0, 1), 1.0);
  EXPECT_TRUE(std::isinf(response.channel(0.0, 0, 0).real()));
  EXPECT_TRUE(response.evaluate({0.0, 1e-9}, found));
  EXPECT_NEAR(found(0, 0).imag(), -1e9, 1e-3);
  EXPECT_THAT(message_of([&] { response.at(0.0); }),
              testing::HasSubstr("s = 0 + 0j is a pole of the system"));
  // An undamped oscillator; what no input reaches is no pole.
  Eigen::Matrix3d a;
  a << 0.0, 2.0, 0.0, -2.0, 0.0, 0.0, 0.0, 0.0, 0.0;
  DenseResponse oscillator(reference::state_space(a, Eigen::Vector3d(0.0, 1.0, 0.0),
                                                  Eigen::RowVector3d(1.0, 0.0, 1.0),
                                                  Eigen::MatrixXd::Zero(1, 1)));
  EXPECT_FALSE(oscillator.evaluate({0.0, 2.0}, found));
  EXPECT_TRUE(oscillator.evaluate(0.0, found));
  EXPECT_NEAR(found(0, 0).real(), 0.5, 1e-15);
}

TEST(DenseResponse, OfAStaticGainIsTheGain) {
  DenseResponse response(static_gain(Eigen::MatrixXd::Constant(1, 1, 3.0), {"u"}, {"y"}));
  EXPECT_EQ(response.order(), 0);
  EXPECT_EQ(response.channel(1.0), 3.0);
  EXPECT_EQ(response.at(0.0)(0, 0), 3.0);
}

TEST(DenseResponse, RefusesWhatItCannotAnswer) {
  RandomNumbers random(403);
  DenseResponse response(random_system(random, 3, 1, 2, 0.0));
  EXPECT_THAT(message_of([&] { response.channel(1.0, 2, 0); }),
              testing::HasSubstr("an output below 2 and an input below 1, found 2 and 0"));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(message_of([&] { response.channel(nan); }),
              testing::HasSubstr("expected a finite angular frequency, found nan"));
  EXPECT_THAT(message_of([&] {
                response.at({0.0, nan});
              }),
              testing::HasSubstr("expected a finite s, found 0 + nanj"));
  StateSpace broken = random_system(random, 2, 1, 1, 0.0);
  broken.a(0, 0) = nan;
  EXPECT_THAT(message_of([&] { DenseResponse{broken}; }),
              testing::HasSubstr("A has elements that are not finite"));
}

}  // namespace
}  // namespace boresight::plant
