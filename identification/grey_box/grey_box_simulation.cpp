#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <boresight/identification/grey_box/grey_box_hydraulics.hpp>
#include <boresight/identification/grey_box/grey_box_mechanics.hpp>
#include <boresight/identification/grey_box/grey_box_simulation.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::identification {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using Hydraulic = HydraulicCoefficients;
using Mechanical = MechanicalCoefficients;

constexpr Index steps_per_sample = 5;

}  // namespace

GreyBoxRecord simulate_drive(const GreyBoxParameters& parameters, const VectorXd& point,
                             const GreyBoxManoeuvre& manoeuvre) {
  const Index samples = manoeuvre.command.size();
  if (samples < 2 || !(manoeuvre.sample_time > 0.0) || !manoeuvre.command.allFinite()) {
    throw InvalidInput(fmt::format(
        "simulate_drive: expected at least two finite samples and a positive sample time, found {} "
        "and {}",
        samples, manoeuvre.sample_time));
  }
  const VectorXd mechanical = parameters.mechanical(point).values;
  const VectorXd hydraulic = parameters.hydraulic(point, true).values;
  const double h = manoeuvre.sample_time / static_cast<double>(steps_per_sample);
  MechanicalStepper motor(mechanical, h, false);
  const double zero = mechanical(Mechanical::tachometer_zero);
  const double decay = std::exp(-h / hydraulic(Hydraulic::valve_lag));
  const auto& units = parameters.units();

  // At rest the sides' mean is where leakage in and out balance, friction holds the offset.
  const double in = hydraulic(Hydraulic::null_leakage);
  const double out = hydraulic(Hydraulic::case_leakage);
  const double level =
      in * (hydraulic(Hydraulic::supply_torque) + units.return_torque) / (2.0 * in + out);
  Eigen::Vector2d p = Eigen::Vector2d::Constant(level);
  motor.restart(0.0, 0.0);
  const double stiffness = hydraulic(Hydraulic::stiffness_1) + hydraulic(Hydraulic::stiffness_2);
  double inertia = mechanical(Mechanical::rigid_inertia);
  for (Index i = 0; i < parameters.mode_count(); ++i) {
    inertia += mechanical(Mechanical::inertia(i));
  }
  const double integral_gain = 0.1 * std::sqrt(stiffness / inertia);

  GreyBoxRecord record;
  record.name = manoeuvre.name;
  record.test = manoeuvre.test;
  record.sample_time = manoeuvre.sample_time;
  record.valve_calibrated = true;
  for (auto* series : {&record.side_1, &record.side_2, &record.rate, &record.torque, &record.common,
                       &record.motion, &record.motion_slope, &record.valve}) {
    series->setZero(samples);
  }
  double spool = manoeuvre.rate_loop_closed ? 0.0 : manoeuvre.command(0);
  double integral = 0.0;
  const VectorXd no_derivatives;
  for (Index k = 0; k < samples; ++k) {
    const double tachometer = motor.tachometer() + zero;
    const double command = manoeuvre.command(k);
    double valve = command;
    if (manoeuvre.rate_loop_closed) {
      integral += integral_gain * manoeuvre.sample_time * (command - tachometer);
      valve += integral;
    }
    record.side_1(k) = p(0);
    record.side_2(k) = p(1);
    record.rate(k) = tachometer;
    record.motion(k) = tachometer;
    record.valve(k) = valve;
    if (k + 1 == samples) break;
    const double next_valve = manoeuvre.rate_loop_closed ? valve : manoeuvre.command(k + 1);
    for (Index step = 0; step < steps_per_sample; ++step) {
      const double place = (static_cast<double>(step) + 0.5) / steps_per_sample;
      const double wanted = valve + place * (next_valve - valve);
      spool = wanted + (spool - wanted) * decay;
      const double opening = port_opening(hydraulic, units, spool).value;
      const auto now = pressure_rates(hydraulic, units, p, opening, motor.rate());
      const auto half =
          pressure_rates(hydraulic, units, p + 0.5 * h * now.value, opening, motor.rate());
      const Eigen::Vector2d middle = p + 0.5 * h * half.value;
      p += h * half.value;
      const bool moved = motor.step(middle(0) - middle(1), 0.0, 0.0, no_derivatives);
      if (!moved || !p.allFinite() || !std::isfinite(motor.rate())) {
        throw NumericalFailure(fmt::format("simulate_drive: the model runs away in '{}' after {} s",
                                           manoeuvre.name,
                                           static_cast<double>(k) * manoeuvre.sample_time));
      }
    }
  }
  record.torque = record.side_1 - record.side_2;
  record.common = 0.5 * (record.side_1 + record.side_2);
  record.common.array() -= record.common.mean();
  record.motion_slope.segment(1, samples - 2) =
      (record.motion.tail(samples - 2) - record.motion.head(samples - 2)) /
      (2.0 * manoeuvre.sample_time);
  const auto size = static_cast<std::size_t>(samples);
  const auto settling = std::min(size, static_cast<std::size_t>(1.0 / manoeuvre.sample_time));
  record.rate_known.assign(size, true);
  record.rate_counts.assign(size, true);
  std::fill_n(record.rate_counts.begin(), settling, false);
  record.pressure_counts = record.rate_counts;
  record.rate_restarts.assign(size, false);
  record.rate_restarts[0] = true;
  record.pressure_restarts = record.rate_restarts;
  return record;
}

GreyBoxValidation validate_drive(const GreyBoxParameters& parameters, const VectorXd& point,
                                 const GreyBoxRecord& record) {
  if (record.valve.size() == 0 || !record.valve_calibrated) {
    throw InvalidInput(fmt::format(
        "validate_drive: record '{}' has no valve command to drive the model by", record.name));
  }
  GreyBoxManoeuvre manoeuvre;
  manoeuvre.name = record.name;
  manoeuvre.sample_time = record.sample_time;
  manoeuvre.command = record.valve;
  const GreyBoxRecord run = simulate_drive(parameters, point, manoeuvre);
  const VectorXd torque = record.side_1 - record.side_2;
  double rate_error = 0.0, torque_error = 0.0, rate_size = 0.0, torque_size = 0.0;
  const double rate_mean = record.rate.mean(), torque_mean = torque.mean();
  for (Index k = 0; k < record.samples(); ++k) {
    const auto at = static_cast<std::size_t>(k);
    if (!record.rate_counts[at]) continue;
    rate_error += std::pow(run.rate(k) - record.rate(k), 2);
    torque_error += std::pow(run.torque(k) - torque(k), 2);
    rate_size += std::pow(record.rate(k) - rate_mean, 2);
    torque_size += std::pow(torque(k) - torque_mean, 2);
  }
  return {std::sqrt(rate_error / rate_size), std::sqrt(torque_error / torque_size)};
}

}  // namespace boresight::identification
