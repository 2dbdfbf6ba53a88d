#include <algorithm>
#include <cmath>

#include <boresight/plant/nonlinear/antenna_channels.hpp>
#include <boresight/plant/nonlinear/hydraulic_elements.hpp>

namespace boresight::plant {
namespace {

using Eigen::Index;

// Flow through one edge of the valve at an opening (>= 0), in rad/s.
struct EdgeFlow {
  double value = 0.0;
  double by_opening = 0.0;
  double by_drop = 0.0;
};

// One at half the supply less the return across the edge and full opening.
EdgeFlow edge_flow(const OilCircuit& oil, double opening, double drop) {
  const double half = 0.5 * (oil.supply_torque - oil.return_torque);
  const numerics::ValueAndDerivative at_half = orifice(1.0, half, oil.laminar_torque);
  const numerics::ValueAndDerivative root = orifice(1.0 / at_half.value, drop, oil.laminar_torque);
  return {opening * root.value, root.value, opening * root.derivative};
}

}  // namespace

AntennaChannels::AntennaChannels(const ServoValve& valve, const OilCircuit& oil,
                                 const MotorFriction& friction, const OffsetTorque& offset,
                                 const GearContact& gear)
    : valve_(valve), oil_(oil), friction_(friction), offset_(offset), gear_(gear) {
  oil_.lines.clear();  // the core's
  position_.fill(-1);
  const auto activate = [&](Output channel) {
    position_[static_cast<std::size_t>(channel)] = active_++;
  };
  activate(flow_1);
  activate(flow_2);
  activate(friction_and_offset);
  if (friction.bristle_stiffness > 0.0) activate(bristle_rate);
  if (oil.air_fraction > 0.0) {
    activate(softening_1);
    activate(softening_2);
  }
  if (!std::isinf(gear.backlash)) activate(gear_deviation);
  if (!std::isinf(valve.slew_limit)) activate(spool_slew);
}

void AntennaChannels::flows(const Eigen::Ref<const Eigen::VectorXd>& z,
                            Eigen::Ref<Eigen::VectorXd> n,
                            Eigen::Ref<Eigen::MatrixXd> dn_dz) const {
  const numerics::ValueAndDerivative port = port_opening(valve_, z[spool] + valve_.null_offset);
  const double opening = std::abs(port.value);
  const bool upward = port.value >= 0.0;
  const double direction = upward ? 1.0 : -1.0;
  // Side 1 is fed when the port opens upwards and drained otherwise; side 2 the other way round.
  const auto fed = [&](double pressure) {
    EdgeFlow flow =
        edge_flow(oil_, opening, oil_.supply_torque - oil_.supply_droop * opening - pressure);
    flow.by_opening -= oil_.supply_droop * flow.by_drop;
    flow.by_drop = -flow.by_drop;  // by pressure from here on
    return flow;
  };
  const auto drained = [&](double pressure) {
    EdgeFlow flow = edge_flow(oil_, opening, pressure - oil_.return_torque);
    return EdgeFlow{-flow.value, -flow.by_opening, -flow.by_drop};
  };
  const EdgeFlow into_1 = upward ? fed(z[manifold_1]) : drained(z[manifold_1]);
  const EdgeFlow into_2 = upward ? drained(z[manifold_2]) : fed(z[manifold_2]);
  const numerics::ValueAndDerivative makeup_1 = makeup_flow(oil_, z[side_1]);
  const numerics::ValueAndDerivative makeup_2 = makeup_flow(oil_, z[side_2]);
  const double null = oil_.null_leakage * (oil_.supply_torque + oil_.return_torque);
  const double by_spool = direction * port.derivative;

  n[flow_1] = into_1.value - z[spool] + makeup_1.value + null;
  dn_dz(flow_1, spool) = into_1.by_opening * by_spool - 1.0;
  dn_dz(flow_1, manifold_1) = into_1.by_drop;
  dn_dz(flow_1, side_1) = makeup_1.derivative;
  n[flow_2] = into_2.value + z[spool] + makeup_2.value + null;
  dn_dz(flow_2, spool) = into_2.by_opening * by_spool + 1.0;
  dn_dz(flow_2, manifold_2) = into_2.by_drop;
  dn_dz(flow_2, side_2) = makeup_2.derivative;

  if (position(softening_1) < 0) return;
  const double leak = 2.0 * oil_.null_leakage + oil_.case_leakage;
  const double cross = oil_.cross_leakage;
  const auto soften = [&](Index row, Index flow, double sign, Input side, Input other) {
    const numerics::ValueAndDerivative ratio = stiffness_ratio(oil_, z[side]);
    const double less = ratio.value - 1.0;
    const double net =
        sign * (z[spool] - z[motor_rate]) + n[flow] - cross * (z[side] - z[other]) - leak * z[side];
    n[row] = less * net;
    dn_dz.row(row) = less * dn_dz.row(flow);
    dn_dz(row, spool) += less * sign;
    dn_dz(row, motor_rate) -= less * sign;
    dn_dz(row, side) += ratio.derivative * net - less * (cross + leak);
    dn_dz(row, other) += less * cross;
  };
  soften(position(softening_1), flow_1, 1.0, side_1, side_2);
  soften(position(softening_2), flow_2, -1.0, side_2, side_1);
}

void AntennaChannels::friction(const Eigen::Ref<const Eigen::VectorXd>& z,
                               Eigen::Ref<Eigen::VectorXd> n,
                               Eigen::Ref<Eigen::MatrixXd> dn_dz) const {
  const double rate = z[motor_rate];
  const double sign = rate < 0.0 ? -1.0 : 1.0;
  const numerics::ValueAndDerivative dry = dry_friction(friction_.curve, rate);
  const numerics::ValueAndDerivative offset = offset_torque(offset_, z[motor_angle]);
  const double viscous = friction_.curve.viscous_friction;
  const double stiffness = friction_.bristle_stiffness;
  n[friction_and_offset] = viscous * rate + offset.value;
  dn_dz(friction_and_offset, motor_rate) = viscous;
  dn_dz(friction_and_offset, motor_angle) = offset.derivative;
  if (stiffness == 0.0) {
    const double step = std::tanh(rate / friction_.smoothing_rate);
    n[friction_and_offset] += dry.value * step;
    dn_dz(friction_and_offset, motor_rate) +=
        sign * dry.derivative * step + dry.value * (1.0 - step * step) / friction_.smoothing_rate;
    return;
  }
  const double load = stiffness * z[bristle];
  const double fraction = std::abs(rate) / dry.value;
  const double bend = rate - fraction * load;
  const double by_rate = 1.0 - sign * load / dry.value * (1.0 - fraction * dry.derivative);
  const double by_bristle = -fraction * stiffness;
  const Index row = position(bristle_rate);
  n[row] = bend;
  dn_dz(row, motor_rate) = by_rate;
  dn_dz(row, bristle) = by_bristle;
  n[friction_and_offset] += load + friction_.bristle_damping * bend;
  dn_dz(friction_and_offset, motor_rate) += friction_.bristle_damping * by_rate;
  dn_dz(friction_and_offset, bristle) = stiffness + friction_.bristle_damping * by_bristle;
}

void AntennaChannels::evaluate(const Eigen::Ref<const Eigen::VectorXd>& z,
                               Eigen::Ref<Eigen::VectorXd> n,
                               Eigen::Ref<Eigen::MatrixXd> dn_dz) const {
  dn_dz.setZero();
  flows(z, n, dn_dz);
  friction(z, n, dn_dz);
  if (const Index row = position(gear_deviation); row >= 0) {
    const auto torque = gear_torque(gear_, z[windup], z[windup_rate]);
    n[row] = torque.value - gear_.stiffness * z[windup] - gear_.damping * z[windup_rate];
    dn_dz(row, windup) = torque.by_windup - gear_.stiffness;
    dn_dz(row, windup_rate) = torque.by_windup_rate - gear_.damping;
  }
  if (const Index row = position(spool_slew); row >= 0) {
    const double wanted = valve_.corner * z[spool_rate];
    const double beyond = std::abs(wanted) - valve_.slew_limit;
    n[row] = beyond > 0.0 ? -std::copysign(beyond, wanted) : 0.0;
    dn_dz(row, spool_rate) = beyond > 0.0 ? -valve_.corner : 0.0;
  }
}

void AntennaChannels::events(const Eigen::Ref<const Eigen::VectorXd>& z,
                             Eigen::Ref<Eigen::VectorXd> g) const {
  const double travel = z[spool] + valve_.null_offset;
  const double speed = valve_.corner * z[spool_rate];
  const auto limited = [](double value, double limit) {
    return std::isinf(limit) ? 1.0 : value - limit;
  };
  g[0] = z[motor_rate];
  g[1] = limited(travel, valve_.stroke_limit);
  g[2] = limited(-travel, valve_.stroke_limit);
  g[3] = travel - valve_.overlap;
  g[4] = travel + valve_.overlap;
  g[5] = limited(speed, valve_.slew_limit);
  g[6] = limited(-speed, valve_.slew_limit);
  g[7] = z[side_1] - oil_.makeup_torque;
  g[8] = z[side_2] - oil_.makeup_torque;
  const double preload = gear_.preload_torque / (0.5 * gear_.stiffness);
  const bool lash = !std::isinf(gear_.backlash);
  g[9] = lash ? z[windup] - preload : 1.0;
  g[10] = lash ? z[windup] + preload : 1.0;
  g[11] = lash ? z[windup] - preload - gear_.backlash : 1.0;
  g[12] = lash ? z[windup] + preload + gear_.backlash : 1.0;
}

}  // namespace boresight::plant
