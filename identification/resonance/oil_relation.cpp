#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include <fmt/format.h>

#include <boresight/identification/resonance/drive_response_fit.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::identification {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::VectorXd;

constexpr Index relation_numbers = 5;
// The inner part of a band, to see what the choice of the band does.
constexpr double inner_lowest = 1.4;
constexpr double inner_highest = 0.6;

// What the hydraulic mode rests on.
struct ModeNumbers {
  double stiffness, loss, resistance, friction, rigid_inertia;
  const std::vector<StructuralMode>* modes;
};

// Root of (s + lambda) Z(s) + R s + K = 0 by Newton's method from the undamped one.
Complex hydraulic_pole(const ModeNumbers& of, double start) {
  const auto value = [&of](Complex s) {
    Complex z = of.friction + s * of.rigid_inertia;
    for (const auto& mode : *of.modes) {
      const Complex x = s / (two_pi * mode.frequency.value);
      const Complex spring = 1.0 + 2.0 * mode.damping_ratio.value * x;
      z += s * mode.inertia.value * spring / (spring + x * x);
    }
    return (s + of.loss) * z + of.resistance * s + of.stiffness;
  };
  Complex s(-0.1 * start, start);
  for (int iteration = 0; iteration < 60; ++iteration) {
    const double step = 1e-6 * std::abs(s);
    const Complex slope = (value(s + step) - value(s - step)) / (2.0 * step);
    if (slope == 0.0) break;
    const Complex change = value(s) / slope;
    s -= change;
    if (std::abs(change) < 1e-10 * std::abs(s)) return s;
  }
  return {std::numeric_limits<double>::quiet_NaN(), 0.0};
}

}  // namespace

bool shows_oil_relation(double lowest, double highest, double bin) {
  return inner_highest * highest - inner_lowest * lowest >=
         static_cast<double>(3 * relation_numbers) * bin;
}

OilRelation fit_oil_relation(const WindowedTransforms& torque, const WindowedTransforms& rate,
                             const WindowedTransforms& command, double lowest, double highest,
                             double bin, double scale, double tachometer) {
  const auto over = [&](double low, double high) {
    const FrequencyBand band = frequency_band(low, high, bin, torque.value.size());
    Eigen::MatrixXcd columns(band.count, relation_numbers);
    columns.col(0) = -torque.value.segment(band.first, band.count);
    columns.col(1) = -rate.value.segment(band.first, band.count);
    columns.col(2) = command.value.segment(band.first, band.count);
    columns.col(3) = command.derivative.segment(band.first, band.count);
    // Pressure lost in the lines, R w: the ports' torque is that much below the valve's.
    columns.col(4) = -rate.derivative.segment(band.first, band.count);
    return real_least_squares(columns, torque.derivative.segment(band.first, band.count),
                              VectorXd::Ones(band.count), 0,
                              "drive_response: change of torque on torque, rate and valve command");
  };
  const RealFit fit = over(lowest, highest);
  const RealFit narrower = over(inner_lowest * lowest, inner_highest * highest);
  const auto own = [&](Index k) {
    return std::hypot(std::sqrt(fit.covariance(k, k)), 0.4 * (fit.x(k) - narrower.x(k)));
  };
  OilRelation oil;
  oil.stiffness = scaled_interval(fit.x(1), own(1), std::hypot(scale, tachometer));
  // The torque's scale is on both sides of dT/dt = - lambda T.
  oil.total_loss_rate = numerics::normal_interval(fit.x(0), own(0));
  const double gain = fit.x(2) / fit.x(1);
  oil.valve_gain =
      scaled_interval(gain, gain * std::hypot(own(2) / fit.x(2), own(1) / fit.x(1)), tachometer);
  oil.valve_delay = -fit.x(3) / fit.x(2);
  oil.line_resistance = numerics::normal_interval(fit.x(4), own(4));
  return oil;
}

void add_hydraulic_mode(DriveResponse& response, const OilRelation& oil) {
  const auto& impedance = response.impedance;
  // What depends on modes above the band counts as rigid.
  double rigid = impedance.inertia.value;
  for (const auto& mode : impedance.modes) rigid -= mode.inertia.value;
  const ModeNumbers nominal{oil.stiffness.value,
                            oil.total_loss_rate.value,
                            oil.line_resistance.value,
                            impedance.friction_slope.value,
                            rigid,
                            &impedance.modes};
  const double start = std::sqrt(std::max(oil.stiffness.value, 0.0) / impedance.inertia.value);
  const Complex pole = hydraulic_pole(nominal, start);
  if (!std::isfinite(pole.real()) || !(pole.imag() > 0.5 * start) || pole.imag() > 2.0 * start) {
    response.notes.push_back(
        fmt::format("{}: stiffness, loss and impedance make no hydraulic mode near {:.3f} Hz",
                    response.record, start / two_pi));
    return;
  }
  const double natural = std::abs(pole), zeta = -pole.real() / natural;
  double frequency_square = 0.0, damping_square = 0.0;
  const auto vary = [&](double ModeNumbers::*number, double uncertainty) {
    ModeNumbers other = nominal;
    other.*number += uncertainty;
    const Complex there = hydraulic_pole(other, start);
    if (!std::isfinite(there.real())) return;
    frequency_square += std::pow(std::abs(there) - natural, 2);
    damping_square += std::pow(-there.real() / std::abs(there) - zeta, 2);
  };
  vary(&ModeNumbers::stiffness, oil.stiffness.standard_uncertainty);
  vary(&ModeNumbers::loss, oil.total_loss_rate.standard_uncertainty);
  vary(&ModeNumbers::resistance, oil.line_resistance.standard_uncertainty);
  vary(&ModeNumbers::friction, impedance.friction_slope.standard_uncertainty);
  vary(&ModeNumbers::rigid_inertia, impedance.inertia.standard_uncertainty);
  response.hydraulic_frequency =
      numerics::normal_interval(natural / two_pi, std::sqrt(frequency_square) / two_pi);
  response.hydraulic_damping_ratio = numerics::normal_interval(zeta, std::sqrt(damping_square));
}

double orifice_loss_rate(const DriveRecord& record, const DriveKnowledge& knowledge,
                         double stiffness, double mean_flow, Index first, Index count) {
  const auto mean = [&](const std::vector<Signal>& signals) {
    double sum = 0.0;
    for (const auto& signal : signals) sum += signal.values.segment(first, count).mean();
    return sum / static_cast<double>(signals.size());
  };
  const double inlet = mean(record.inlet_pressure), outlet = mean(record.outlet_pressure);
  // The valve feeds the inlets when the drive goes up, the outlets when it goes down.
  const double fed = mean_flow >= 0.0 ? inlet : outlet;
  const double drained = mean_flow >= 0.0 ? outlet : inlet;
  const double minimum = 0.02 * (knowledge.supply_pressure - knowledge.return_pressure);
  const double drop_in = std::max(knowledge.supply_pressure - fed, minimum);
  const double drop_out = std::max(drained - knowledge.return_pressure, minimum);
  const double torque_per_difference = torque_per_pressure(knowledge) * knowledge.motor_count;
  return stiffness * std::abs(mean_flow) / (2.0 * torque_per_difference) * 0.5 *
         (0.5 / drop_in + 0.5 / drop_out);
}

}  // namespace boresight::identification
