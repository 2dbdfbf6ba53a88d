#include <cmath>

#include <fmt/format.h>

#include <boresight/numerics/error.hpp>
#include <boresight/plant/nonlinear/drive_elements.hpp>

namespace boresight::plant {
namespace {

void require(bool satisfied, const char* expected, double found) {
  if (!satisfied || std::isnan(found)) {
    throw InvalidInput(fmt::format("nonlinear antenna: expected {}, found {}", expected, found));
  }
}

void positive(const char* expected, double value) {
  require(value > 0.0 && std::isfinite(value), expected, value);
}

void not_negative(const char* expected, double value) {
  require(value >= 0.0 && std::isfinite(value), expected, value);
}

}  // namespace

void validate(const ServoValve& valve) {
  positive("a positive valve corner", valve.corner);
  not_negative("a valve damping of at least 0", valve.damping);
  not_negative("a valve overlap of at least 0", valve.overlap);
  require(valve.stroke_limit > valve.overlap, "a valve stroke limit above the overlap",
          valve.stroke_limit);
  require(valve.slew_limit > 0.0, "a positive valve slew limit", valve.slew_limit);
  require(std::isfinite(valve.null_offset), "a finite valve null offset", valve.null_offset);
}

void validate(const OilCircuit& oil) {
  positive("a positive stiffness of side 1", oil.stiffness_1);
  positive("a positive stiffness of side 2", oil.stiffness_2);
  not_negative("a cross leakage of at least 0", oil.cross_leakage);
  not_negative("a null leakage of at least 0", oil.null_leakage);
  not_negative("a case leakage of at least 0", oil.case_leakage);
  not_negative("a return torque of at least 0", oil.return_torque);
  require(oil.supply_torque > oil.return_torque && std::isfinite(oil.supply_torque),
          "a supply torque above the return's", oil.supply_torque);
  not_negative("a supply droop of at least 0", oil.supply_droop);
  positive("a positive laminar torque", oil.laminar_torque);
  not_negative("a make-up torque of at least 0", oil.makeup_torque);
  not_negative("a make-up conductance of at least 0", oil.makeup_conductance);
  not_negative("an air fraction of at least 0", oil.air_fraction);
  if (oil.air_fraction > 0.0) {
    positive("a positive bulk modulus as torque", oil.bulk_modulus_torque);
    positive("a positive atmosphere as torque", oil.atmosphere_torque);
    require(oil.polytropic_exponent >= 1.0 && oil.polytropic_exponent <= 2.0,
            "a polytropic exponent of 1 to 2", oil.polytropic_exponent);
  }
  positive("a positive torque per pressure", oil.torque_per_pressure);
  for (const auto& line : oil.lines) {
    positive("a positive line length", line.length);
    positive("a positive half-wave frequency", line.half_wave);
    not_negative("a line damping ratio of at least 0", line.damping_ratio);
  }
  require(oil.modes_per_line >= 0 && oil.modes_per_line <= 20, "0 to 20 modes a line",
          oil.modes_per_line);
}

void validate(const MotorFriction& friction) {
  const auto& curve = friction.curve;
  not_negative("a Coulomb torque of at least 0", curve.coulomb_torque);
  require(curve.breakaway_torque >= curve.coulomb_torque && std::isfinite(curve.breakaway_torque),
          "a breakaway torque of at least the Coulomb torque", curve.breakaway_torque);
  positive("a positive Stribeck rate", curve.stribeck_rate);
  not_negative("a saturating friction of at least 0", curve.saturating_torque);
  positive("a positive saturating rate", curve.saturating_rate);
  not_negative("a viscous friction of at least 0", curve.viscous_friction);
  not_negative("a bristle stiffness of at least 0", friction.bristle_stiffness);
  not_negative("a bristle damping of at least 0", friction.bristle_damping);
  if (friction.bristle_stiffness > 0.0) {
    positive("a positive Coulomb torque for the bristles to hold", curve.coulomb_torque);
  } else {
    positive("a positive smoothing rate of friction without bristles", friction.smoothing_rate);
  }
}

void validate(const OffsetTorque& offset) {
  for (const double value : {offset.constant, offset.cosine, offset.sine, offset.elevation}) {
    require(std::isfinite(value), "a finite offset torque and elevation", value);
  }
  positive("a positive gear ratio", offset.gear_ratio);
}

void validate(const GearContact& gear) {
  positive("a positive gear stiffness", gear.stiffness);
  not_negative("a gear damping of at least 0", gear.damping);
  not_negative("a preload torque of at least 0", gear.preload_torque);
  require(gear.backlash >= 0.0, "a backlash of at least 0", gear.backlash);
  if (!std::isinf(gear.backlash)) {
    positive("a positive preload torque where there is backlash", gear.preload_torque);
  }
}

}  // namespace boresight::plant
