#include <algorithm>
#include <cmath>

#include <boresight/plant/nonlinear/drive_elements.hpp>

namespace boresight::plant {

numerics::ValueAndDerivative port_opening(const ServoValve& valve, double spool) {
  const double travel = std::abs(spool);
  if (travel < valve.overlap) return {0.0, 0.0};
  if (travel >= valve.stroke_limit) {
    return {std::copysign(valve.stroke_limit - valve.overlap, spool), 0.0};
  }
  return {std::copysign(travel - valve.overlap, spool), 1.0};
}

numerics::ValueAndDerivative stiffness_ratio(const OilCircuit& oil, double torque) {
  if (oil.air_fraction == 0.0) return {1.0, 0.0};
  const double minimum = 1e-3 * oil.atmosphere_torque;
  const bool held = torque < minimum;
  const double p = held ? minimum : torque;
  const double n = oil.polytropic_exponent;
  const double air = oil.air_fraction * oil.bulk_modulus_torque / (n * p) *
                     std::pow(oil.atmosphere_torque / p, 1.0 / n);
  const double ratio = 1.0 / (1.0 + air);
  return {ratio, held ? 0.0 : ratio * ratio * air * (1.0 + 1.0 / n) / p};
}

numerics::ValueAndDerivative makeup_flow(const OilCircuit& oil, double torque) {
  if (torque >= oil.makeup_torque) return {0.0, 0.0};
  return {oil.makeup_conductance * (oil.makeup_torque - torque), -oil.makeup_conductance};
}

numerics::ValueAndDerivative offset_torque(const OffsetTorque& offset, double motor_angle) {
  const double elevation = offset.elevation + motor_angle / offset.gear_ratio;
  const double c = std::cos(elevation);
  const double s = std::sin(elevation);
  return {offset.constant + offset.cosine * c + offset.sine * s,
          (offset.sine * c - offset.cosine * s) / offset.gear_ratio};
}

namespace {

// How far a half's flank is compressed: its own (positive), or the opposite one behind the backlash
// (negative).
double active(const GearContact& gear, double side, double windup) {
  const double compression = side * windup + gear.preload_torque / (0.5 * gear.stiffness);
  return compression < 0.0 ? std::min(0.0, compression + gear.backlash) : compression;
}

}  // namespace

GearTorque gear_torque(const GearContact& gear, double windup, double windup_rate) {
  if (std::isinf(gear.backlash)) {
    return {gear.stiffness * windup + gear.damping * windup_rate, gear.stiffness, gear.damping};
  }
  const double stiffness = 0.5 * gear.stiffness;
  // The damper comes in over the first tenth of the preload, so that a closing flank does not jolt.
  const double brought_in = 0.1 * gear.preload_torque / stiffness;
  GearTorque torque;
  for (const double side : {1.0, -1.0}) {
    const double compression = active(gear, side, windup);
    if (compression == 0.0) continue;
    const double hold = std::abs(compression) / brought_in;
    const double damping = 0.5 * gear.damping * std::min(1.0, hold);
    torque.value += side * stiffness * compression + damping * windup_rate;
    torque.by_windup += stiffness;
    if (hold < 1.0) {
      torque.by_windup +=
          side * std::copysign(0.5 * gear.damping / brought_in, compression) * windup_rate;
    }
    torque.by_windup_rate += damping;
  }
  return torque;
}

double gear_energy(const GearContact& gear, double windup) {
  if (std::isinf(gear.backlash)) return 0.5 * gear.stiffness * windup * windup;
  double energy = 0.0;
  for (const double side : {1.0, -1.0}) {
    energy += 0.25 * gear.stiffness * std::pow(active(gear, side, windup), 2);
  }
  return energy;
}

}  // namespace boresight::plant
