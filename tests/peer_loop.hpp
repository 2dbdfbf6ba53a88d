#pragma once

#include <complex>
#include <vector>

#include "peer_family.hpp"
#include <boresight/control/loops/loop_evaluator.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/complex_packs.hpp>
#include <boresight/numerics/vector_clones.hpp>

/// The peers' antenna servo (peer_family.hpp) as an evaluator of control controllers sees it.
namespace boresight::reference {

/// Responses of the peers' plant at a frequency (rad/s), eight modes at a time.
class PeerChannels {
 public:
  explicit PeerChannels(const PeerModes& modes)
      : modes_(numerics::pack_count(static_cast<std::size_t>(modes.frequency.size()))) {
    for (std::size_t i = 0; i < modes_.size() * numerics::pack_size; ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      const bool there = k < modes.frequency.size();
      const auto value = [&](const Eigen::VectorXd& x) { return there ? x[k] : 0.0; };
      const double w = there ? modes.frequency[k] : 1.0;
      ModePack& pack = modes_[i / numerics::pack_size];
      const std::size_t lane = i % numerics::pack_size;
      pack.stiffness.set(lane, w * w);
      pack.damping.set(lane, 2.0 * value(modes.damping_ratio) * w);
      pack.motor_motor.set(lane, value(modes.motor) * value(modes.motor));
      pack.motor_wind.set(lane, value(modes.motor) * value(modes.wind));
      pack.boresight_motor.set(lane, value(modes.boresight) * value(modes.motor));
      pack.boresight_wind.set(lane, value(modes.boresight) * value(modes.wind));
    }
  }
  explicit PeerChannels(Eigen::Index modes) : PeerChannels(peer_modes(modes)) {}

  plant::ResponsePoint operator()(double frequency) const {
    using Complex = std::complex<double>;
    ModeSum sum;
    numerics::run_on_widest_lanes<ModeSum>(modes_, frequency, sum);
    const PeerDrive& d = drive_;
    const Complex s{0.0, frequency};
    const double rigid = -1.0 / (d.inertia * frequency * frequency);
    const auto total = [&](const numerics::ComplexPack& x) {
      return Complex{rigid + numerics::sum(x.re), numerics::sum(x.im)};
    };
    const double wv = d.valve_frequency;
    const Complex valve = wv * wv / (s * s + 2.0 * d.valve_damping * wv * s + wv * wv);
    const Complex oil = d.stiffness / (s + d.leakage);
    const Complex drag = (oil + d.friction) * s;
    const Complex a = total(sum.motor_motor), b = total(sum.motor_wind);
    const Complex inverse = 1.0 / (1.0 + a * drag);
    const Complex lag = s * d.tachometer_corner / (s + d.tachometer_corner);
    plant::ResponsePoint point;
    point.encoder_command = a * oil * valve * inverse;
    point.encoder_wind = b * inverse;
    const Complex force_command = oil * valve * inverse;  // what drives motor and modes
    const Complex force_wind = -drag * point.encoder_wind;
    point.tachometer_command = lag * point.encoder_command;
    point.tachometer_wind = lag * point.encoder_wind;
    point.torque_command = oil * (valve - s * point.encoder_command);
    point.torque_wind = -oil * s * point.encoder_wind;
    point.boresight_command = total(sum.boresight_motor) * force_command;
    point.boresight_wind = total(sum.boresight_motor) * force_wind + total(sum.boresight_wind);
    return point;
  }

 private:
  struct ModePack {
    numerics::RealPack stiffness, damping, motor_motor, motor_wind, boresight_motor, boresight_wind;
  };
  // What the modes of each lane add up to.
  struct ModeSum {
    numerics::ComplexPack motor_motor, motor_wind, boresight_motor, boresight_wind;

    template <std::size_t width>
    [[gnu::always_inline]] static inline void run(const std::vector<ModePack>& modes,
                                                  const double& frequency, ModeSum& sum) {
      using Complex = numerics::ComplexLanes<width>;
      using Real = numerics::RealLanes<width>;
      using numerics::part;
      const Real w = frequency, square = frequency * frequency;
      for (std::size_t k = 0; k < numerics::pack_size / width; ++k) {
        Complex motor_motor{}, motor_wind{}, boresight_motor{}, boresight_wind{};
        for (const ModePack& mode : modes) {
          const Real real = part<width>(mode.stiffness, k) - square;
          const Real imaginary = part<width>(mode.damping, k) * w;
          const Real scale = 1.0 / (real * real + imaginary * imaginary);
          const Complex inverse{real * scale, -imaginary * scale};
          motor_motor = motor_motor + inverse * part<width>(mode.motor_motor, k);
          motor_wind = motor_wind + inverse * part<width>(mode.motor_wind, k);
          boresight_motor = boresight_motor + inverse * part<width>(mode.boresight_motor, k);
          boresight_wind = boresight_wind + inverse * part<width>(mode.boresight_wind, k);
        }
        numerics::set_part(sum.motor_motor, k, motor_motor);
        numerics::set_part(sum.motor_wind, k, motor_wind);
        numerics::set_part(sum.boresight_motor, k, boresight_motor);
        numerics::set_part(sum.boresight_wind, k, boresight_wind);
      }
    }
  };
  PeerDrive drive_;
  std::vector<ModePack> modes_;
};

/// One-sided spectrum of the peers' wind torque, (N m)^2/Hz, at a frequency in Hz.
inline double peer_wind_spectrum(double hertz) {
  const PeerDrive d;
  const double w = two_pi * hertz;
  const double slow = d.slow_wind_corner, fast = d.fast_wind_corner;
  return 2.0 * d.wind_amplitude * d.wind_amplitude * (slow * slow / (w * w + slow * slow)) *
         (fast * fast / (w * w + fast * fast));
}

/// rms of the peers' pointing error (arcsec) of a beam variance (rad^2 of motor).
inline double peer_rms(double variance) {
  const PeerDrive d;
  return std::sqrt(variance) * d.arcseconds / d.gear_ratio;
}

/// The peers' gains as a controller: u = krp e_r + kri zr is krp (1 + wi/s), wi = kri/krp.
inline control::Controller peer_controller(const PeerGains& gains) {
  return {control::LoopStructure::pi(),
          {gains.rate_gain, gains.rate_integral / gains.rate_gain, gains.position_gain,
           gains.position_integral / gains.position_gain}};
}

/// What the rms of white noise through the wind filter takes: all frequencies where it is.
inline control::LoopQuadrature peer_quadrature() {
  control::LoopQuadrature quadrature;
  quadrature.analysis = {1e-6, 300.0};
  return quadrature;
}

inline control::LoopEvaluator peer_evaluator(Eigen::Index modes) {
  return {PeerChannels(modes),
          {.wind_spectrum = peer_wind_spectrum, .quadrature = peer_quadrature()}};
}

}  // namespace boresight::reference
