#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <vector>

#include <boresight/control/measured/measured_channels.hpp>

namespace boresight::control {

/// a + b w^2 + j c w: the low-frequency model of a channel.
struct LowEndFit {
  double constant = 0.0, square = 0.0, odd = 0.0;
  std::complex<double> at(double w) const { return {constant + square * w * w, odd * w}; }
};

/// The usable points of a measurement and their interpolation, for three channels per command:
/// tachometer, torque, encoder.
struct MeasuredChannels::Data {
  OilSpring oil;
  double tachometer_corner = 0.0;
  MeasuredChannelOptions options;
  bool encoder = true, errors = true;
  double degrees_of_freedom = 0.0;
  std::size_t left_out = 0;
  Eigen::ArrayXd frequency;
  std::vector<double> x;  // ln w
  std::vector<std::array<std::complex<double>, 3>> value,
      slope;                               // ln G, its angle followed; by ln w
  std::vector<Eigen::Matrix3cd> relative;  // covariance over G_i conj(G_j)
  std::vector<PointBand> unresolved, encoder_assumed;
  std::vector<bool> encoder_follows;  // per point: encoder assumed to follow the motor
  double resolved = 1.0;
  LowEndFit tachometer_low, impedance_low, gear_low;

  std::complex<double> lag(double w) const {
    return tachometer_corner / std::complex<double>(tachometer_corner, w);
  }

  std::size_t interval(double place) const {
    const auto above = std::upper_bound(x.begin() + 1, x.end() - 1, place);
    return static_cast<std::size_t>(above - x.begin()) - 1;
  }

  std::array<std::complex<double>, 3> command(double w) const {
    const double place = std::log(w);
    std::array<std::complex<double>, 3> result;
    if (place < x.front()) {
      const std::complex<double> rate = tachometer_low.at(w) / lag(w);
      return {tachometer_low.at(w), impedance_low.at(w) * rate,
              gear_low.at(w) * rate / std::complex<double>(0.0, w)};
    }
    if (place > x.back()) {
      const double fall = -options.roll_off * (place - x.back());
      for (std::size_t c = 0; c < 3; ++c) {
        result[c] = std::exp(value.back()[c] + (c == 2 ? fall - (place - x.back()) : fall));
      }
      return result;
    }
    const std::size_t i = interval(place);
    const double h = x[i + 1] - x[i], t = (place - x[i]) / h;
    const double s = t * t * (3.0 - 2.0 * t);
    for (std::size_t c = 0; c < 3; ++c) {
      result[c] = std::exp(value[i][c] * (1.0 - s) + value[i + 1][c] * s +
                           h * t * (1.0 - t) * (slope[i][c] * (1.0 - t) - slope[i + 1][c] * t));
    }
    return result;
  }

  Eigen::Matrix3cd relative_at(double w) const {
    const double place = std::clamp(std::log(w), x.front(), x.back());
    const std::size_t i = interval(place);
    const double t = (place - x[i]) / (x[i + 1] - x[i]);
    return (1.0 - t) * relative[i] + t * relative[i + 1];
  }

  plant::ResponsePoint with_wind(double w,
                                 const std::array<std::complex<double>, 3>& by_command) const {
    const std::complex<double> s(0.0, w);
    const std::complex<double> h = oil.stiffness / (s + oil.loss_rate);
    const auto& [tachometer, torque, angle] = by_command;
    // Y0/(1 + H Y0) with Y0 = rate/torque.
    const std::complex<double> rate = tachometer / lag(w);
    const std::complex<double> rate_wind = rate / (torque + h * rate);
    plant::ResponsePoint point;
    point.tachometer_command = tachometer;
    point.torque_command = torque;
    point.encoder_command = angle;
    point.tachometer_wind = lag(w) * rate_wind;
    point.torque_wind = -h * rate_wind;
    point.encoder_wind = angle / (torque + h * rate);
    const BendingPoint bending = options.bending ? options.bending(w) : BendingPoint{};
    point.boresight_command = bending.boresight_per_encoder * angle;
    point.boresight_wind =
        bending.boresight_per_encoder * point.encoder_wind + bending.boresight_per_wind;
    return point;
  }

  void take_points(const MeasuredPlant& plant);
  void find_unresolved(double lowest_asked, double highest_asked);
  void find_slopes();
  void fit_low();
};

}  // namespace boresight::control
