#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "refused_call.hpp"
#include <boresight/numerics/error.hpp>
#include <boresight/plant/nonlinear/hydraulic_elements.hpp>

namespace boresight::plant {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

void expect_derivative(const std::function<numerics::ValueAndDerivative(double)>& f, double x,
                       double step) {
  const double difference = (f(x + step).value - f(x - step).value) / (2.0 * step);
  EXPECT_NEAR(f(x).derivative, difference, 1e-6 * std::abs(difference)) << "at " << x;
}

TEST(Orifice, IsTheSquareRootAwayFromZero) {
  const double c = 3e-8, transition = 1e4;
  for (const double dp : {1e5, 1e6, 2e7}) {
    const double root = c * std::sqrt(dp), short_of = std::pow(transition / dp, 2) / 4.0;
    EXPECT_NEAR(orifice(c, dp, transition).value / root, 1.0 - short_of, short_of * short_of * 3.0);
    EXPECT_NEAR(orifice(c, dp, transition).derivative, root / (2.0 * dp),
                3.0 * short_of * root / dp);
  }
  // Never further off than said, and that far somewhere.
  double worst = 0.0;
  for (double dp = 0.0; dp < 10.0 * transition; dp += 1e-3 * transition) {
    worst = std::max(worst, c * std::sqrt(dp) - orifice(c, dp, transition).value);
  }
  worst /= c * std::sqrt(transition);
  EXPECT_LE(worst, 0.2545);
  EXPECT_GT(worst, 0.2540);
}

TEST(Orifice, KeepsTheSignAndRisesStraightThroughZero) {
  const double c = 3e-8, transition = 1e4;
  EXPECT_EQ(orifice(c, 0.0, transition).value, 0.0);
  EXPECT_NEAR(orifice(c, 0.0, transition).derivative, c / std::sqrt(transition), 1e-24);
  for (const double dp : {1.0, 3e3, 1e4, 5e6}) {
    EXPECT_EQ(orifice(c, -dp, transition).value, -orifice(c, dp, transition).value);
    EXPECT_EQ(orifice(c, -dp, transition).derivative, orifice(c, dp, transition).derivative);
    EXPECT_GT(orifice(c, dp, transition).derivative, 0.0);
    expect_derivative([&](double x) { return orifice(c, x, transition); }, dp,
                      1e-4 * std::max(dp, transition));
  }
}

TEST(Orifice, PassesWhatMerrittsFormulaSays) {
  // 1 mm2 at 7 MPa, oil of 850 kg/m3, Cd = 0.611: Cd A sqrt(2 dp/rho) = 78.4 cm3/s.
  const double c = orifice_coefficient(1e-6, 0.611, 850.0);
  EXPECT_NEAR(orifice(c, 7e6, 1e3).value, 0.611e-6 * std::sqrt(2.0 * 7e6 / 850.0), 1e-12);
  EXPECT_NEAR(orifice(c, 7e6, 1e3).value, 78.4e-6, 0.05e-6);
  EXPECT_EQ(orifice_coefficient(0.0, 0.611, 850.0), 0.0);
}

TEST(CheckValve, PassesOneDirectionOnly) {
  for (const double dp : {0.0, -1.0, -1e7}) {
    EXPECT_EQ(check_valve(1e-5, dp, 10.0).value, 0.0);
    EXPECT_EQ(check_valve(1e-5, dp, 10.0).derivative, 0.0);
  }
  EXPECT_EQ(check_valve(1e-5, 3e6, 10.0).value, orifice(1e-5, 3e6, 10.0).value);
  EXPECT_EQ(check_valve(1e-5, 3e6, 10.0).derivative, orifice(1e-5, 3e6, 10.0).derivative);
}

TEST(VolumeStiffness, IsThePressureOfAFlow) {
  // 1 cm3 more in 1 litre of oil of 1 GPa: 1 MPa.
  EXPECT_DOUBLE_EQ(volume_stiffness(1e9, 1e-3) * 1e-6, 1e6);
}

ReliefValve relief() {
  return {.opening_pressure = 2e7,
          .tank_pressure = 1e5,
          .spring_rate = 2e11,
          .flow_force_rate = 4e4,
          .largest_opening = 4e-6,
          .time_constant = 0.01};
}

TEST(ReliefValve, BalancesSpringAndFlowForces) {
  const ReliefValve valve = relief();
  for (const double p : {2.001e7, 2.1e7, 2.3e7}) {
    const double x = free_opening(valve, p).value;
    EXPECT_NEAR(x * valve.spring_rate + x * valve.flow_force_rate * (p - valve.tank_pressure),
                p - valve.opening_pressure, 1e-8 * p);
    expect_derivative([&](double q) { return free_opening(valve, q); }, p, 1e3);
  }
  for (const double p : {-1e6, 5e4, 1e7}) {
    EXPECT_LT(free_opening(valve, p).value, 0.0);
    expect_derivative([&](double q) { return free_opening(valve, q); }, p, 1e3);
  }
}

TEST(ReliefValve, RestsBetweenItsStops) {
  const ReliefValve valve = relief();
  for (const double p : {0.0, 1.9e7, 2e7}) {
    EXPECT_EQ(resting_opening(valve, p).value, 0.0);
    EXPECT_EQ(resting_opening(valve, p).derivative, 0.0);
  }
  EXPECT_EQ(resting_opening(valve, 2.1e7).value, free_opening(valve, 2.1e7).value);
  EXPECT_EQ(resting_opening(valve, 2.1e7).derivative, free_opening(valve, 2.1e7).derivative);
  EXPECT_EQ(resting_opening(valve, 9e7).value, valve.largest_opening);
  EXPECT_EQ(resting_opening(valve, 9e7).derivative, 0.0);
}

TEST(HydraulicElements, RefuseWhatCannotBe) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(
      reference::Call([] { orifice_coefficient(-1e-6, 0.6, 850.0); }),
      ThrowsMessage<InvalidInput>(HasSubstr("an opening at least 0 and finite, found -1e-06")));
  EXPECT_THAT(reference::Call([] { orifice_coefficient(1e-6, 0.0, 850.0); }),
              ThrowsMessage<InvalidInput>(HasSubstr("a discharge coefficient above 0")));
  EXPECT_THAT(reference::Call([] { orifice_coefficient(1e-6, 0.6, nan); }),
              ThrowsMessage<InvalidInput>(HasSubstr("a density above 0 and finite, found nan")));
  EXPECT_THAT(reference::Call([] { volume_stiffness(0.0, 1.0); }),
              ThrowsMessage<InvalidInput>(HasSubstr("volume_stiffness: expected a bulk modulus")));
  EXPECT_THAT(reference::Call([] { volume_stiffness(1e9, -1.0); }),
              ThrowsMessage<InvalidInput>(HasSubstr("a volume above 0")));
  EXPECT_NO_THROW(validate(relief()));
  const auto refusal = [](const std::function<void(ReliefValve&)>& spoil, const char* words) {
    ReliefValve valve = relief();
    spoil(valve);
    EXPECT_THAT(reference::Call([&] { validate(valve); }),
                ThrowsMessage<InvalidInput>(HasSubstr(words)));
  };
  refusal([](ReliefValve& v) { v.opening_pressure = 0.0; }, "opening_pressure over the tank's");
  refusal([](ReliefValve& v) { v.tank_pressure = nan; }, "tank_pressure");
  refusal([](ReliefValve& v) { v.spring_rate = 0.0; }, "spring_rate");
  refusal([](ReliefValve& v) { v.flow_force_rate = -1.0; }, "flow_force_rate");
  refusal([](ReliefValve& v) { v.largest_opening = 0.0; }, "largest_opening");
  refusal([](ReliefValve& v) { v.time_constant = nan; }, "time_constant");
}

}  // namespace
}  // namespace boresight::plant
