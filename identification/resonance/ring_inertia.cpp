#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>

#include <fmt/format.h>

#include <boresight/identification/resonance/ring_inertia.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/statistics/distribution_quantiles.hpp>

namespace boresight::identification {
namespace {

using Complex = std::complex<double>;

// What all rings have in common.
struct Common {
  double stiffness;
  double motor_side;  // kg m2
  double lowest_fraction;
  std::vector<numerics::Uncertain> locked;
  double shape_scale = 1.0;  // of torque over rate
};

Complex pole_of(const StepRing& ring) {
  return {-ring.pole.decay_rate, two_pi * ring.pole.damped_frequency};
}

double inertia_of(ResonanceReading reading, const StepRing& ring, const Common& common) {
  const Complex s = pole_of(ring);
  const double loss = ring.total_loss_rate;
  if (reading == ResonanceReading::ring_single_mass) return common.stiffness / std::norm(s);
  if (reading == ResonanceReading::ring_with_losses) {
    // Bf = J (2 sigma - lambda) put into |s|^2 = (K + Bf lambda)/J.
    return common.stiffness / (std::norm(s) - loss * (-2.0 * s.real() - loss));
  }
  // B + s (Jm + (J - Jm) A) = torque over rate.
  const Complex shape = reading == ResonanceReading::ring_shape
                            ? common.shape_scale * ring.torque_over_rate
                            : -common.stiffness / (s + loss);
  const Complex a = flexible_amplification(s, common.locked, common.lowest_fraction);
  const Complex rest = shape - s * common.motor_side * (1.0 - a);
  return rest.imag() / (s * a).imag();
}

double mean_over(const std::vector<StepRing>& rings,
                 const std::function<double(const StepRing&)>& of) {
  double sum = 0.0;
  for (const auto& ring : rings) sum += of(ring);
  return sum / static_cast<double>(rings.size());
}

// Of the mean: by scatter, with Student's t over the normal's 1.96 for few rings; of one ring by
// its frequency's fit.
double scatter_of_mean(const std::vector<StepRing>& rings, double mean,
                       const std::function<double(const StepRing&)>& of) {
  const auto count = static_cast<double>(rings.size());
  double own = 0.0;
  for (const auto& ring : rings) {
    own += std::pow(2.0 * mean * ring.frequency.standard_uncertainty / ring.frequency.value, 2);
  }
  own = std::sqrt(own) / count;
  if (rings.size() < 2) return std::max(own, 0.05 * mean);
  double square = 0.0;
  for (const auto& ring : rings) square += std::pow(of(ring) - mean, 2);
  const double freedom = count - 1.0;
  const double few = numerics::student_quantile(0.975, freedom) / numerics::normal_975;
  return std::max(own, few * std::sqrt(square / freedom / count));
}

}  // namespace

numerics::Interval ring_inertia(ResonanceReading reading, const std::vector<StepRing>& rings,
                                const numerics::Interval& stiffness, const DriveRecord& record,
                                const Campaign& campaign, const ResonanceOptions& options) {
  if (rings.empty() || reading == ResonanceReading::spectrum_peak ||
      reading == ResonanceReading::impedance) {
    throw InvalidInput(fmt::format(
        "ring_inertia: expected at least one ring and a reading of rings, found {} rings",
        rings.size()));
  }
  const auto& knowledge = campaign.knowledge;
  const double motors = knowledge.motor_count;
  Common common{stiffness.value,
                motors * knowledge.motor_inertia.value + knowledge.gear_inertia.value,
                options.lowest_mode_fraction.value, knowledge.locked_rotor_frequencies, 1.0};
  const auto mean = [&](const Common& at) {
    return mean_over(rings, [&](const StepRing& ring) { return inertia_of(reading, ring, at); });
  };
  const double value = mean(common);
  double variance = std::pow(
      scatter_of_mean(rings, value,
                      [&](const StepRing& ring) { return inertia_of(reading, ring, common); }),
      2);
  const auto add = [&](double& input, double uncertainty) {
    const double nominal = input;
    input = nominal + uncertainty;
    variance += std::pow(mean(common) - value, 2);
    input = nominal;
  };
  add(common.stiffness, stiffness.standard_uncertainty);
  add(common.motor_side, std::hypot(motors * knowledge.motor_inertia.standard_uncertainty,
                                    knowledge.gear_inertia.standard_uncertainty));
  add(common.lowest_fraction, -options.lowest_mode_fraction.standard_uncertainty);
  add(common.shape_scale, std::hypot(torque_scale_uncertainty(record, campaign),
                                     campaign.instruments.tachometer_scale));
  for (auto& mode : common.locked) add(mode.value, mode.standard_uncertainty);
  return numerics::normal_interval(value, std::sqrt(variance));
}

numerics::Interval leakage_from_damping(const std::vector<StepRing>& rings,
                                        const numerics::Interval& stiffness,
                                        const DriveKnowledge& knowledge,
                                        const ResonanceOptions& options) {
  if (rings.empty() || !options.friction_slope) {
    throw InvalidInput(
        fmt::format("leakage_from_damping: expected rings and options.friction_slope, found {} "
                    "rings and {} slope",
                    rings.size(), options.friction_slope ? "a" : "no"));
  }
  const numerics::Uncertain slope = *options.friction_slope;
  const double motor_side =
      knowledge.motor_count * knowledge.motor_inertia.value + knowledge.gear_inertia.value;
  const auto mean = [&](double k, double friction) {
    return mean_over(rings, [&](const StepRing& ring) {
      const Complex s = pole_of(ring);
      const Complex a = flexible_amplification(s, knowledge.locked_rotor_frequencies,
                                               options.lowest_mode_fraction.value);
      const Complex motor = s * motor_side * (1.0 - a);
      double loss = ring.total_loss_rate;
      for (int round = 0; round < 200; ++round) {
        const Complex impedance = -k / (s + loss);
        const double inertia = (impedance - motor).imag() / (s * a).imag();
        const double real = friction + (motor + inertia * s * a).real();
        // Re(-K/(s + lambda)) is -K (Re s + lambda)/|s + lambda|^2.
        loss = 0.5 * loss + 0.5 * (-real * std::norm(s + loss) / k - s.real());
      }
      if (!std::isfinite(loss)) {
        throw NumericalFailure(fmt::format(
            "leakage_from_damping: no loss rate fits the ring at {:.2f} s with a friction slope of "
            "{} N m s/rad",
            ring.time, friction));
      }
      return loss - (ring.total_loss_rate - ring.leakage_rate);
    });
  };
  const double value = mean(stiffness.value, slope.value);
  double square = 0.0, orifices = 0.0, total = 0.0;
  for (const auto& ring : rings) {
    total += ring.total_loss_rate / static_cast<double>(rings.size());
    square +=
        std::pow(2.0 * two_pi * ring.damping_ratio.standard_uncertainty * ring.frequency.value, 2);
    orifices += (ring.total_loss_rate - ring.leakage_rate) / static_cast<double>(rings.size());
  }
  const double fit = std::sqrt(square) / static_cast<double>(rings.size());
  const double by_stiffness =
      mean(stiffness.value + stiffness.standard_uncertainty, slope.value) - value;
  const double by_friction =
      mean(stiffness.value, slope.value + slope.standard_uncertainty) - value;
  return numerics::normal_interval(
      value, std::hypot(std::hypot(fit, by_stiffness),
                        std::hypot(by_friction, 0.06 * orifices, 0.05 * total)));
}

}  // namespace boresight::identification
