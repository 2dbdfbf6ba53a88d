#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include <Eigen/Core>

#include <boresight/plant/integration/ode_integrator.hpp>
#include <boresight/plant/nonlinear/hydraulic_elements.hpp>

namespace boresight::reference {

/// A pump of variable displacement drives a motor with an inertia through two lines, high and low,
/// each with a make-up and a relief valve; a PI controller of the speed sets the displacement.
/// tests/data/hopsan names the model. A valve stays in its regime between its events.
class HydrostaticTransmission : public plant::OdeSystem {
 public:
  // The integral of what make-up valves give less what relief valves take is carried as a state.
  enum State : Eigen::Index {
    high,
    low,
    speed,
    error_integral,
    spool_high,
    spool_low,
    taken_in,
    count
  };

  double demanded_speed = 0.0;  // rad/s
  double transition = 100.0;    // Pa, of the orifices
  std::array<double, 2> stiffness{plant::volume_stiffness(1e9, 1e-4),
                                  plant::volume_stiffness(1e9, 1e-3)};
  double pump_displacement = 5e-4 / (2.0 * std::numbers::pi);  // m3/rad
  double pump_speed = 1000.0;                                  // rad/s
  double pump_leakage = 1e-9;                                  // m3/s/Pa
  double motor_displacement = 5e-5 / (2.0 * std::numbers::pi);
  double motor_leakage = 1e-11;
  double inertia = 5.0;  // kg m2
  double proportional_gain = 0.05;
  double integral_gain = 0.02;
  double makeup_pressure = 3e6;
  double makeup_coefficient = 2.5e-5;
  // A make-up valve once open passes oil both ways until the difference is this far reversed (Pa):
  // with next to no flow it would open and close for ever at differences below all tolerances.
  double makeup_hysteresis = 1.0;
  // k_cs = k_cf = 1e-8 m3/s/Pa, nominal flow 0.01 m3/s at a nominal 7 MPa.
  plant::ReliefValve relief{.opening_pressure = 2e7,
                            .tank_pressure = 1e5,
                            .spring_rate = std::sqrt(7e6) / 1e-8,
                            .flow_force_rate = 1.0 / (1e-8 * std::sqrt(7e6)),
                            .largest_opening = 0.01 / std::sqrt(7e6),
                            .time_constant = 0.01};

  Eigen::VectorXd initial_state() const {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(count);
    x(high) = x(low) = 1e7;
    return x;
  }

  Eigen::Index states() const override { return count; }
  void rate(double t, const Eigen::Ref<const Eigen::VectorXd>& x,
            Eigen::Ref<Eigen::VectorXd> dx) const override;
  void jacobian(double t, const Eigen::Ref<const Eigen::VectorXd>& x,
                Eigen::Ref<Eigen::MatrixXd> j) const override;

  /// Of either side: make-up valve opens, spool leaves its seat, spool meets its upper stop.
  Eigen::Index events() const override { return 6; }
  void event_values(double t, const Eigen::Ref<const Eigen::VectorXd>& x,
                    Eigen::Ref<Eigen::VectorXd> g) const override;
  /// Changes the regime as the events tell.
  void change(const Eigen::VectorXi& directions);

  /// Which of the events have been passed rising: the present regime.
  const std::array<bool, 6>& beyond() const { return beyond_; }

 private:
  struct Side {
    numerics::ValueAndDerivative makeup;
    numerics::ValueAndDerivative target;  // of the spool
    numerics::ValueAndDerivative relief_per_opening;
  };
  Side side(Eigen::Index k, double pressure) const;

  std::array<bool, 6> beyond_{};
};

/// Integrates to t through all events; returns how many there were.
int run(HydrostaticTransmission& system, plant::OdeIntegrator& integrator, double t);

inline HydrostaticTransmission::Side HydrostaticTransmission::side(Eigen::Index k,
                                                                   double pressure) const {
  const auto event = 3 * static_cast<std::size_t>(k);
  Side result;
  if (beyond_[event]) {
    result.makeup = plant::orifice(makeup_coefficient, makeup_pressure - pressure, transition);
  }
  if (beyond_[event + 1]) result.target = plant::free_opening(relief, pressure);
  if (beyond_[event + 2]) result.target = {relief.largest_opening, 0.0};
  result.relief_per_opening = plant::orifice(1.0, pressure - relief.tank_pressure, transition);
  return result;
}

inline void HydrostaticTransmission::rate(double, const Eigen::Ref<const Eigen::VectorXd>& x,
                                          Eigen::Ref<Eigen::VectorXd> dx) const {
  const double drop = x(high) - x(low), error = demanded_speed - x(speed);
  const double setting = proportional_gain * error + integral_gain * x(error_integral);
  const double flow = pump_displacement * pump_speed * setting - pump_leakage * drop -
                      motor_displacement * x(speed) - motor_leakage * drop;
  dx(taken_in) = 0.0;
  for (Eigen::Index k = 0; k < 2; ++k) {
    const Side s = side(k, x(high + k));
    const double opening = x(spool_high + k);
    const double inflow = s.makeup.value - opening * s.relief_per_opening.value;
    dx(high + k) = stiffness[static_cast<std::size_t>(k)] * (inflow + (k == 0 ? flow : -flow));
    dx(spool_high + k) = (s.target.value - opening) / relief.time_constant;
    dx(taken_in) += inflow;
  }
  dx(speed) = motor_displacement * drop / inertia;
  dx(error_integral) = error;
}

inline void HydrostaticTransmission::jacobian(double, const Eigen::Ref<const Eigen::VectorXd>& x,
                                              Eigen::Ref<Eigen::MatrixXd> j) const {
  const double leakage = pump_leakage + motor_leakage;
  const double pump = pump_displacement * pump_speed;
  for (Eigen::Index k = 0; k < 2; ++k) {
    const Side s = side(k, x(high + k));
    const double opening = x(spool_high + k), sign = k == 0 ? 1.0 : -1.0;
    const double inflow_by_pressure =
        -s.makeup.derivative - opening * s.relief_per_opening.derivative;
    j(high + k, high) = -sign * leakage;
    j(high + k, low) = sign * leakage;
    j(high + k, speed) = -sign * (pump * proportional_gain + motor_displacement);
    j(high + k, error_integral) = sign * pump * integral_gain;
    j(high + k, high + k) += inflow_by_pressure;
    j(high + k, spool_high + k) = -s.relief_per_opening.value;
    j.row(high + k) *= stiffness[static_cast<std::size_t>(k)];
    j(taken_in, high + k) = inflow_by_pressure;
    j(taken_in, spool_high + k) = -s.relief_per_opening.value;
    j(spool_high + k, high + k) = s.target.derivative / relief.time_constant;
    j(spool_high + k, spool_high + k) = -1.0 / relief.time_constant;
    j(speed, high + k) = sign * motor_displacement / inertia;
  }
  j(error_integral, speed) = -1.0;
}

inline void HydrostaticTransmission::event_values(double,
                                                  const Eigen::Ref<const Eigen::VectorXd>& x,
                                                  Eigen::Ref<Eigen::VectorXd> g) const {
  for (Eigen::Index k = 0; k < 2; ++k) {
    const double pressure = x(high + k), opening = plant::free_opening(relief, pressure).value;
    const bool open = beyond_[3 * static_cast<std::size_t>(k)];
    g.segment<3>(3 * k) << makeup_pressure - pressure + (open ? makeup_hysteresis : 0.0), opening,
        opening - relief.largest_opening;
  }
}

inline void HydrostaticTransmission::change(const Eigen::VectorXi& directions) {
  for (std::size_t k = 0; k < beyond_.size(); ++k) {
    const int direction = directions(static_cast<Eigen::Index>(k));
    if (direction != 0) beyond_[k] = direction > 0;
  }
}

inline int run(HydrostaticTransmission& system, plant::OdeIntegrator& integrator, double t) {
  int events = 0;
  for (;;) {
    const plant::OdeStop stop = integrator.advance(t, plant::Approach::stop_exactly);
    if (!stop.event) return events;
    ++events;
    system.change(stop.directions);
    integrator.restart();
  }
}

}  // namespace boresight::reference
