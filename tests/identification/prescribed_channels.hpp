#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <boresight/identification/records/channel_consistency.hpp>
#include <boresight/numerics/normal_numbers.hpp>

/// Records of a drive whose channels have errors that are known.
namespace boresight::identification::prescribed {

struct Errors {
  double gain = 1.0;
  double zero = 0.0;  // Pa
};

struct Drive {
  std::size_t motors = 4;
  std::vector<Errors> inlet = std::vector<Errors>(4), outlet = std::vector<Errors>(4);
  double line_loss = 0.0;  // Pa s/rad at the last motor's inlet, in proportion at others'
  double tachometer_gain = 1.0;
  double tachometer_zero = 0.0;   // rad/s
  double tachometer_delay = 0.0;  // s
  double encoder_noise = 2e-6;    // rad at the sky
  double tachometer_noise = 0.02;
  double pressure_noise = 5e3;  // Pa
  double wind_up = 0.005;       // rad of motor per N m, between motor and encoder
  bool has_encoder = true;
};

inline DriveKnowledge knowledge() {
  DriveKnowledge k;
  k.motor_count = 4.0;
  k.displacement = {6e-6, 1e-8};
  k.torque_efficiency = {0.94, 0.003};
  k.supply_pressure = 20e6;
  k.gear_ratio = 20000.0;
  return k;
}

inline Instruments instruments() {
  return {0.006, 2e4, 0.003, 0.03};
}

/// The motion of one record: swings of several periods about rest.
struct Motion {
  double phase = 0.0;
  double rate(double t) const {
    return 12.0 * std::sin(0.7 * t + phase) + 5.0 * std::sin(1.9 * t) +
           1.5 * std::sin(4.3 * t + 2.0 * phase);
  }
  double angle(double t) const {
    return -12.0 / 0.7 * std::cos(0.7 * t + phase) - 5.0 / 1.9 * std::cos(1.9 * t) -
           1.5 / 4.3 * std::cos(4.3 * t + 2.0 * phase);
  }
  double acceleration(double t) const {
    return 8.4 * std::cos(0.7 * t + phase) + 9.5 * std::cos(1.9 * t) +
           6.45 * std::cos(4.3 * t + 2.0 * phase);
  }
  double torque(double t) const { return acceleration(t) + 40.0 * std::tanh(rate(t)); }
};

/// Raw and cleaned records, of the seed's noise.
class Records {
 public:
  Records(const Drive& drive, std::size_t count, std::uint64_t seed) {
    for (std::size_t i = 0; i < count; ++i) add(drive, i, seed + 1000 * i);
    for (std::size_t i = 0; i < count; ++i) evaluated_.push_back({&raw_[i], &clean_[i]});
  }
  RawRecord& raw(std::size_t i) { return raw_[i]; }
  CleanRecord& clean(std::size_t i) { return clean_[i]; }
  const std::vector<EvaluatedRecord>& evaluated() {
    for (std::size_t i = 0; i < raw_.size(); ++i) evaluated_[i] = {&raw_[i], &clean_[i]};
    return evaluated_;
  }
  std::vector<ChannelCheck> check(const ChannelConsistencyOptions& options = {}) {
    return channel_consistency(evaluated(), knowledge(), instruments(), options);
  }

 private:
  void add(const Drive& drive, std::size_t index, std::uint64_t seed) {
    constexpr Eigen::Index samples = 4000;
    constexpr double step = 0.02;
    const Motion motion{0.9 * static_cast<double>(index)};
    const DriveKnowledge k = knowledge();
    std::uint64_t channel = 0;
    const auto series = [&](double noise, const auto& value) {
      const numerics::NormalNumbers normal(seed, channel++);
      Eigen::VectorXd values(samples);
      for (Eigen::Index i = 0; i < samples; ++i) {
        values(i) = value(step * static_cast<double>(i)) +
                    noise * normal.pair(static_cast<std::uint64_t>(i)).real();
      }
      return values;
    };
    RawRecord raw;
    raw.name = "record " + std::to_string(index + 1);
    raw.test = TestKind::fast_ramp;
    raw.time = Eigen::VectorXd::LinSpaced(samples, 0.0, step * static_cast<double>(samples - 1));
    const double half = 0.5 / (torque_per_pressure(k) * static_cast<double>(drive.motors));
    for (std::size_t motor = 0; motor < drive.motors; ++motor) {
      const auto number = std::to_string(motor + 1);
      const double loss =
          drive.line_loss * static_cast<double>(motor + 1) / static_cast<double>(drive.motors);
      const auto port = [&](const Errors& errors, double side, const std::string& name) {
        RawChannel one;
        one.name = "p" + number + name;
        one.values = series(drive.pressure_noise, [&](double t) {
          const double pressure = 9e6 + side * (half * motion.torque(t) - loss * motion.rate(t));
          return errors.gain * pressure + errors.zero;
        });
        return one;
      };
      raw.inlet.push_back(port(drive.inlet[motor], 1.0, "_in"));
      raw.outlet.push_back(port(drive.outlet[motor], -1.0, "_out"));
    }
    raw.tachometer.name = "tach";
    raw.tachometer.values = series(drive.tachometer_noise, [&](double t) {
      return drive.tachometer_gain * motion.rate(t - drive.tachometer_delay) +
             drive.tachometer_zero;
    });
    if (drive.has_encoder) {
      raw.encoder.emplace();
      raw.encoder->name = "encoder";
      raw.encoder->values = series(drive.encoder_noise, [&](double t) {
        return (motion.angle(t) - drive.wind_up * motion.torque(t)) / k.gear_ratio;
      });
    }
    CleanRecord clean;
    clean.record.emplace();
    clean.record->name = raw.name;
    clean.record->test = raw.test;
    clean.record->sample_time = step;
    for (const auto& one : raw.inlet) clean.record->inlet_pressure.push_back({one.values, {}});
    for (const auto& one : raw.outlet) clean.record->outlet_pressure.push_back({one.values, {}});
    clean.record->motor_rate = {raw.tachometer.values, {}};
    if (raw.encoder) clean.record->encoder = Signal{raw.encoder->values, {}};
    raw_.push_back(std::move(raw));
    clean_.push_back(std::move(clean));
  }

  std::vector<RawRecord> raw_;
  std::vector<CleanRecord> clean_;
  std::vector<EvaluatedRecord> evaluated_;
};

}  // namespace boresight::identification::prescribed
