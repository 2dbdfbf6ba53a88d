#include <cmath>
#include <utility>

#include <fmt/format.h>

#include <boresight/numerics/error.hpp>
#include <boresight/plant/nonlinear/antenna_parameters.hpp>

namespace boresight::plant {
namespace {

using Parameter = AntennaParameter;

// Where the parameter stands, if it stands in one place.
double* place(NonlinearAntenna& antenna, Parameter which) {
  auto& curve = antenna.friction.curve;
  switch (which) {
    case Parameter::motor_inertia:
      return &antenna.motor_inertia;
    case Parameter::supply_torque:
      return &antenna.oil.supply_torque;
    case Parameter::coulomb_torque:
      return &curve.coulomb_torque;
    case Parameter::breakaway_torque:
      return &curve.breakaway_torque;
    case Parameter::stribeck_rate:
      return &curve.stribeck_rate;
    case Parameter::saturating_torque:
      return &curve.saturating_torque;
    case Parameter::saturating_rate:
      return &curve.saturating_rate;
    case Parameter::viscous_friction:
      return &curve.viscous_friction;
    case Parameter::bristle_stiffness:
      return &antenna.friction.bristle_stiffness;
    case Parameter::bristle_damping:
      return &antenna.friction.bristle_damping;
    case Parameter::offset_torque:
      return &antenna.offset.constant;
    case Parameter::gear_stiffness:
      return &antenna.gear.stiffness;
    case Parameter::valve_corner:
      return &antenna.valve.corner;
    case Parameter::antenna_inertia:
    case Parameter::bulk_modulus:
    case Parameter::leakage:
      break;
  }
  return nullptr;
}

// Inertias times `factor`, springs and dampers kept.
void scale_inertia(StructureModel& structure, double factor) {
  if (auto* lumped = std::get_if<Structure>(&structure)) {
    lumped->bull_gear_inertia *= factor;
    for (auto& mode : lumped->modes) mode.inertia *= factor;
    return;
  }
  // Mass-normalised shapes fall with the root of the mass, and so do frequencies; of a damper kept,
  // 2 zeta w is per mass.
  auto& modes = std::get<VibrationModes>(structure);
  const double root = std::sqrt(factor);
  modes.frequency /= root;
  modes.damping_ratio /= root;
  modes.force_shape /= root;
  modes.displacement_shape /= root;
}

bool may_be_zero_or_less(Parameter which) {
  return which == Parameter::offset_torque;
}

bool may_be_zero(Parameter which) {
  return which == Parameter::leakage || which == Parameter::coulomb_torque ||
         which == Parameter::breakaway_torque || which == Parameter::saturating_torque ||
         which == Parameter::viscous_friction || which == Parameter::bristle_stiffness ||
         which == Parameter::bristle_damping;
}

}  // namespace

std::string_view to_string(Parameter parameter) {
  switch (parameter) {
    case Parameter::motor_inertia:
      return "motor_inertia";
    case Parameter::antenna_inertia:
      return "antenna_inertia";
    case Parameter::bulk_modulus:
      return "bulk_modulus";
    case Parameter::leakage:
      return "leakage";
    case Parameter::supply_torque:
      return "supply_torque";
    case Parameter::coulomb_torque:
      return "coulomb_torque";
    case Parameter::breakaway_torque:
      return "breakaway_torque";
    case Parameter::stribeck_rate:
      return "stribeck_rate";
    case Parameter::saturating_torque:
      return "saturating_torque";
    case Parameter::saturating_rate:
      return "saturating_rate";
    case Parameter::viscous_friction:
      return "viscous_friction";
    case Parameter::bristle_stiffness:
      return "bristle_stiffness";
    case Parameter::bristle_damping:
      return "bristle_damping";
    case Parameter::offset_torque:
      return "offset_torque";
    case Parameter::gear_stiffness:
      return "gear_stiffness";
    case Parameter::valve_corner:
      return "valve_corner";
  }
  return "unknown";
}

const std::vector<Parameter>& antenna_parameters() {
  static const std::vector<Parameter> all = [] {
    std::vector<Parameter> list;
    for (int i = 0; i <= static_cast<int>(Parameter::valve_corner); ++i) {
      list.push_back(static_cast<Parameter>(i));
    }
    return list;
  }();
  return all;
}

double parameter(const NonlinearAntenna& antenna, Parameter which) {
  if (which == Parameter::antenna_inertia) return antenna_inertia(antenna.structure);
  NonlinearAntenna copy = antenna;
  const double* value = place(copy, which);
  return value != nullptr ? *value : 1.0;
}

NonlinearAntenna with_parameter(NonlinearAntenna antenna, Parameter which, double value) {
  if (!std::isfinite(value) || (value < 0.0 && !may_be_zero_or_less(which)) ||
      (value == 0.0 && !may_be_zero_or_less(which) && !may_be_zero(which))) {
    throw InvalidInput(fmt::format("with_parameter: expected a {} {}, found {}", to_string(which),
                                   may_be_zero(which) ? "of at least 0" : "above 0", value));
  }
  if (double* stored = place(antenna, which)) {
    *stored = value;
    return antenna;
  }
  if (which == Parameter::antenna_inertia) {
    scale_inertia(antenna.structure, value / antenna_inertia(antenna.structure));
  } else if (which == Parameter::bulk_modulus) {
    antenna.oil.stiffness_1 *= value;
    antenna.oil.stiffness_2 *= value;
    antenna.oil.bulk_modulus_torque *= value;
    for (auto& line : antenna.oil.lines) line.half_wave *= std::sqrt(value);
  } else {
    antenna.oil.cross_leakage *= value;
    antenna.oil.null_leakage *= value;
    antenna.oil.case_leakage *= value;
  }
  return antenna;
}

}  // namespace boresight::plant
