#pragma once

#include "design/reference_problem.hpp"
#include <boresight/control/measured/measured_channels.hpp>
#include <boresight/numerics/normal_numbers.hpp>
#include <boresight/plant/antenna/point_response.hpp>

/// The reference antenna as a test would measure it: its exact response to the valve command, with
/// noise of known coherence.
namespace boresight::reference {

/// What wind as a torque at the motor shaft does, from the two bodies' equations; the beam is the
/// encoder's angle.
inline plant::ResponsePoint with_wind_at_motor(const plant::AntennaPlant& plant, double w) {
  const auto structure = plant::structure_response(plant.structure, Eigen::ArrayXd::Constant(1, w));
  const auto b = structure.inertial_stiffness[0], g = structure.gear_stiffness[0];
  const plant::Drive& drive = plant.drive;
  const std::complex<double> s(0.0, w);
  const auto oil = drive.oil_stiffness / (s + drive.leakage_rate);
  const auto motor = drive.motor_inertia * s * s + drive.viscous_friction * s + oil * s + g;
  // [motor, -g; -g, g + b] [motor angle; bull gear angle] = [torque; 0]
  const auto motor_angle = (g + b) / (motor * (g + b) - g * g);
  plant::ResponsePoint point = plant::PointResponse(plant)(w);
  point.tachometer_wind = s * motor_angle * drive.tachometer_corner / (s + drive.tachometer_corner);
  point.torque_wind = -oil * s * motor_angle;
  point.encoder_wind = g / (g + b) * motor_angle;
  point.boresight_wind = point.encoder_wind;
  point.boresight_command = point.encoder_command;
  return point;
}

/// `coherence` of each channel with its command, as of 2 `averages` independent numbers; 1: exact.
inline control::MeasuredPlant measured_plant(const plant::AntennaPlant& plant,
                                             const Eigen::ArrayXd& frequency, double coherence,
                                             double averages, std::uint64_t seed = 1) {
  const Eigen::Index count = frequency.size();
  const plant::PointResponse response(plant);
  const numerics::NormalNumbers numbers(seed);
  control::MeasuredPlant measured{frequency,
                                  Eigen::ArrayXcd(count),
                                  Eigen::ArrayXcd(count),
                                  Eigen::ArrayXcd(count),
                                  {},
                                  0.0,
                                  Eigen::ArrayXXd::Constant(count, 3, coherence)};
  const double error = std::sqrt((1.0 - coherence) / (coherence * averages));
  std::uint64_t next = 0;
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto exact = response(frequency[i]);
    Eigen::Matrix3cd covariance = Eigen::Matrix3cd::Zero();
    Eigen::Index channel = 0;
    const auto noisy = [&](std::complex<double> value) {
      covariance(channel, channel) = std::norm(value) * error * error;
      ++channel;
      return value * (1.0 + error * std::sqrt(0.5) * numbers.pair(next++));
    };
    measured.tachometer[i] = noisy(exact.tachometer_command);
    measured.motor_torque[i] = noisy(exact.torque_command);
    measured.encoder[i] = noisy(exact.encoder_command);
    measured.covariance.push_back(covariance);
  }
  return measured;
}

inline control::OilSpring oil_spring(const plant::AntennaPlant& plant) {
  return {plant.drive.oil_stiffness, plant.drive.leakage_rate};
}

/// Bins of a record of that length (s), Hz to rad/s.
inline Eigen::ArrayXd bins(double length, double lowest, double highest) {
  const auto first = static_cast<Eigen::Index>(std::ceil(lowest * length));
  const auto last = static_cast<Eigen::Index>(std::floor(highest * length));
  return two_pi / length *
         Eigen::ArrayXd::LinSpaced(last - first + 1, static_cast<double>(first),
                                   static_cast<double>(last));
}

}  // namespace boresight::reference
