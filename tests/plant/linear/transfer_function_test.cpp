#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "random_numbers.hpp"
#include "reference_values.hpp"
#include "refused_call.hpp"
#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/linear/transfer_function.hpp>

namespace boresight::plant {
namespace {

using Complex = std::complex<double>;
using Roots = std::vector<Complex>;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

Complex formula(const Roots& zeros, const Roots& poles, double gain, Complex s) {
  Complex value = gain;
  for (std::size_t i = 0; i < std::max(zeros.size(), poles.size()); ++i) {
    if (i < zeros.size()) value *= s - zeros[i];
    if (i < poles.size()) value /= s - poles[i];
  }
  return value;
}

Roots random_roots(reference::RandomNumbers& random, int size, double low, double high) {
  Roots roots;
  while (static_cast<int>(roots.size()) < size) {
    const double magnitude = random.log_uniform(low, high), angle = random.uniform(0.1, 3.0);
    if (random.integer(0, 1) == 0 || static_cast<int>(roots.size()) + 1 == size) {
      roots.emplace_back(random.integer(0, 3) == 0 ? magnitude : -magnitude, 0.0);
    } else {
      roots.push_back(std::polar(magnitude, angle));
      roots.push_back(std::conj(roots.back()));
    }
  }
  return roots;
}

TEST(ZerosPolesGain, HasTheResponseOfItsFactors) {
  reference::RandomNumbers random(51);
  for (int trial = 0; trial < 200; ++trial) {
    // Poles over eight decades; each zero within a factor of three of a pole of its own.
    const Roots poles = random_roots(random, random.integer(0, 13), 1e-4, 1e4);
    Roots zeros;
    for (const Complex pole : poles) {
      if (pole.imag() < 0.0 || random.integer(0, 2) == 0) continue;
      zeros.push_back(pole * random.log_uniform(1.0 / 3.0, 3.0));
      if (pole.imag() > 0.0) zeros.push_back(std::conj(zeros.back()));
    }
    const double gain = random.log_uniform(1e-9, 1e9);
    const auto system = zeros_poles_gain(zeros, poles, gain, "u", "y", "x");
    EXPECT_EQ(system.states.size(), poles.size());
    for (const double w : {1e-5, 1e-2, 0.7, 30.0, 1e5}) {
      EXPECT_LT(reference::relative_error(frequency_response(system, w)(0, 0),
                                          formula(zeros, poles, gain, {0.0, w})),
                1e-11)
          << trial << ", " << w;
    }
  }
}

TEST(ZerosPolesGain, WithZerosAnywhereIsExactBesideItsLargestResponse) {
  reference::RandomNumbers random(53);
  for (int trial = 0; trial < 200; ++trial) {
    const Roots poles = random_roots(random, random.integer(0, 13), 1e-4, 1e4);
    const Roots zeros =
        random_roots(random, random.integer(0, static_cast<int>(poles.size())), 1e-4, 1e4);
    const auto system = zeros_poles_gain(zeros, poles, 1.0, "u", "y", "x");
    double largest = 0.0, worst = 0.0;
    for (double w = 1e-6; w < 1e6; w *= 3.0) {
      const Complex expected = formula(zeros, poles, 1.0, {0.0, w});
      largest = std::max(largest, std::abs(expected));
      worst = std::max(worst, std::abs(frequency_response(system, w)(0, 0) - expected));
    }
    EXPECT_LT(worst, 1e-9 * largest) << trial;
  }
}

TEST(ZerosPolesGain, OfASampledSystemIsInZ) {
  reference::RandomNumbers random(52);
  for (int trial = 0; trial < 100; ++trial) {
    const Roots poles = random_roots(random, random.integer(1, 8), 0.3, 1.0);
    const Roots zeros =
        random_roots(random, random.integer(0, static_cast<int>(poles.size())), 0.1, 2.0);
    const auto system = zeros_poles_gain(zeros, poles, 3.0, "u", "y", "x", 0.02);
    EXPECT_EQ(system.sample_time, 0.02);
    for (const double turn : {1e-3, 0.4, 3.1}) {
      EXPECT_LT(reference::relative_error(frequency_response(system, turn / 0.02)(0, 0),
                                          formula(zeros, poles, 3.0, std::polar(1.0, turn))),
                1e-11);
    }
  }
  // Poles and zeros at z = 1 and 0.
  const auto delay = zeros_poles_gain({0.0}, {1.0, 0.0, 0.0}, -2.0, "u", "y", "x", 1.0);
  const Complex z = std::polar(1.0, 0.3);
  EXPECT_LT(std::abs(frequency_response(delay, 0.3)(0, 0) + 2.0 / (z * (z - 1.0))), 1e-14);
}

TEST(ZerosPolesGain, OfTheReferencesHighOrdersKeepsItsDigits) {
  const auto check = [](const nlohmann::json& file) {
    const auto zeros = reference::complex_numbers(file.at("zeros"));
    const auto poles = reference::complex_numbers(file.at("poles"));
    const double gain = file.at("gain");
    const auto system = zeros_poles_gain(zeros, poles, gain, "u", "y", "x");
    for (double w = 1e-6; w < 1e5; w *= 1.7) {
      EXPECT_LT(reference::relative_error(frequency_response(system, w)(0, 0),
                                          formula(zeros, poles, gain, {0.0, w})),
                1e-12)
          << w;
    }
    Eigen::VectorXcd found = numerics::eigenvalues(system.a);
    for (const Complex pole : poles) {
      EXPECT_LT((found.array() - pole).abs().minCoeff(), 1e-7 * std::abs(pole));
    }
  };
  check(reference::case_of(reference::reference_values("norms_gramians").at("hinf_h2"),
                           "issue_cs1014")
            .at("system")
            .at("P_zpk"));
  check(reference::case_of(reference::reference_values("margins").at("cases"), "pc_example21_K1000")
            .at("system"));
}

TEST(ZerosPolesGain, OfIntegratorsAndDoublePolesIsExact) {
  const auto mass = zeros_poles_gain({}, {0.0, 0.0}, 4.0, "u", "y", "mass");
  EXPECT_THAT(mass.states, ElementsAre("mass.1", "mass.2"));
  EXPECT_LT(std::abs(frequency_response(mass, 2.0)(0, 0) + 1.0), 1e-15);
  const auto notch = zeros_poles_gain({{0.0, 5.0}, {0.0, -5.0}}, {-5.0, -5.0}, 1.0, "u", "y", "x");
  EXPECT_EQ(std::abs(frequency_response(notch, 5.0)(0, 0)), 0.0);
  EXPECT_NEAR(frequency_response(notch, 0.0)(0, 0).real(), 1.0, 1e-15);
  const auto gain = zeros_poles_gain({}, {}, -7.0, "u", "y", "x");
  EXPECT_EQ(gain.d(0, 0), -7.0);
  const auto differentiator = zeros_poles_gain({0.0}, {-1e3}, 1e3, "u", "y", "x");
  EXPECT_LT(
      reference::relative_error(frequency_response(differentiator, 1e-3)(0, 0), Complex{0.0, 1e-3}),
      2e-6);
}

TEST(ZerosPolesGain, NamesWhatItRefuses) {
  const auto refused = [](const Roots& zeros, const Roots& poles, double gain,
                          const char* message) {
    EXPECT_THAT(reference::Call([&] { zeros_poles_gain(zeros, poles, gain, "u", "y", "lead"); }),
                ThrowsMessage<InvalidInput>(HasSubstr(message)));
  };
  refused({-1.0, -2.0}, {-3.0}, 1.0, "'lead': expected no more zeros than poles");
  refused({}, {{-1.0, 2.0}}, 1.0, "the complex pole -1 +2j has no conjugate");
  refused({{0.0, -2.0}}, {-1.0, -2.0}, 1.0, "the complex zero 0 -2j has no conjugate");
  refused({}, {{-1.0, 2.0}, {-1.0, -2.1}}, 1.0, "no conjugate");
  refused({}, {std::nan("")}, 1.0, "a pole is not finite");
  refused({}, {-1.0}, HUGE_VAL, "gain is not finite");
  EXPECT_THAT(reference::Call([] { zeros_poles_gain({}, {-1.0}, 1.0, "u", "y", "x", -1.0); }),
              ThrowsMessage<InvalidInput>(HasSubstr("sample time")));
}

}  // namespace
}  // namespace boresight::plant
