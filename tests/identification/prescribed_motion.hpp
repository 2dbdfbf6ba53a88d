#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <string>

#include <Eigen/Core>

#include <boresight/identification/records/drive_record.hpp>
#include <boresight/numerics/normal_numbers.hpp>
#include <boresight/plant/antenna/friction.hpp>

namespace boresight::reference {

/// A rigid antenna that moves as prescribed: the torque follows exactly, T = J w' + F(w) + offset,
/// and with it the pressures of two motors about a common level, as instruments with given errors
/// show them.
struct PrescribedMotion {
  double inertia = 1.8;  // kg m2
  plant::FrictionCurve friction{10.0, 16.0, 0.2, 60.0, 1.5, 2.0};
  double offset = -6.0;        // N m
  double sample_time = 0.005;  // s
  double common_pressure = 9e6;
  double pressure_noise = 0.0;  // Pa
  double rate_noise = 0.0;      // rad/s
  double rate_limit = std::numeric_limits<double>::infinity();
  double tachometer_scale = 0.0;  // recorded = (1 + scale) true
  double tachometer_zero = 0.0;
  Eigen::Vector4d gain = Eigen::Vector4d::Zero();  // inlets, then outlets
  Eigen::Vector4d zero = Eigen::Vector4d::Zero();  // Pa
  double skew = 0.0;  // of the fast ramp: speeds up within a shorter time than it slows down
  double sign = 1.0;  // -1: everything mirrored
  std::uint64_t seed = 1;

  static identification::DriveKnowledge knowledge() {
    identification::DriveKnowledge known;
    known.motor_count = 2.0;
    known.motor_inertia = {0.5, 0.005};
    known.gear_inertia = {0.2, 0.01};
    known.antenna_inertia = {0.45, 0.04};
    known.displacement = {1.2e-5, 2.4e-8};
    known.torque_efficiency = {0.94, 0.003};
    return known;
  }

  /// Record of a rate and its derivative over `duration` (s); `held` is the torque at rest (rate
  /// and acceleration 0). `stream`: of the noise.
  identification::DriveRecord record(const std::string& name, identification::TestKind test,
                                     double duration, const std::function<double(double)>& rate,
                                     const std::function<double(double)>& acceleration,
                                     const std::function<double(double)>& held = {},
                                     std::uint64_t stream = 0) const {
    const auto samples = static_cast<Eigen::Index>(std::lround(duration / sample_time)) + 1;
    identification::DriveRecord made;
    made.name = name;
    made.test = test;
    made.sample_time = sample_time;
    made.motor_rate_limit = rate_limit;
    made.inlet_pressure.resize(2);
    made.outlet_pressure.resize(2);
    for (auto* side : {&made.inlet_pressure, &made.outlet_pressure}) {
      for (auto& signal : *side) signal.values.resize(samples);
    }
    made.motor_rate.values.resize(samples);
    made.motor_rate.valid.assign(static_cast<std::size_t>(samples), true);
    const numerics::NormalNumbers normal(seed, stream);
    const double scale = identification::torque_per_pressure(knowledge());
    for (Eigen::Index i = 0; i < samples; ++i) {
      const double t = static_cast<double>(i) * sample_time;
      const double w = rate(t), a = acceleration(t);
      double torque = inertia * a + plant::friction_torque(friction, w) + offset;
      if (w == 0.0 && a == 0.0 && held) torque = held(t);
      const auto index = static_cast<std::uint64_t>(3 * i);
      const auto first = normal.pair(index), second = normal.pair(index + 1);
      const Eigen::Vector4d noise(first.real(), first.imag(), second.real(), second.imag());
      for (Eigen::Index motor = 0; motor < 2; ++motor) {
        const double half = sign * torque / (4.0 * scale);
        const auto at = static_cast<std::size_t>(motor);
        made.inlet_pressure[at].values(i) = (1.0 + gain(motor)) * (common_pressure + half) +
                                            zero(motor) + pressure_noise * noise(motor);
        made.outlet_pressure[at].values(i) = (1.0 + gain(motor + 2)) * (common_pressure - half) +
                                             zero(motor + 2) + pressure_noise * noise(motor + 2);
      }
      double shown = sign * (1.0 + tachometer_scale) * w + tachometer_zero +
                     rate_noise * normal.pair(index + 2).real();
      if (std::abs(shown) >= rate_limit) {
        shown = shown > 0.0 ? rate_limit : -rate_limit;
        made.motor_rate.valid[static_cast<std::size_t>(i)] = false;
      }
      made.motor_rate.values(i) = shown;
    }
    return made;
  }

  /// Bipolar square wave of the rate through a first-order loop, three periods of 12 s.
  identification::DriveRecord constant_speed(double speed, double time_constant = 0.5) const {
    const double half = 6.0;
    const auto start = [=](double t) { return std::fmod(t, half); };
    const auto direction = [=](double t) {
      return static_cast<int>(t / half) % 2 == 0 ? 1.0 : -1.0;
    };
    return record(
        "constant speed", identification::TestKind::constant_speed, 36.0,
        [=](double t) {
          return direction(t) * speed * (1.0 - 2.0 * std::exp(-start(t) / time_constant));
        },
        [=](double t) {
          return direction(t) * speed * 2.0 / time_constant * std::exp(-start(t) / time_constant);
        },
        {}, static_cast<std::uint64_t>(1000.0 * speed));
  }

  /// Slow triangle: at rest 2 s, up to `peak` and down within 10 s, at rest, the other way; twice.
  identification::DriveRecord slow_ramp(double peak = 1.2) const {
    const auto shape = [](double t) { return std::fmod(t, 12.0) - 2.0; };  // 0 to 10 in motion
    const auto direction = [](double t) {
      return static_cast<int>(t / 12.0) % 2 == 0 ? 1.0 : -1.0;
    };
    return record(
        "slow ramp", identification::TestKind::slow_ramp, 48.0,
        [=](double t) {
          const double x = shape(t);
          return x <= 0.0 ? 0.0 : direction(t) * peak * (x < 5.0 ? x / 5.0 : (10.0 - x) / 5.0);
        },
        [=](double t) {
          const double x = shape(t);
          return x <= 0.0 ? 0.0 : direction(t) * peak * (x < 5.0 ? 0.2 : -0.2);
        },
        [=, this](double t) {
          return offset + direction(t) * friction.breakaway_torque * (shape(t) + 2.0) / 2.0;
        },
        1);
  }

  /// Sine of the rate (skewed), at rest for 1 s first.
  identification::DriveRecord fast_ramp(double peak = 30.0, double period = 10.0,
                                        double duration = 41.0) const {
    const double w = 2.0 * std::numbers::pi / period;
    return record(
        "fast ramp", identification::TestKind::fast_ramp, duration,
        [=, this](double t) {
          const double x = w * (t - 1.0);
          return t < 1.0 ? 0.0 : peak * std::sin(x + skew * std::sin(x));
        },
        [=, this](double t) {
          const double x = w * (t - 1.0);
          return t < 1.0 ? 0.0
                         : peak * w * std::cos(x + skew * std::sin(x)) * (1.0 + skew * std::cos(x));
        },
        [this](double) { return offset; }, 2);
  }

  identification::Campaign campaign() const {
    identification::Campaign made;
    made.knowledge = knowledge();
    made.records = {slow_ramp(),         constant_speed(0.6),  constant_speed(2.0),
                    constant_speed(6.0), constant_speed(18.0), fast_ramp()};
    return made;
  }
};

}  // namespace boresight::reference
