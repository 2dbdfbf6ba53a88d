#include <cmath>
#include <limits>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "random_numbers.hpp"
#include "reference_antenna.hpp"
#include "refused_call.hpp"
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/wind/torque_coefficients.hpp>

namespace boresight::plant {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

Eigen::VectorXd degrees(std::initializer_list<double> values) {
  Eigen::VectorXd axis(static_cast<Eigen::Index>(values.size()));
  Eigen::Index i = 0;
  for (const double value : values) axis[i++] = value * degree;
  return axis;
}

// Of no antenna: bilinear in yaw and elevation, so that the table is exact between its points too.
double plane(double yaw, double elevation) {
  return 0.02 + 0.07 * yaw - 0.03 * elevation + 0.05 * yaw * elevation;
}

TorqueCoefficientTable plane_table() {
  const Eigen::VectorXd yaw = degrees({-30.0, 0.0, 10.0, 130.0});
  const Eigen::VectorXd elevation = degrees({10.0, 45.0, 90.0});
  return {yaw, elevation, Eigen::MatrixXd::NullaryExpr(4, 3, [&](Eigen::Index i, Eigen::Index j) {
            return plane(yaw[i], elevation[j]);
          })};
}

TorqueCoefficientTable circle_table() {
  const Eigen::VectorXd yaw = degrees({-180.0, -90.0, 0.0, 90.0, 180.0});
  Eigen::MatrixXd values(5, 2);
  values << 0.0, 0.0, -0.1, -0.05, 0.0, 0.0, 0.1, 0.05, 0.0, 0.0;
  return {yaw, degrees({0.0, 90.0}), values};
}

TEST(TorqueCoefficientTable, IsExactForBilinearFunctions) {
  const TorqueCoefficientTable table = plane_table();
  EXPECT_FALSE(table.full_circle());
  reference::RandomNumbers random(3);
  for (int i = 0; i < 1000; ++i) {
    const double yaw = random.uniform(-30.0, 130.0) * degree;
    const double elevation = random.uniform(10.0, 90.0) * degree;
    EXPECT_NEAR(table.at(yaw, elevation), plane(yaw, elevation), 1e-15);
  }
  for (const double yaw : {-30.0, 0.0, 10.0, 130.0}) {
    for (const double elevation : {10.0, 45.0, 90.0}) {
      EXPECT_NEAR(table.at(yaw * degree, elevation * degree),
                  plane(yaw * degree, elevation * degree), 1e-15);
    }
  }
}

TEST(TorqueCoefficientTable, GoesOnRoundAFullCircle) {
  const TorqueCoefficientTable table = circle_table();
  EXPECT_TRUE(table.full_circle());
  for (double yaw = -180.0; yaw < 180.0; yaw += 7.0) {
    const double expected = table.at(yaw * degree, 0.5);
    for (const double turns : {-2.0, -1.0, 1.0, 5.0}) {
      EXPECT_NEAR(table.at((yaw + 360.0 * turns) * degree, 0.5), expected, 1e-14);
    }
    EXPECT_NEAR(table.at(-yaw * degree, 0.5), -expected, 1e-14);
  }
  EXPECT_NEAR(table.at(270.0 * degree, 0.0), -0.1, 1e-15);
  EXPECT_NEAR(table.at(225.0 * degree, 0.0), -0.05, 1e-15);
}

TEST(TorqueCoefficientTable, RefusesAttitudesItDoesNotHold) {
  const TorqueCoefficientTable table = plane_table();
  EXPECT_THAT(reference::Call([&] { table.at(-31.0 * degree, 1.0); }),
              ThrowsMessage<InvalidInput>(HasSubstr("expected a yaw of -0.52")));
  EXPECT_THROW(table.at(329.0 * degree, 1.0), InvalidInput);
  EXPECT_THAT(reference::Call([&] { table.at(0.0, 9.0 * degree); }),
              ThrowsMessage<InvalidInput>(HasSubstr("expected an elevation of 0.17")));
  EXPECT_NO_THROW(table.at(0.0, 0.5 * std::numbers::pi + 1e-12));
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    for (const auto& any : {plane_table(), circle_table()}) {
      EXPECT_THROW(any.at(bad, 0.5), InvalidInput);
      EXPECT_THROW(any.at(0.5, bad), InvalidInput);
    }
  }
}

TEST(TorqueCoefficientTable, RefusesTablesThatAreNone) {
  const Eigen::VectorXd yaw = degrees({0.0, 90.0, 180.0}), elevation = degrees({0.0, 90.0});
  const Eigen::MatrixXd values = Eigen::MatrixXd::Zero(3, 2);
  const auto refused = [](const Eigen::VectorXd& x, const Eigen::VectorXd& y,
                          const Eigen::MatrixXd& z, const char* words) {
    EXPECT_THAT(reference::Call([&] { TorqueCoefficientTable(x, y, z); }),
                ThrowsMessage<InvalidInput>(HasSubstr(words)));
  };
  refused({}, elevation, values, "at least 2 values of yaw, found 0");
  refused(yaw, degrees({5.0}), values, "at least 2 values of elevation, found 1");
  refused(degrees({0.0, 90.0, 80.0}), elevation, values, "ascending values of yaw");
  refused(yaw, degrees({90.0, 90.0}), values, "ascending values of elevation");
  refused(degrees({0.0, std::nan(""), 180.0}), elevation, values, "finite values of yaw");
  refused(yaw, elevation, values.transpose(), "expected 3 x 2 coefficients, found 2 x 3");
  refused(yaw, elevation, values * std::nan(""), "finite coefficients");
  refused(degrees({0.0, 90.0, 361.0}), elevation, values, "at most 360 deg");
  Eigen::MatrixXd open = values;
  open(2, 1) = 0.1;
  refused(degrees({0.0, 90.0, 360.0}), elevation, open, "both ends of a full circle");
  EXPECT_NO_THROW(TorqueCoefficientTable(yaw, elevation, open));
}

TEST(TorqueCoefficients, MakeTheTorqueAboutBothAxes) {
  const AxisTorqueTables tables{circle_table(), plane_table()};
  const WindSite site = reference::wind_site();
  const double yaw = 100.0 * degree, elevation = 40.0 * degree, speed = 12.0;
  const double pressure = 0.5 * 1.1 * speed * speed;
  const double volume = std::numbers::pi / 4.0 * std::pow(70.0, 3);
  const AxisTorques torque = mean_wind_torque(site, tables, yaw, elevation, speed);
  EXPECT_NEAR(torque.azimuth / (pressure * volume * tables.azimuth.at(yaw, elevation)), 1.0, 1e-14);
  EXPECT_NEAR(torque.elevation / (pressure * volume * plane(yaw, elevation)), 1.0, 1e-14);
  EXPECT_EQ(mean_wind_torque(at_attitude(site, tables.azimuth, yaw, elevation), speed),
            torque.azimuth);

  const AxisTorques slope = wind_torque_sensitivity(site, tables, yaw, elevation, speed);
  const double step = 1e-3;
  const AxisTorques above = mean_wind_torque(site, tables, yaw, elevation, speed + step);
  const AxisTorques below = mean_wind_torque(site, tables, yaw, elevation, speed - step);
  EXPECT_NEAR((above.azimuth - below.azimuth) / (2.0 * step) / slope.azimuth, 1.0, 1e-9);
  EXPECT_NEAR((above.elevation - below.elevation) / (2.0 * step) / slope.elevation, 1.0, 1e-9);
  EXPECT_NEAR(slope.elevation * speed / torque.elevation, 2.0, 1e-14);
  EXPECT_EQ(wind_torque_sensitivity(site, tables, yaw, elevation, 0.0).azimuth, 0.0);
  EXPECT_THROW(mean_wind_torque(site, tables, yaw, elevation, -1.0), InvalidInput);
  EXPECT_THROW(mean_wind_torque(site, tables, 140.0 * degree, elevation, 1.0), InvalidInput);
}

TEST(TorqueCoefficients, OfTheTowerStandardsGiveTheirMomentInSiUnits) {
  // C_M = M/(D A V^2) = 0.000374 of a paraboloid at 130 deg: 30 mph on 10 ft, once in lb ft and mph
  // and once in SI at the standards' air of 0.0765 lb/ft^3.
  const double foot = 0.3048, mile_an_hour = 0.44704, pound_force = 4.4482216, pound = 0.45359237;
  const double moment = 0.000374 * 10.0 * (std::numbers::pi * 25.0) * 900.0 * pound_force * foot;
  WindSite site = reference::wind_site();
  site.air_density = 0.0765 * pound / std::pow(foot, 3);
  site.dish_diameter = 10.0 * foot;
  site.torque_coefficient = coefficient_from_eia_222(0.000374);
  EXPECT_NEAR(site.torque_coefficient, 0.146, 1e-3);
  EXPECT_NEAR(mean_wind_torque(site, 30.0 * mile_an_hour) / moment, 1.0, 2e-3);
}

}  // namespace
}  // namespace boresight::plant
