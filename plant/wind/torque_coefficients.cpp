#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/wind/torque_coefficients.hpp>

namespace boresight::plant {
namespace {

constexpr double full_turn = two_pi;
constexpr double tolerance = 1e-9;

void check_axis(const char* name, const Eigen::VectorXd& axis) {
  if (axis.size() < 2) {
    throw InvalidInput(fmt::format(
        "TorqueCoefficientTable: expected at least 2 values of {}, found {}", name, axis.size()));
  }
  if (!axis.allFinite()) {
    throw InvalidInput(fmt::format("TorqueCoefficientTable: expected finite values of {}", name));
  }
  for (Eigen::Index i = 1; i < axis.size(); ++i) {
    if (axis[i] > axis[i - 1]) continue;
    throw InvalidInput(
        fmt::format("TorqueCoefficientTable: expected ascending values of {}, found {} rad after "
                    "{} rad",
                    name, axis[i], axis[i - 1]));
  }
}

// The interval of an axis that holds a value, and the place within it, 0 .. 1.
struct Place {
  Eigen::Index interval = 0;
  double rest = 0.0;
};

Place place_in(const char* name, const Eigen::VectorXd& axis, double value) {
  const double first = axis[0];
  const double last = axis[axis.size() - 1];
  if (!(value >= first - tolerance) || !(value <= last + tolerance)) {
    throw InvalidInput(
        fmt::format("TorqueCoefficientTable: expected {} of {} to {} rad, found {} rad", name,
                    first, last, value));
  }
  const double inside = std::clamp(value, first, last);
  const auto* above = std::upper_bound(axis.data() + 1, axis.data() + axis.size() - 1, inside);
  const Eigen::Index interval = above - axis.data() - 1;
  return {interval, (inside - axis[interval]) / (axis[interval + 1] - axis[interval])};
}

}  // namespace

TorqueCoefficientTable::TorqueCoefficientTable(Eigen::VectorXd yaw, Eigen::VectorXd elevation,
                                               Eigen::MatrixXd coefficients)
    : yaw_(std::move(yaw)),
      elevation_(std::move(elevation)),
      coefficients_(std::move(coefficients)) {
  check_axis("yaw", yaw_);
  check_axis("elevation", elevation_);
  if (coefficients_.rows() != yaw_.size() || coefficients_.cols() != elevation_.size()) {
    throw InvalidInput(
        fmt::format("TorqueCoefficientTable: expected {} x {} coefficients, found {} x {}",
                    yaw_.size(), elevation_.size(), coefficients_.rows(), coefficients_.cols()));
  }
  if (!coefficients_.allFinite()) {
    throw InvalidInput("TorqueCoefficientTable: expected finite coefficients");
  }
  const double span = yaw_[yaw_.size() - 1] - yaw_[0];
  if (span > full_turn + tolerance) {
    throw InvalidInput(
        fmt::format("TorqueCoefficientTable: expected a yaw over at most 360 deg, found {} deg",
                    span * 360.0 / full_turn));
  }
  full_circle_ = span > full_turn - tolerance;
  if (!full_circle_) return;
  const double difference =
      (coefficients_.row(0) - coefficients_.row(yaw_.size() - 1)).cwiseAbs().maxCoeff();
  if (difference <= tolerance * coefficients_.cwiseAbs().maxCoeff()) return;
  throw InvalidInput(
      fmt::format("TorqueCoefficientTable: expected the same coefficients at both ends of a full "
                  "circle of yaw, found a difference of {}",
                  difference));
}

double TorqueCoefficientTable::at(double yaw, double elevation) const {
  if (full_circle_ && std::isfinite(yaw)) {
    yaw -= full_turn * std::floor((yaw - yaw_[0]) / full_turn);
  }
  const Place along = place_in("a yaw", yaw_, yaw);
  const Place up = place_in("an elevation", elevation_, elevation);
  const auto between = [&](Eigen::Index row) {
    return std::lerp(coefficients_(row, up.interval), coefficients_(row, up.interval + 1), up.rest);
  };
  return std::lerp(between(along.interval), between(along.interval + 1), along.rest);
}

double coefficient_from_eia_222(double coefficient) {
  constexpr double pressure_at_one_mile_an_hour = 0.00256;
  return coefficient / pressure_at_one_mile_an_hour;
}

WindSite at_attitude(const WindSite& site, const TorqueCoefficientTable& table, double yaw,
                     double elevation) {
  WindSite turned = site;
  turned.torque_coefficient = table.at(yaw, elevation);
  return turned;
}

AxisTorques mean_wind_torque(const WindSite& site, const AxisTorqueTables& tables, double yaw,
                             double elevation, double mean_speed) {
  return {mean_wind_torque(at_attitude(site, tables.azimuth, yaw, elevation), mean_speed),
          mean_wind_torque(at_attitude(site, tables.elevation, yaw, elevation), mean_speed)};
}

AxisTorques wind_torque_sensitivity(const WindSite& site, const AxisTorqueTables& tables,
                                    double yaw, double elevation, double mean_speed) {
  return {wind_torque_sensitivity(at_attitude(site, tables.azimuth, yaw, elevation), mean_speed),
          wind_torque_sensitivity(at_attitude(site, tables.elevation, yaw, elevation), mean_speed)};
}

}  // namespace boresight::plant
