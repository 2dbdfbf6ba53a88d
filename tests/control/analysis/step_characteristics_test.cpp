#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "peer_family.hpp"
#include "random_numbers.hpp"
#include "reference_values.hpp"
#include "refused_call.hpp"
#include <boresight/control/analysis/step_characteristics.hpp>
#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/matrix_exponential.hpp>
#include <boresight/plant/linear/sampling.hpp>
#include <boresight/plant/linear/time_response.hpp>

namespace boresight::control {
namespace {

using plant::rational;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

plant::StateSpace reference_case(const char* id) {
  const auto file = reference::reference_values("step_info");
  return reference::system_of(reference::case_of(file.at("cases"), id).at("system"));
}

double step_response(const plant::StateSpace& system, double t) {
  return (system.c * numerics::held_transition(system.a, system.b, t).step)(0, 0) + system.d(0, 0);
}

double impulse_response(const plant::StateSpace& system, double t) {
  return (system.c * numerics::matrix_exponential(t * system.a) * system.b)(0, 0);
}

void expect_near(double found, double expected, double relative) {
  EXPECT_NEAR(found, expected, relative * std::abs(expected));
}

TEST(StepCharacteristics, OfTheReferenceCasesToTheirVerifiedDigits) {
  const auto file = reference::reference_values("step_info");
  int verified = 0;
  for (const auto& entry : file.at("cases")) {
    if (!entry.contains("verified")) continue;
    ++verified;
    const auto system = reference::system_of(entry.at("system"));
    const auto found = step_characteristics(system);
    const auto expect = [&](const char* key, double value, double unit) {
      const auto& list = entry.at("verified");
      if (!list.contains(key)) return;
      const auto printed = reference::printed_number(list.at(key));
      EXPECT_NEAR(value * unit, printed.value, std::max(printed.half_unit, 1e-9)) << key;
    };
    expect("RiseTime", found.rise_time, 1.0);
    expect("SettlingTime", found.settling_time, 1.0);
    expect("Peak", found.peak, 1.0);
    expect("Overshoot", found.overshoot, 100.0);
    expect("Undershoot", found.undershoot, 100.0);
    // The reference took its peak times from a grid 5e-5 s wide. That ours are right: the slope,
    // which is the impulse response, changes its sign there and not where the reference says.
    const double grid = 5e-5, found_time = found.peak_time;
    EXPECT_NEAR(found_time, entry.at("verified").at("PeakTime"), grid);
    EXPECT_GT(impulse_response(system, found_time * (1.0 - 1e-9)), 0.0);
    EXPECT_LT(impulse_response(system, found_time * (1.0 + 1e-9)), 0.0);
    expect_near(found.peak, step_response(system, found_time), 1e-12);
    // What was printed, as coarse as its grids were.
    const auto& published = entry.at("published");
    expect_near(found.rise_time, published.at("RiseTime"), 2e-2);
    expect_near(found.settling_time, published.at("SettlingTime"), 2e-2);
    expect_near(found.settling_min, published.at("SettlingMin"), 1e-3);
    expect_near(found.settling_max, published.at("SettlingMax"), 1e-3);
  }
  EXPECT_EQ(verified, 3);
  // Another band.
  const auto narrow = step_characteristics(reference_case("matlab_H"), {.settling_band = 0.005});
  expect_near(narrow.settling_time, 4.8896, 1e-4);
  EXPECT_LT(
      std::abs(
          std::abs(step_response(reference_case("matlab_H"), narrow.settling_time) * 0.75 - 1.0) -
          0.005),
      1e-12);
}

TEST(StepCharacteristics, OfTheReferencesDegenerateCases) {
  const auto integrator = step_characteristics(reference_case("pc_type1"));
  EXPECT_FALSE(integrator.settles);
  for (const double value : {integrator.final_value, integrator.rise_time, integrator.settling_time,
                             integrator.settling_min, integrator.settling_max, integrator.overshoot,
                             integrator.undershoot, integrator.peak_time}) {
    EXPECT_TRUE(std::isnan(value));
  }
  EXPECT_EQ(integrator.peak, HUGE_VAL);

  const auto negative = step_characteristics(reference_case("pc337_negative_final"));
  EXPECT_NEAR(negative.final_value, -1.4010327, 5e-8);
  // The mirrored system has the same times and fractions.
  auto mirrored = reference_case("pc337_negative_final");
  mirrored.c = -mirrored.c;
  const auto positive = step_characteristics(mirrored);
  EXPECT_EQ(positive.final_value, -negative.final_value);
  EXPECT_EQ(positive.rise_time, negative.rise_time);
  EXPECT_EQ(positive.settling_time, negative.settling_time);
  EXPECT_EQ(positive.undershoot, negative.undershoot);
  EXPECT_EQ(positive.settling_min, -negative.settling_max);
  EXPECT_EQ(positive.settling_max, -negative.settling_min);

  // A zero and a pole at the origin: as with s divided out by hand.
  const auto cancelled = step_characteristics(reference_case("pc640_origin_cancellation"));
  const auto by_hand = step_characteristics(
      rational({8.4159075, 27.6062153, 10.7161216, 5.3998},
               {8.4159075, 44.4380303, 74.7874022, 55.8912172, 22.079728, 5.684}, "u", "y", "x"));
  expect_near(cancelled.final_value, 1.0, 1e-12);
  expect_near(cancelled.rise_time, by_hand.rise_time, 1e-10);
  expect_near(cancelled.settling_time, by_hand.settling_time, 1e-10);
  expect_near(cancelled.overshoot, by_hand.overshoot, 1e-6);
  // It is 1/(s^2/0.95 + 2 s + 1): damping ratio sqrt(0.95).
  expect_near(cancelled.overshoot, std::exp(-std::numbers::pi * std::sqrt(0.95) / std::sqrt(0.05)),
              1e-6);

  // Partial fractions: 1 + slow e^(-p t) - (1 + slow) e^(-q t), q some 1e4.
  const auto both = step_characteristics(reference_case("pc440_fast_plus_slow"));
  const double a = 106700.0 / 10.67, b = 57910.0 / 10.67;
  const double q = 0.5 * (a + std::sqrt(a * a - 4.0 * b)), p = b / q;
  const double slow = -a * (b / a - p) / (p * (q - p));
  const double peak_time = std::log((1.0 + slow) * q / (slow * p)) / (q - p);
  expect_near(both.peak_time, peak_time, 1e-8);
  expect_near(both.overshoot,
              slow * std::exp(-p * peak_time) - (1.0 + slow) * std::exp(-q * peak_time), 1e-7);
  expect_near(both.rise_time, std::log(9.0) / q, 1e-3);
}

TEST(StepCharacteristics, OfALagAreLogarithms) {
  for (const double lag : {1e-9, 0.3, 1e9}) {
    const auto found = step_characteristics(rational({-4.0}, {1.0, lag}, "u", "y", "x"));
    EXPECT_DOUBLE_EQ(found.final_value, -4.0);
    expect_near(found.rise_time, lag * std::log(9.0), 1e-11);
    expect_near(found.settling_time, lag * std::log(50.0), 1e-11);
    EXPECT_EQ(found.overshoot, 0.0);
    EXPECT_EQ(found.undershoot, 0.0);
    EXPECT_DOUBLE_EQ(found.peak, 4.0);
    EXPECT_EQ(found.peak_time, HUGE_VAL);
    EXPECT_DOUBLE_EQ(found.settling_min, -4.0);
    expect_near(found.settling_max, -3.6, 1e-11);
  }
}

TEST(StepCharacteristics, OfAnOscillatorAreTheTextbooks) {
  for (const double z : {1e-4, 0.05, 0.3, 0.69, 0.95}) {
    const double w = 7.0, damped = w * std::sqrt(1.0 - z * z);
    const auto found =
        step_characteristics(rational({w * w}, {w * w, 2.0 * z * w, 1.0}, "u", "y", "x"));
    expect_near(found.peak_time, std::numbers::pi / damped, 1e-9);
    expect_near(found.overshoot, std::exp(-std::numbers::pi * z * w / damped), 1e-9);
    // On the edge of the band, and past the last peak beyond it.
    const double t = found.settling_time;
    const double beyond = std::exp(-z * w * t) *
                          std::abs(std::cos(damped * t) + z * w / damped * std::sin(damped * t));
    expect_near(beyond, 0.02, 1e-9);
    const double envelope = 0.02 * std::sqrt(1.0 - z * z);
    EXPECT_LE(t, -std::log(envelope) / (z * w) * (1.0 + 1e-12));
    EXPECT_GE(t, -std::log(envelope) / (z * w) - std::numbers::pi / damped);
  }
}

TEST(StepCharacteristics, OfEqualPolesNeedNoEigenvectors) {
  // 1/(s + 1)^3: 1 - e^-t (1 + t + t^2/2) at the levels found.
  const auto response = [](double t) { return 1.0 - std::exp(-t) * (1.0 + t + 0.5 * t * t); };
  const auto system = rational({1.0}, {1.0, 3.0, 3.0, 1.0}, "u", "y", "x");
  const auto to_end = step_characteristics(system, {.rise_from = 0.0});
  expect_near(response(to_end.rise_time), 0.9, 1e-11);
  expect_near(response(to_end.rise_time - step_characteristics(system).rise_time), 0.1, 1e-10);
  expect_near(response(to_end.settling_time), 0.98, 1e-11);
  EXPECT_EQ(to_end.overshoot, 0.0);
}

TEST(StepCharacteristics, MissNeitherAFastNorASlowPole) {
  // 1 - 0.5 e^(-f t) - 0.5 e^(-s t), and with 0.05 e^(-f t) sin(w t) on top of a slow rise.
  for (const double fast : {1e2, 1e6, 1e9}) {
    const double slow = 1e-3;
    Eigen::Matrix2d a;
    a << -fast, 0.0, 0.0, -slow;
    const auto two =
        reference::state_space(a, Eigen::Vector2d(0.5 * fast, 0.5 * slow),
                               Eigen::RowVector2d(1.0, 1.0), Eigen::MatrixXd::Zero(1, 1));
    const auto found = step_characteristics(two);
    expect_near(found.rise_time, std::log(5.0) / slow + std::log(0.8) / fast, 1e-8);
    expect_near(found.settling_time, std::log(25.0) / slow, 1e-9);
    // A burst at the beginning that lasts 1/fast and peaks at 3.
    auto burst = two;
    burst.b(0) = -fast * 0.5;
    burst.b(1) = 1.5 * slow;
    burst.d(0, 0) = 3.0;
    burst.c(1) = -1.0;
    // 3 - 0.5 (1 - e^(-f t)) - 1.5 (1 - e^(-s t)): falls from 3 to 1.
    const auto falls = step_characteristics(burst);
    EXPECT_EQ(falls.peak, 3.0);
    EXPECT_EQ(falls.peak_time, 0.0);
    expect_near(falls.overshoot, 2.0, 1e-9);
    EXPECT_EQ(falls.rise_time, 0.0);
    expect_near(falls.settling_time, std::log(75.0) / slow, 1e-9);
  }
}

TEST(StepCharacteristics, FollowAFaintlyDampedModeBehindAFastPole) {
  // 1e5 periods until it settles; the pole at 1e5 rad/s adds 1e-5 s of delay.
  const double w = 60.0, z = 1e-5, fast = 1e5;
  const auto mode = rational({w * w}, {w * w, 2.0 * z * w, 1.0}, "v", "y", "mode");
  const auto lag = rational({fast}, {fast, 1.0}, "u", "v", "lag");
  const auto found = step_characteristics(plant::connect({lag, mode}, {"u"}, {"y"}));
  expect_near(found.peak_time, std::numbers::pi / w + 1.0 / fast, 1e-6);
  expect_near(found.overshoot, std::exp(-std::numbers::pi * z), 1e-6);
  // The amplitude there is within the fall of one period of the band.
  const double period = 2.0 * std::numbers::pi / w;
  EXPECT_NEAR(found.settling_time, std::log(50.0) / (z * w), period);
}

// Against a fine grid of the exact response, which can only miss.
TEST(StepCharacteristics, AreMetByEverySampleOfRandomResponses) {
  reference::RandomNumbers random(81);
  for (int trial = 0; trial < 100; ++trial) {
    const Eigen::Index n = random.integer(1, 7);
    Eigen::MatrixXd a = random.matrix(n, n);
    a.diagonal().array() -= numerics::spectral_abscissa(a) + random.log_uniform(0.1, 1.0);
    const auto system = reference::state_space(
        a, random.matrix(n, 1), random.matrix(1, n),
        random.integer(0, 1) == 0 ? Eigen::MatrixXd::Zero(1, 1).eval() : random.matrix(1, 1));
    const auto found = step_characteristics(system);
    const double step = 2e-3;
    const Eigen::Index samples = 100000;
    const Eigen::VectorXd y =
        plant::LinearSimulation(system, step).simulate(Eigen::MatrixXd::Ones(samples, 1));
    const double sign = found.final_value < 0.0 ? -1.0 : 1.0, size = std::abs(found.final_value);
    // A grid misses extremes by curvature (5 or so) step^2/8, crossings by a step.
    const double missed = 1e-5 * (1.0 + size);
    const double largest = y.cwiseAbs().maxCoeff();
    EXPECT_GE(found.peak, largest - 1e-9);
    EXPECT_LE(found.peak, std::max(largest + missed, size));
    EXPECT_NEAR(found.overshoot, std::max(0.0, (sign * y).maxCoeff() / size - 1.0), missed / size);
    EXPECT_NEAR(found.undershoot, std::max(0.0, -(sign * y).minCoeff() / size), missed / size);
    Eigen::Index last = -1, ten = -1, ninety = -1;
    for (Eigen::Index k = 0; k < samples; ++k) {
      const double part = sign * y[k] / size;
      if (std::abs(part - 1.0) >= 0.02) last = k;
      if (ten < 0 && part >= 0.1) ten = k;
      if (ninety < 0 && part >= 0.9) ninety = k;
    }
    EXPECT_GE(found.settling_time, static_cast<double>(last) * step - 1e-9);
    if (found.settling_time > 0.0) {
      expect_near(std::abs(step_response(system, found.settling_time) - found.final_value),
                  0.02 * size, 1e-8);
    }
    if (ten > 0) {
      EXPECT_NEAR(found.rise_time, static_cast<double>(ninety - ten) * step, 1.01 * step) << trial;
    }
    const Eigen::VectorXd risen = y.tail(samples - ninety);
    EXPECT_NEAR(found.settling_max, risen.maxCoeff(), missed + 0.01 * size) << trial;
    EXPECT_NEAR(found.settling_min, risen.minCoeff(), missed + 0.01 * size) << trial;
  }
}

TEST(StepCharacteristics, FollowUnitsOfTimeAndOutput) {
  const auto system = reference_case("matlab_siso_doc");
  const auto plain = step_characteristics(system);
  for (const double scale : {1e-6, 3.0, 1e7}) {
    auto other = system;
    other.a *= scale;
    other.b *= scale;
    other.c *= -17.0;
    const auto found = step_characteristics(other);
    expect_near(found.final_value, -17.0 * plain.final_value, 1e-10);
    expect_near(found.rise_time * scale, plain.rise_time, 1e-10);
    expect_near(found.settling_time * scale, plain.settling_time, 1e-10);
    expect_near(found.peak_time * scale, plain.peak_time, 1e-9);
    expect_near(found.peak, 17.0 * plain.peak, 1e-10);
    expect_near(found.overshoot, plain.overshoot, 1e-9);
    expect_near(found.settling_min, -17.0 * plain.settling_max, 1e-10);
  }
}

TEST(StepCharacteristics, OfAResponseThatReturnsToZeroKeepOnlyThePeak) {
  // s/(s + 1)^2: t e^-t.
  const auto found = step_characteristics(rational({0.0, 1.0}, {1.0, 2.0, 1.0}, "u", "y", "x"));
  EXPECT_TRUE(found.settles);
  EXPECT_EQ(found.final_value, 0.0);
  expect_near(found.peak, std::exp(-1.0), 1e-12);
  expect_near(found.peak_time, 1.0, 1e-9);
  EXPECT_TRUE(std::isnan(found.rise_time));
  EXPECT_TRUE(std::isnan(found.overshoot));
  // Sensitivity of a loop with integrators: 0 as the difference of large numbers.
  const auto sensitivity =
      step_characteristics(reference::channel(reference::peer_closed_loop(5), "d", "u"));
  EXPECT_EQ(sensitivity.final_value, 0.0);
  EXPECT_TRUE(std::isnan(sensitivity.settling_time));
  EXPECT_NEAR(sensitivity.peak, 1.0, 1e-12);
  EXPECT_EQ(sensitivity.peak_time, 0.0);
}

TEST(StepCharacteristics, OfASampledSystemAreTakenAtItsSamples) {
  for (const char* id : {"matlab_H", "pc_kpos", "pc337_negative_final"}) {
    const auto system = reference_case(id);
    const auto exact = step_characteristics(system);
    const double period = 0.01;
    const auto found = step_characteristics(plant::sample(system, period));
    EXPECT_NEAR(found.final_value, exact.final_value, 1e-12);
    EXPECT_NEAR(found.rise_time, exact.rise_time, period);
    EXPECT_GE(found.settling_time, exact.settling_time);
    EXPECT_LE(found.settling_time, exact.settling_time + period);
    EXPECT_NEAR(found.peak, exact.peak, 1e-3);
    EXPECT_NEAR(found.undershoot, exact.undershoot, 1e-3);
    EXPECT_NEAR(found.settling_min, exact.settling_min, 0.02);
    EXPECT_NEAR(found.settling_max, exact.settling_max, 0.02);
    EXPECT_EQ(std::isinf(found.peak_time), std::isinf(exact.peak_time));
    EXPECT_NEAR(std::remainder(found.settling_time, period), 0.0, 1e-12);
  }
  // 1/(z - 1/2): 0, 1, 1.5, 1.75, ... to 2.
  const auto halves = step_characteristics(
      reference::state_space(Eigen::MatrixXd::Constant(1, 1, 0.5), Eigen::MatrixXd::Ones(1, 1),
                             Eigen::MatrixXd::Ones(1, 1), Eigen::MatrixXd::Zero(1, 1), 2.0));
  EXPECT_EQ(halves.final_value, 2.0);
  EXPECT_EQ(halves.rise_time, 2.0 * (4.0 - 1.0));  // 1 - 2^-4 is the first beyond 0.9
  EXPECT_EQ(halves.settling_time, 2.0 * 6.0);      // 2^-6 the first within 0.02
  EXPECT_EQ(halves.settling_min, 1.875);
  EXPECT_FALSE(step_characteristics(plant::sample(reference_case("pc_type1"), 0.1)).settles);
}

TEST(StepCharacteristics, OfAStaticGainAreThere) {
  const auto gain = plant::static_gain(Eigen::MatrixXd::Constant(1, 1, -3.0), {"u"}, {"y"});
  const auto found = step_characteristics(gain);
  EXPECT_EQ(found.final_value, -3.0);
  EXPECT_EQ(found.rise_time, 0.0);
  EXPECT_EQ(found.settling_time, 0.0);
  EXPECT_EQ(found.peak, 3.0);
}

TEST(StepCharacteristics, NameWhatTheyRefuse) {
  const auto lag = rational({1.0}, {1.0, 1.0}, "u", "y", "x");
  const auto refused = [&](const StepOptions& options, const char* message) {
    EXPECT_THAT(reference::Call([&] { step_characteristics(lag, options); }),
                ThrowsMessage<InvalidInput>(HasSubstr(message)));
  };
  refused({.settling_band = 0.0}, "settling_band between 0 and 1, found 0");
  refused({.settling_band = std::nan("")}, "settling_band");
  refused({.rise_from = 0.5, .rise_to = 0.4}, "found 0.5 and 0.4");
  refused({.rise_to = 1.0}, "found 0.1 and 1");
  refused({.minimal_tolerance = -1.0}, "tolerance");
  EXPECT_THAT(reference::Call([] { step_characteristics(reference::peer_closed_loop(5)); }),
              ThrowsMessage<InvalidInput>(HasSubstr("found 3 and 2")));
  EXPECT_THAT(reference::Call([] {
                step_characteristics(rational({1.0}, {-2.0, 1.0}, "u", "y", "x"));
              }),
              ThrowsMessage<NumericalFailure>(
                  AllOf(HasSubstr("expected a stable system"), HasSubstr("at 2 +0j"))));
  EXPECT_THAT(reference::Call([] {
                step_characteristics(rational({1.0}, {4.0, 0.0, 1.0}, "u", "y", "x"));
              }),
              ThrowsMessage<NumericalFailure>(HasSubstr("2j")));
  // Double integrator: it drifts.
  EXPECT_FALSE(step_characteristics(rational({1.0}, {0.0, 0.0, 1.0}, "u", "y", "x")).settles);
}

}  // namespace
}  // namespace boresight::control
