#include <algorithm>
#include <array>
#include <cmath>

#include <boresight/numerics/angles.hpp>
#include <boresight/plant/nonlinear/oscillating_drive.hpp>

namespace boresight::plant {
namespace {

constexpr int steps_per_period = 300, max_periods = 20;
constexpr double settled = 1e-3;

// e^(j phase) at the end of each step.
const std::array<std::complex<double>, steps_per_period>& phases() {
  static const auto all = [] {
    std::array<std::complex<double>, steps_per_period> one;
    for (std::size_t k = 0; k < one.size(); ++k) {
      one.at(k) = std::polar(1.0, two_pi * static_cast<double>(k + 1) / steps_per_period);
    }
    return one;
  }();
  return all;
}

class OscillatingDrive {
 public:
  OscillatingDrive(const FrictionDrive& drive, double step, double torque, double rate)
      : drive_(drive),
        step_(step),
        kept_(1.0 / (1.0 + step * drive.leakage_rate)),
        slope_(drive.inertia / step + step * drive.oil_stiffness * kept_),
        hold_(std::max(drive.friction.breakaway_torque, drive.friction.coulomb_torque)),
        torque_(torque),
        rate_(rate) {}

  void advance(double opening) {
    const double load = std::copysign(torque_ / drive_.supply_torque, opening * torque_);
    const double flow = opening * std::sqrt(std::max(0.0, 1.0 - load));
    const double filled = (torque_ + step_ * drive_.oil_stiffness * flow) * kept_;
    rate_ = moved_by(drive_.inertia / step_ * rate_ + filled);
    torque_ = filled - step_ * drive_.oil_stiffness * kept_ * rate_;
  }

  double torque() const { return torque_; }
  double rate() const { return rate_; }

 private:
  // w with slope w + F(w) = drive, by Newton's method kept within a bracket.
  double moved_by(double drive) const {
    const double size = std::abs(drive);
    if (size <= hold_) return 0.0;
    double low = 0.0, high = size / slope_;
    double w = std::min(high, std::abs(rate_));
    if (w == 0.0) w = 0.5 * high;
    constexpr int max_iterations = 40;
    constexpr double accuracy = 1e-10;
    for (int i = 0; i < max_iterations; ++i) {
      const double excess =
          slope_ * w + friction_torque(drive_.friction, w) + drive_.viscous_friction * w - size;
      (excess > 0.0 ? high : low) = w;
      double next =
          w - excess / (slope_ + friction_slope(drive_.friction, w) + drive_.viscous_friction);
      if (next <= low || next >= high) next = 0.5 * (low + high);
      const bool close = std::abs(next - w) <= accuracy * next;
      w = next;
      if (close) break;
    }
    return std::copysign(w, drive);
  }

  const FrictionDrive& drive_;
  double step_;   // s
  double kept_;   // of the torque after a step's leakage
  double slope_;  // N m s/rad, inertia and oil in one step
  double hold_;   // N m
  double torque_;
  double rate_;
};

}  // namespace

DriveOscillation oscillation_of(const FrictionDrive& drive, double frequency, double amplitude,
                                const DriveOscillation& before) {
  const double step = two_pi / (frequency * steps_per_period);
  OscillatingDrive motion(drive, step, before.end_torque, before.end_rate);
  DriveOscillation found;
  found.angle.resize(steps_per_period);
  // Of an opening that is the sine.
  const std::complex<double> per_opening{0.0, 2.0 / (steps_per_period * amplitude)};
  for (int period = 0; period < max_periods; ++period) {
    const std::complex<double> last_rate = found.rate, last_torque = found.torque;
    found.rate = found.torque = 0.0;
    double angle = 0.0;
    Eigen::Index place = 0;
    for (const std::complex<double> phase : phases()) {
      const double rate = motion.rate();
      motion.advance(amplitude * phase.imag());
      const std::complex<double> wave = per_opening * std::conj(phase);
      found.rate += wave * motion.rate();
      found.torque += wave * motion.torque();
      angle += 0.5 * step * (rate + motion.rate());
      found.angle[place++] = angle;
    }
    if (std::abs(found.rate - last_rate) <= settled * std::abs(found.rate) &&
        std::abs(found.torque - last_torque) <= settled * std::abs(found.torque)) {
      break;
    }
  }
  found.angle -= 0.5 * (found.angle.minCoeff() + found.angle.maxCoeff());
  found.end_torque = motion.torque();
  found.end_rate = motion.rate();
  return found;
}

}  // namespace boresight::plant
