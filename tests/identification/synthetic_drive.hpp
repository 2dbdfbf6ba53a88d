#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <boresight/identification/grey_box/grey_box.hpp>
#include <boresight/identification/grey_box/grey_box_parameters.hpp>
#include <boresight/identification/grey_box/grey_box_posterior.hpp>
#include <boresight/identification/grey_box/grey_box_simulation.hpp>
#include <boresight/numerics/normal_numbers.hpp>
#include <boresight/numerics/statistics/interval.hpp>

/// A small hydraulic drive with known truth, and the records it would give.
namespace boresight::identification::synthetic {

using P = GreyBoxParameters;

inline DriveKnowledge knowledge() {
  DriveKnowledge k;
  k.motor_count = 2.0;
  k.motor_inertia = {0.5, 0.0025};
  k.gear_inertia = {0.2, 0.01};
  k.antenna_inertia = {0.5, 0.05};
  k.displacement = {6e-6, 1.2e-8};
  k.torque_efficiency = {0.94, 0.003};
  k.volumetric_efficiency = {0.94, 0.005};
  k.oil_density = {860.0, 1.0};
  k.volume_1 = {0.0045, 0.000045};
  k.volume_2 = {0.0045, 0.000045};
  k.locked_rotor_frequencies = {{2.5, 0.075}};
  k.supply_pressure = 20e6;
  k.return_pressure = 0.4e6;
  k.tracking_rate = 2.0;
  return k;
}

inline Instruments instruments() {
  return {0.006, 2e4, 0.003, 0.03};
}

/// Something that moves, so that there are parameters to choose a truth among.
inline GreyBoxRecord glance() {
  GreyBoxRecord r;
  r.sample_time = 0.02;
  const Eigen::VectorXd wave = Eigen::VectorXd::LinSpaced(1000, 0.0, 60.0).array().sin().matrix();
  r.rate = 25.0 * wave;
  r.motion = r.rate;
  r.motion_slope = Eigen::VectorXd::Zero(1000);
  r.torque = 40.0 * wave;
  r.valve = 30.0 * wave;
  r.valve_calibrated = true;
  r.rate_counts.assign(1000, true);
  return r;
}

inline GreyBoxParameters truth_parameters() {
  Campaign campaign{knowledge(), instruments(), {}};
  return {campaign, {glance()}, numerics::normal_interval(1.3e9, 6.5e6)};
}

/// The point at which parameters have these values, the others their priors'.
inline Eigen::VectorXd point_of(const GreyBoxParameters& parameters,
                                const std::vector<std::pair<Eigen::Index, double>>& values) {
  Eigen::VectorXd point = Eigen::VectorXd::Zero(parameters.size());
  for (const auto& [index, value] : values) {
    const auto& p = parameters.list()[static_cast<std::size_t>(index)];
    point(index) =
        p.logarithmic ? std::log(value / p.prior) / p.spread : (value - p.prior) / p.spread;
  }
  return point;
}

inline std::vector<std::pair<Eigen::Index, double>> truth_values() {
  return {{P::motor_inertia, 1.004},     {P::gear_inertia, 0.19},    {P::antenna_inertia, 0.55},
          {P::coulomb_torque, 4.0},      {P::stribeck_torque, 2.0},  {P::stribeck_rate, 0.15},
          {P::saturating_torque, 14.0},  {P::saturating_rate, 1.5},  {P::viscous_friction, 0.5},
          {P::bristle_stiffness, 800.0}, {P::bristle_damping, 2.0},  {P::offset_torque, -2.5},
          {P::tachometer_zero, 0.02},    {P::tachometer_lag, 0.002}, {P::mode_damping, 0.012},
          {P::cross_leakage, 0.02},      {P::null_leakage, 0.002},   {P::case_leakage, 0.002},
          {P::valve_gain, 0.98},         {P::valve_null, 0.1},       {P::valve_lag, 0.005},
          {P::valve_lap, 0.1},           {P::fraction(0), 4.0},      {P::frequency(0), 2.55}};
}

/// A record as a recorder with errors would write it, 50 samples a second; torque and rate noise
/// of the given fraction of their usual size.
inline DriveRecord recorded(const GreyBoxRecord& run, double noise, std::uint64_t seed) {
  const numerics::NormalNumbers numbers(seed, 7);
  const DriveKnowledge k = knowledge();
  const double pressure = 1.0 / (torque_per_pressure(k) * k.motor_count);
  DriveRecord r;
  r.name = run.name;
  r.test = run.test;
  r.sample_time = run.sample_time;
  Eigen::VectorXd in = run.side_1 * pressure, out = run.side_2 * pressure, rate = run.rate;
  for (Eigen::Index i = 0; i < rate.size(); ++i) {
    const auto a = numbers.pair(static_cast<std::uint64_t>(2 * i));
    const auto b = numbers.pair(static_cast<std::uint64_t>(2 * i + 1));
    in(i) += noise * 5e5 * a.real();
    out(i) += noise * 5e5 * a.imag();
    rate(i) += noise * 2.0 * b.real();
  }
  r.inlet_pressure = {{in, {}}, {in, {}}};
  r.outlet_pressure = {{out, {}}, {out, {}}};
  r.motor_rate = {rate, {}};
  r.valve_command = Signal{run.valve, {}};
  r.rate_command = Signal{run.valve, {}};
  return r;
}

inline GreyBoxManoeuvre manoeuvre(const std::string& name, TestKind kind, double length,
                                  bool closed, const std::function<double(double)>& command) {
  GreyBoxManoeuvre m{name, kind, 0.02, {}, closed};
  m.command.resize(static_cast<Eigen::Index>(length / m.sample_time));
  for (Eigen::Index k = 0; k < m.command.size(); ++k) {
    m.command(k) = command(static_cast<double>(k) * m.sample_time);
  }
  return m;
}

inline std::vector<GreyBoxManoeuvre> tests() {
  const auto square = [](double t) {
    return t < 1.0 ? 0.0 : std::fmod(t - 1.0, 10.0) < 5.0 ? 1.0 : -1.0;
  };
  const auto triangle = [](double t) { return std::asin(std::sin(0.6 * t)) / 1.5708; };
  return {manoeuvre("slow", TestKind::constant_speed, 11.0, true,
                    [=](double t) { return 1.0 * square(t); }),
          manoeuvre("middle", TestKind::constant_speed, 11.0, true,
                    [=](double t) { return 4.0 * square(t); }),
          manoeuvre("fast", TestKind::constant_speed, 11.0, true,
                    [=](double t) { return 12.0 * square(t); }),
          manoeuvre("ramp", TestKind::fast_ramp, 21.0, false,
                    [=](double t) { return 28.0 * triangle(t); }),
          manoeuvre("sweep", TestKind::valve_chirp, 20.0, false,
                    [](double t) { return 8.0 + 3.0 * std::sin(0.7 * t * std::exp(0.1 * t)); })};
}

/// All tests of a drive at a point.
inline Campaign campaign(const GreyBoxParameters& parameters, const Eigen::VectorXd& point,
                         double noise, std::uint64_t seed) {
  Campaign c{knowledge(), instruments(), {}};
  for (const auto& test : tests()) {
    c.records.push_back(recorded(simulate_drive(parameters, point, test), noise, ++seed));
  }
  return c;
}

/// The oil's bulk modulus as another test gives it.
inline const numerics::Interval bulk = numerics::normal_interval(1.3e9, 6.5e6);

/// A fit from one start, with few samples.
inline GreyBoxOptions quick() {
  GreyBoxOptions options;
  options.further_starts = 0;
  options.random_samples = 400;
  options.threads = 1;
  return options;
}

/// The drive that the records are of.
struct Truth {
  GreyBoxParameters parameters = truth_parameters();
  Eigen::VectorXd point = point_of(parameters, truth_values());
  DriveEstimate drive = drive_estimate(parameters, point);
};

}  // namespace boresight::identification::synthetic
