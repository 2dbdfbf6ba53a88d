#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "random_numbers.hpp"
#include "refused_call.hpp"
#include <boresight/identification/grey_box/grey_box_hydraulics.hpp>
#include <boresight/identification/grey_box/grey_box_mechanics.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::identification {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;
using Mechanical = MechanicalCoefficients;
using Hydraulic = HydraulicCoefficients;
using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

Vector mechanical() {
  Vector c(Mechanical::count(2));
  c << 1.4, 10.0, 6.0, 0.15, 60.0, 1.5, 2.0, 2500.0, 5.0, -8.0, 0.01, 0.03, 0.004, 20.0, 0.01, 0.25,
      12.8, 0.06, 20.0;
  return c;
}

Vector hydraulic() {
  Vector c(Hydraulic::count);
  c << 26.3, 26.5, 0.007, 0.0005, 0.0008, 0.97, 0.3, 0.005, 0.02, 0.1, 474.0, 0.05, 0.03, 0.004,
      11.0, 0.2;
  return c;
}

const HydraulicUnits units{474.0, 9.5, 60.0};

// Starts, slides, reverses and sticks; pressures and valve of the same kind of size.
GreyBoxRecord moving_record(Eigen::Index samples) {
  reference::RandomNumbers random(5);
  GreyBoxRecord r;
  r.name = "moving";
  r.sample_time = 0.02;
  for (auto* s : {&r.side_1, &r.side_2, &r.rate, &r.torque, &r.common, &r.motion, &r.motion_slope,
                  &r.valve}) {
    s->setZero(samples);
  }
  for (Eigen::Index k = 0; k < samples; ++k) {
    const double t = 0.02 * static_cast<double>(k);
    r.torque(k) = 110.0 * std::sin(0.9 * t) + 20.0 * std::sin(5.0 * t) - 8.0;
    r.common(k) = 15.0 * std::sin(2.0 * t);
    r.rate(k) = 9.0 * std::sin(0.9 * t - 0.2) + random.uniform(-0.05, 0.05);
    r.motion(k) = r.rate(k);
    r.motion_slope(k) = 8.1 * std::cos(0.9 * t - 0.2);
    r.valve(k) = 10.0 * std::sin(0.9 * t);
    r.side_1(k) = 180.0 + 0.5 * r.torque(k);
    r.side_2(k) = 180.0 - 0.5 * r.torque(k);
  }
  const auto size = static_cast<std::size_t>(samples);
  r.rate_known.assign(size, true);
  for (std::size_t k = size / 2; k < size / 2 + 20; ++k) r.rate_known[k] = false;
  r.rate_counts.assign(size, true);
  r.pressure_counts.assign(size, true);
  r.rate_restarts.assign(size, false);
  r.rate_restarts[0] = r.rate_restarts[size / 3] = true;
  r.pressure_restarts = r.rate_restarts;
  return r;
}

template <typename Predict>
void expect_derivatives(const Predict& predict, const Vector& c) {
  Vector errors, more, less;
  Matrix by;
  predict(c, errors, &by);
  ASSERT_TRUE(errors.allFinite());
  for (Eigen::Index i = 0; i < c.size(); ++i) {
    // Central differences of fourth order.
    const double step = 1e-3 * std::max(std::abs(c(i)), 0.1);
    Vector difference = Vector::Zero(errors.size());
    for (const auto& [places, weight] : {std::pair{1.0, 8.0}, std::pair{2.0, -1.0}}) {
      Vector moved = c;
      moved(i) = c(i) + places * step;
      predict(moved, more, nullptr);
      moved(i) = c(i) - places * step;
      predict(moved, less, nullptr);
      difference += weight * (more - less) / (12.0 * step);
    }
    // The solver's own rounding is what coefficients that hardly matter show.
    EXPECT_LT((difference - by.row(i).transpose()).norm(), 1e-6 * by.row(i).norm() + 1e-7)
        << "coefficient " << i;
  }
}

TEST(PredictRate, DerivativesAreThoseOfDifferences) {
  // Without a velocity reversal: there the friction has a kink, and differences across it are none.
  GreyBoxRecord record = moving_record(200);
  record.torque.array() += 150.0;
  record.rate.array() += 20.0;
  expect_derivatives(
      [&](const Vector& c, Vector& errors, Matrix* by) { predict_rate(record, c, errors, by); },
      mechanical());
}

TEST(PredictRate, DerivativesHoldWhileTheBristlesStick) {
  GreyBoxRecord record = moving_record(150);
  record.torque = -8.0 + (record.torque.array() + 8.0) * 0.05;
  record.rate *= 1e-4;
  Vector c = mechanical();
  c(Mechanical::tachometer_zero) = 0.0;
  Vector errors, more, less;
  Matrix by;
  predict_rate(record, c, errors, &by);
  for (const Eigen::Index i :
       {Eigen::Index{Mechanical::bristle_stiffness}, Eigen::Index{Mechanical::offset_torque},
        Eigen::Index{Mechanical::rigid_inertia}}) {
    const double step = 1e-4 * std::abs(c(i));
    Vector moved = c;
    moved(i) += step;
    predict_rate(record, moved, more, nullptr);
    moved(i) -= 2.0 * step;
    predict_rate(record, moved, less, nullptr);
    const Vector difference = (more - less) / (2.0 * step);
    EXPECT_LT((difference - by.row(i).transpose()).norm(), 1e-3 * by.row(i).norm()) << i;
  }
}

TEST(PredictRate, OfTheMirroredDriveIsMirrored) {
  const GreyBoxRecord record = moving_record(600);
  GreyBoxRecord mirrored = record;
  mirrored.torque *= -1.0;
  mirrored.rate *= -1.0;
  mirrored.common *= -1.0;
  const Vector c = mechanical();
  Vector other = c;
  other(Mechanical::offset_torque) *= -1.0;
  other(Mechanical::tachometer_zero) *= -1.0;
  Vector errors, errors_of_mirrored;
  predict_rate(record, c, errors, nullptr);
  predict_rate(mirrored, other, errors_of_mirrored, nullptr);
  EXPECT_LT((errors + errors_of_mirrored).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(MechanicalStepper, WithNothingButViscousFrictionFallsOffExponentially) {
  Vector c(Mechanical::count(0));
  c << 2.0, 1e-9, 1e-9, 1.0, 1e-9, 1.0, 0.5, 1e-3, 0.0, 0.0, 0.0, 0.0, 1e-5, 0.0, 0.01;
  MechanicalStepper motor(c, 0.01, false);
  motor.restart(4.0, 0.0);
  const Vector none;
  for (int k = 0; k < 300; ++k) ASSERT_TRUE(motor.step(0.0, 0.0, 0.0, none));
  // The implicit mean is right to (h B/J)^2/12.
  EXPECT_NEAR(motor.rate(), 4.0 * std::exp(-3.0 * 0.5 / 2.0), 1e-5);
  // A torque against the viscous friction: T/B.
  for (int k = 0; k < 10000; ++k) ASSERT_TRUE(motor.step(1.5, 0.0, 0.0, none));
  EXPECT_NEAR(motor.rate(), 3.0, 1e-7);
}

TEST(MechanicalStepper, ModeOnAFreeMotorRingsAtTheFrequencyOfBothMasses) {
  Vector c(Mechanical::count(1));
  const double rigid = 1.2, load = 0.4, locked = 2.0 * std::numbers::pi * 2.0;
  c << rigid, 1e-9, 1e-9, 1.0, 1e-9, 1.0, 1e-9, 1e-3, 0.0, 0.0, 0.0, 0.0, 1e-5, 0.0, 1e-6, load,
      locked;
  const double h = 0.002;
  MechanicalStepper motor(c, h, false);
  motor.restart(0.0, 0.0);
  const Vector none;
  ASSERT_TRUE(motor.step(800.0, 0.0, 0.0, none));
  // After the impulse both turn at impulse/inertia, about which the motor rings.
  const double mean = 800.0 * h / (rigid + load);
  int crossings = 0;
  double first = 0.0, last = 0.0, before = motor.rate() - mean;
  for (int k = 0; k < 5000; ++k) {
    ASSERT_TRUE(motor.step(0.0, 0.0, 0.0, none));
    const double now = motor.rate() - mean;
    if (before < 0.0 && now >= 0.0) {
      last = (k + before / (before - now)) * h;
      if (crossings++ == 0) first = last;
    }
    before = now;
  }
  ASSERT_GT(crossings, 10);
  const double expected = locked / (2.0 * std::numbers::pi) * std::sqrt(1.0 + load / rigid);
  EXPECT_NEAR((crossings - 1) / (last - first), expected, 2e-4 * expected);
}

TEST(MechanicalStepper, StaysAtRestBelowBreakaway) {
  const Vector c = mechanical();
  MechanicalStepper motor(c, 0.02, false);
  motor.restart(0.0, c(Mechanical::offset_torque));
  const Vector none;
  const double held = c(Mechanical::offset_torque) + 0.8 * c(Mechanical::coulomb_torque);
  for (int k = 0; k < 2000; ++k) ASSERT_TRUE(motor.step(held, 0.0, 0.0, none));
  EXPECT_LT(std::abs(motor.rate()), 1e-3);
  for (int k = 0; k < 2000; ++k) ASSERT_TRUE(motor.step(held + 40.0, 0.0, 0.0, none));
  EXPECT_GT(motor.rate(), 0.5);
}

TEST(MechanicalStepper, RefusesCoefficientsThatAreTooFew) {
  EXPECT_THAT(
      reference::Call([] { MechanicalStepper(Vector::Ones(3), 0.01, false); }),
      ThrowsMessage<InvalidInput>(HasSubstr("expected 15 coefficients and 2 for each mode")));
}

TEST(PredictPressures, DerivativesAreThoseOfDifferences) {
  GreyBoxRecord record = moving_record(300);
  record.valve = record.valve.cwiseAbs();
  expect_derivatives([&](const Vector& c, Vector& errors,
                         Matrix* by) { predict_pressures(record, units, c, errors, by); },
                     hydraulic());
}

TEST(PredictPressures, OfTheMirroredDriveAreExchanged) {
  const GreyBoxRecord record = moving_record(400);
  GreyBoxRecord mirrored = record;
  mirrored.motion *= -1.0;
  mirrored.motion_slope *= -1.0;
  mirrored.valve *= -1.0;
  std::swap(mirrored.side_1, mirrored.side_2);
  const Vector c = hydraulic();
  Vector other = c;
  other(Hydraulic::valve_null) *= -1.0;
  other(Hydraulic::tachometer_zero) *= -1.0;
  std::swap(other(Hydraulic::stiffness_1), other(Hydraulic::stiffness_2));
  Vector errors, exchanged;
  predict_pressures(record, units, c, errors, nullptr);
  predict_pressures(mirrored, units, other, exchanged, nullptr);
  for (Eigen::Index k = 0; k < errors.size(); k += 2) {
    EXPECT_NEAR(errors(k), exchanged(k + 1), 1e-9);
    EXPECT_NEAR(errors(k + 1), exchanged(k), 1e-9);
  }
}

TEST(PortOpening, IsADeadZoneOfTheLapAndDoublesWithinAnUnderlap) {
  Vector c = Vector::Zero(Hydraulic::count);
  c(Hydraulic::valve_gain) = 0.9;
  c(Hydraulic::valve_null) = 0.05;
  const auto opening = [&](double lap, double spool) {
    c(Hydraulic::valve_lap) = lap;
    return port_opening(c, units, spool).value;
  };
  for (const double lap : {1.5, -1.5, 0.0}) {
    EXPECT_NEAR(opening(lap, 20.0), 0.9 * 20.0 + 0.05 - lap, 1e-3);
    EXPECT_NEAR(opening(lap, -20.0), -0.9 * 20.0 + 0.05 + lap, 1e-3);
  }
  EXPECT_NEAR(opening(1.5, 0.4), 0.0, 0.01);
  EXPECT_NEAR(opening(-1.5, 0.4), 2.0 * (0.9 * 0.4 + 0.05), 0.01);
  EXPECT_DOUBLE_EQ(opening(0.0, 0.4), 0.9 * 0.4 + 0.05);
  // Rises everywhere, so that a flow belongs to one position.
  for (double spool = -4.0; spool < 4.0; spool += 0.05) {
    EXPECT_GT(opening(1.5, spool + 0.05), opening(1.5, spool)) << spool;
  }
}

TEST(PressureRates, StandStillWhereTheOrificesLetTheMotorsFlowThrough) {
  // Without leakage, loss and droop both orifices drop half of what the load leaves:
  // w = o sqrt(1 - T/(ps - pr)), physics of the reference antenna.
  Vector c = Vector::Zero(Hydraulic::count);
  c(Hydraulic::stiffness_1) = c(Hydraulic::stiffness_2) = 30.0;
  c(Hydraulic::supply_torque) = units.supply_torque;
  const double range = units.supply_torque - units.return_torque;
  for (const double opening : {20.0, -20.0}) {
    const double torque = 0.4 * range * (opening > 0.0 ? 1.0 : -1.0);
    const double middle = 0.5 * (units.supply_torque + units.return_torque);
    const auto rates =
        pressure_rates(c, units, Eigen::Vector2d{middle + 0.5 * torque, middle - 0.5 * torque},
                       opening, opening * std::sqrt(0.6));
    EXPECT_LT(rates.value.norm(), 30.0 * 20.0 * 4e-4);
  }
  // A still drive with a closed valve loses pressure across the motors and to the case.
  c(Hydraulic::cross_leakage) = 0.01;
  c(Hydraulic::case_leakage) = 0.002;
  const auto rates = pressure_rates(c, units, {300.0, 100.0}, 0.0, 0.0);
  EXPECT_NEAR(rates.value(0), -30.0 * (0.01 * 200.0 + 0.002 * 300.0), 1e-9);
  EXPECT_NEAR(rates.value(1), 30.0 * (0.01 * 200.0 - 0.002 * 100.0), 1e-9);
}

TEST(PredictPressures, RefusesARecordWithoutValve) {
  GreyBoxRecord record = moving_record(20);
  record.valve.resize(0);
  Vector errors;
  EXPECT_THAT(
      reference::Call([&] { predict_pressures(record, units, hydraulic(), errors, nullptr); }),
      ThrowsMessage<InvalidInput>(HasSubstr("expected a valve command at the 20 samples")));
}

}  // namespace
}  // namespace boresight::identification
