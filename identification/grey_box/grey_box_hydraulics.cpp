#include <cmath>

#include <fmt/format.h>

#include <boresight/identification/grey_box/grey_box_hydraulics.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/value_and_derivative.hpp>

namespace boresight::identification {
namespace {

using C = HydraulicCoefficients;
using Eigen::Index;
using By = Eigen::Matrix<double, 2, C::count>;

// y/(y^2 + e^2)^(1/4): sqrt|y| with the sign of y, smooth through 0, where flow turns laminar.
numerics::ValueAndDerivative signed_root(double y) {
  constexpr double laminar = 0.02;  // of half the pressure between supply and return
  const double square = y * y + laminar * laminar;
  const double root = std::pow(square, -0.25);
  return {y * root, root * (1.0 - 0.5 * y * y / square)};
}

}  // namespace

PortOpening port_opening(const Eigen::VectorXd& c, const HydraulicUnits& units, double spool) {
  const double gain = c(C::valve_gain);
  const double fraction = std::abs(spool) / units.largest_command;
  const double bent = 1.0 + c(C::valve_curvature) * fraction;
  const double position = gain * spool * bent + c(C::valve_null);
  const double lap = c(C::valve_lap);
  // Rounded, as the lands' edges are.
  const double edge = 0.002 * units.largest_command;
  const double beyond = std::hypot(position + lap, edge);
  const double before = std::hypot(position - lap, edge);
  const double slope = 1.0 - 0.5 * ((position + lap) / beyond - (position - lap) / before);
  return {position - 0.5 * (beyond - before),
          slope * gain * (1.0 + 2.0 * c(C::valve_curvature) * fraction),
          slope * spool * bent,
          slope * gain * spool * fraction,
          slope,
          -0.5 * ((position + lap) / beyond + (position - lap) / before)};
}

PressureRates pressure_rates(const Eigen::VectorXd& c, const HydraulicUnits& units,
                             const Eigen::Vector2d& p, double opening, double rate) {
  const double size = std::abs(opening) / units.largest_command;
  const double supply = c(C::supply_torque) * (1.0 - c(C::supply_droop) * size);
  const double half = 0.5 * (units.supply_torque - units.return_torque);
  // Which side the supply feeds.
  const int fed = opening >= 0.0 ? 0 : 1;
  // The lines take pressure on the way to the motors and back.
  const double lost = (fed == 0 ? rate : -rate);
  const double resistance = c(C::line_resistance);
  const auto feed = signed_root((supply - p(fed) - resistance * lost) / half);
  const auto drain = signed_root((p(1 - fed) - resistance * lost - units.return_torque) / half);
  Eigen::Vector2d flow, flow_by_pressure, flow_by_opening, flow_by_supply;
  flow(fed) = opening * feed.value;
  flow(1 - fed) = opening * drain.value;
  flow_by_pressure(fed) = -opening * feed.derivative / half;
  flow_by_pressure(1 - fed) = opening * drain.derivative / half;
  flow_by_supply(fed) = opening * feed.derivative / half;
  flow_by_supply(1 - fed) = 0.0;
  flow_by_opening(fed) = feed.value - std::abs(opening) * feed.derivative / half *
                                          c(C::supply_torque) * c(C::supply_droop) /
                                          units.largest_command;
  flow_by_opening(1 - fed) = drain.value;

  const double null_leakage = c(C::null_leakage);
  const double both = supply + units.return_torque;
  const double across = p(0) - p(1);
  PressureRates out;
  out.by_coefficient.setZero();
  for (int side = 0; side < 2; ++side) {
    const double sign = side == 0 ? 1.0 : -1.0;
    const double stiffness = c(C::stiffness_1 + side);
    const double null = both - 2.0 * p(side);
    const double balance = sign * (flow(side) - rate - c(C::cross_leakage) * across) +
                           null_leakage * null - c(C::case_leakage) * p(side);
    out.value(side) = stiffness * balance;
    out.by_pressure(side, side) = stiffness * (sign * flow_by_pressure(side) - c(C::cross_leakage) -
                                               2.0 * null_leakage - c(C::case_leakage));
    out.by_pressure(side, 1 - side) = stiffness * c(C::cross_leakage);
    const double by_supply = stiffness * (sign * flow_by_supply(side) + null_leakage);
    const double null_by_opening = -null_leakage * c(C::supply_torque) * c(C::supply_droop) /
                                   units.largest_command * (opening >= 0.0 ? 1.0 : -1.0);
    out.by_opening(side) = stiffness * (sign * flow_by_opening(side) + null_by_opening);
    // What the orifice sees of the lines' loss is what it would see of its own side's pressure.
    const double by_loss = stiffness * sign * flow_by_pressure(side) * (side == fed ? 1.0 : -1.0);
    out.by_rate(side) = -stiffness * sign + by_loss * resistance * (fed == 0 ? 1.0 : -1.0);
    out.by_coefficient(side, C::line_resistance) = by_loss * lost;
    out.by_coefficient(side, C::stiffness_1 + side) = balance;
    out.by_coefficient(side, C::cross_leakage) = -stiffness * sign * across;
    out.by_coefficient(side, C::null_leakage) = stiffness * null;
    out.by_coefficient(side, C::case_leakage) = -stiffness * p(side);
    out.by_coefficient(side, C::supply_torque) = by_supply * (1.0 - c(C::supply_droop) * size);
    out.by_coefficient(side, C::supply_droop) = -by_supply * c(C::supply_torque) * size;
  }
  return out;
}

void predict_pressures(const GreyBoxRecord& record, const HydraulicUnits& units,
                       const Eigen::VectorXd& c, Eigen::VectorXd& residuals,
                       Eigen::MatrixXd* jacobian) {
  const Index samples = record.samples();
  if (record.valve.size() != samples || c.size() != C::count) {
    throw InvalidInput(
        fmt::format("predict_pressures: expected a valve command at the {} samples of '{}' and {} "
                    "coefficients, found {} and {}",
                    samples, record.name, Index{C::count}, record.valve.size(), c.size()));
  }
  residuals.resize(2 * samples);
  if (jacobian != nullptr) jacobian->resize(C::count, 2 * samples);
  const double h = record.sample_time;
  // The valve's lag: exact for a command that is straight between samples.
  const double q = h / c(C::valve_lag);
  const double decay = std::exp(-q);
  const double mean = -std::expm1(-q) / q;
  const double decay_by = decay * q / c(C::valve_lag);
  const double mean_by = (mean - decay) / c(C::valve_lag);
  const double correction = c(C::correction);

  Eigen::Vector2d p = Eigen::Vector2d::Zero();
  By p_by = By::Zero();
  double spool = record.valve(0), spool_by_lag = 0.0;
  const auto motor_rate = [&](Index k) {
    return record.motion(k) - c(C::tachometer_zero) + c(C::tachometer_lag) * record.motion_slope(k);
  };
  // Total derivatives of the pressures' rates: through the pressures, the valve and the rate, and
  // directly.
  const auto total = [&](const PressureRates& f, const By& pressure_by, const PortOpening& o,
                         double spool_by, Index k) {
    By by = f.by_pressure * pressure_by + f.by_coefficient;
    by.col(C::valve_gain) += f.by_opening * o.by_gain;
    by.col(C::valve_curvature) += f.by_opening * o.by_curvature;
    by.col(C::valve_null) += f.by_opening * o.by_null;
    by.col(C::valve_lap) += f.by_opening * o.by_lap;
    by.col(C::valve_lag) += f.by_opening * (o.by_spool * spool_by);
    by.col(C::tachometer_zero) -= f.by_rate;
    by.col(C::tachometer_lag) += f.by_rate * record.motion_slope(k);
    return by;
  };
  for (Index k = 0; k < samples; ++k) {
    const Eigen::Vector2d measured{record.side_1(k), record.side_2(k)};
    if (record.pressure_restarts[static_cast<std::size_t>(k)]) {
      p = measured;
      p_by.setZero();
    }
    const Eigen::Vector2d error = measured - p;
    residuals.segment<2>(2 * k) = error;
    if (jacobian != nullptr) jacobian->middleCols<2>(2 * k) = -p_by.transpose();
    if (k + 1 == samples) break;

    const double next_spool =
        decay * spool + (mean - decay) * record.valve(k) + (1.0 - mean) * record.valve(k + 1);
    const double next_by = decay * spool_by_lag + decay_by * spool +
                           (mean_by - decay_by) * record.valve(k) - mean_by * record.valve(k + 1);
    const PortOpening now = port_opening(c, units, spool);
    const PortOpening next = port_opening(c, units, next_spool);
    const auto f = pressure_rates(c, units, p, now.value, motor_rate(k));
    const Eigen::Vector2d slope = f.value + correction * error;
    const Eigen::Vector2d ahead = p + h * slope;
    const auto g = pressure_rates(c, units, ahead, next.value, motor_rate(k + 1));
    if (jacobian != nullptr) {
      By slope_by = total(f, p_by, now, spool_by_lag, k) - correction * p_by;
      slope_by.col(C::correction) += error;
      const By ahead_by = p_by + h * slope_by;
      By later_by = total(g, ahead_by, next, next_by, k + 1) - correction * p_by;
      later_by.col(C::correction) += error;
      p_by += 0.5 * h * (slope_by + later_by);
    }
    p += 0.5 * h * (slope + g.value + correction * error);
    spool = next_spool;
    spool_by_lag = next_by;
  }
}

}  // namespace boresight::identification
