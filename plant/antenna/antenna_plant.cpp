#include <cmath>

#include <fmt/format.h>

#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/antenna/antenna_plant.hpp>

namespace boresight::plant {
namespace {

void require(bool satisfied, const char* function, const char* what, double found) {
  if (!satisfied || !std::isfinite(found)) {
    throw InvalidInput(fmt::format("{}: expected {}, found {}", function, what, found));
  }
}

void check(const AntennaPlant& plant) {
  const auto positive = [](const char* what, double value) {
    require(value > 0.0, "to_state_space", what, value);
  };
  const auto not_negative = [](const char* what, double value) {
    require(value >= 0.0, "to_state_space", what, value);
  };
  positive("a positive oil stiffness", plant.drive.oil_stiffness);
  not_negative("a leakage rate of at least 0", plant.drive.leakage_rate);
  not_negative("a viscous friction of at least 0", plant.drive.viscous_friction);
  positive("a positive motor inertia", plant.drive.motor_inertia);
  positive("a positive valve corner", plant.drive.valve_corner);
  not_negative("a valve damping of at least 0", plant.drive.valve_damping);
  positive("a positive tachometer corner", plant.drive.tachometer_corner);
  positive("a positive bull gear inertia", plant.structure.bull_gear_inertia);
  positive("a positive gear stiffness", plant.structure.gear_stiffness);
  not_negative("a gear damping of at least 0", plant.structure.gear_damping);
  for (const auto& mode : plant.structure.modes) {
    positive("a positive modal inertia", mode.inertia);
    positive("a positive modal stiffness", mode.stiffness);
    not_negative("a modal damping of at least 0", mode.damping);
  }
}

}  // namespace

Structure make_structure(const StructureSpecification& specification) {
  constexpr const char* function = "make_structure";
  const double antenna = specification.antenna_inertia;
  require(antenna > 0.0, function, "a positive antenna inertia", antenna);
  require(specification.locked_rotor_frequency > 0.0, function, "a positive locked-rotor frequency",
          specification.locked_rotor_frequency);
  double fraction = 0.0;
  double wind = specification.bull_gear_wind_fraction;
  double boresight = specification.bull_gear_beam_weight;
  const double w = two_pi * specification.locked_rotor_frequency;
  Structure structure;
  structure.bull_gear_wind_fraction = wind;
  structure.bull_gear_beam_weight = boresight;
  double apparent_inertia = 0.0;
  for (const auto& mode : specification.modes) {
    require(mode.frequency > specification.locked_rotor_frequency, function,
            "every mode above the locked-rotor frequency", mode.frequency);
    require(mode.inertia_fraction > 0.0, function, "positive inertia fractions",
            mode.inertia_fraction);
    require(mode.damping_ratio >= 0.0, function, "modal damping of at least 0", mode.damping_ratio);
    const double wi = two_pi * mode.frequency;
    const double inertia = mode.inertia_fraction * antenna;
    structure.modes.push_back({inertia, inertia * wi * wi, 2.0 * mode.damping_ratio * inertia * wi,
                               mode.wind_fraction, mode.beam_weight});
    apparent_inertia += inertia / (1.0 - (w / wi) * (w / wi));
    fraction += mode.inertia_fraction;
    wind += mode.wind_fraction;
    boresight += mode.beam_weight;
  }
  require(fraction < 1.0, function, "inertia fractions that sum to less than 1", fraction);
  require(std::abs(wind - 1.0) < 1e-6, function, "wind fractions that sum to 1", wind);
  require(std::abs(boresight - 1.0) < 1e-6, function, "beam weights that sum to 1", boresight);
  structure.bull_gear_inertia = (1.0 - fraction) * antenna;
  structure.gear_stiffness = w * w * (structure.bull_gear_inertia + apparent_inertia);
  structure.gear_damping = 2.0 * specification.gear_damping_ratio * structure.gear_stiffness / w;
  return structure;
}

double antenna_inertia(const Structure& structure) {
  double inertia = structure.bull_gear_inertia;
  for (const auto& mode : structure.modes) inertia += mode.inertia;
  return inertia;
}

double boresight_factor(const Structure& structure) {
  double sum = structure.bull_gear_beam_weight;
  for (const auto& mode : structure.modes) sum += mode.beam_weight;
  return sum;
}

double reflected_inertia(const AntennaPlant& plant) {
  return plant.drive.motor_inertia + antenna_inertia(plant.structure);
}

StateSpace to_state_space(const AntennaPlant& plant) {
  check(plant);
  const Drive& drive = plant.drive;
  const Structure& structure = plant.structure;
  const auto modes = static_cast<Eigen::Index>(structure.modes.size());
  const Eigen::Index n = 8 + 2 * modes;
  // The valve's second state is its rate over its corner: both states then have one magnitude.
  enum : Eigen::Index {
    valve,
    valve_rate,
    torque,
    motor_rate,
    motor,
    bull,
    bull_rate,
    tach,
    first
  };

  StateSpace system{Eigen::MatrixXd::Zero(n, n),
                    Eigen::MatrixXd::Zero(n, 2),
                    Eigen::MatrixXd::Zero(4, n),
                    Eigen::MatrixXd::Zero(4, 2),
                    {"valve_command", "wind_torque"},
                    {"tachometer", "motor_torque", "encoder", "beam"},
                    {"valve_flow", "valve_flow_rate", "motor_torque", "motor_rate", "motor_angle",
                     "bull_gear_angle", "bull_gear_rate", "tachometer"}};
  auto& a = system.a;
  const double wv = drive.valve_corner;
  a(valve, valve_rate) = wv;
  a(valve_rate, valve) = -wv;
  a(valve_rate, valve_rate) = -2.0 * drive.valve_damping * wv;
  system.b(valve_rate, 0) = wv;

  a(torque, valve) = drive.oil_stiffness;
  a(torque, motor_rate) = -drive.oil_stiffness;
  a(torque, torque) = -drive.leakage_rate;

  const double jm = drive.motor_inertia;
  const double kg = structure.gear_stiffness;
  const double cg = structure.gear_damping;
  a(motor, motor_rate) = 1.0;
  a(motor_rate, torque) = 1.0 / jm;
  a(motor_rate, motor_rate) = -(drive.viscous_friction + cg) / jm;
  a(motor_rate, bull_rate) = cg / jm;
  a(motor_rate, motor) = -kg / jm;
  a(motor_rate, bull) = kg / jm;

  const double jb = structure.bull_gear_inertia;
  a(bull, bull_rate) = 1.0;
  a(bull_rate, motor) = kg / jb;
  a(bull_rate, motor_rate) = cg / jb;
  a(bull_rate, bull) = -kg / jb;
  a(bull_rate, bull_rate) = -cg / jb;
  system.b(bull_rate, 1) = structure.bull_gear_wind_fraction / jb;

  a(tach, motor_rate) = drive.tachometer_corner;
  a(tach, tach) = -drive.tachometer_corner;

  system.c(0, tach) = 1.0;
  system.c(1, torque) = 1.0;
  system.c(2, bull) = 1.0;
  system.c(3, bull) = structure.bull_gear_beam_weight;

  for (Eigen::Index i = 0; i < modes; ++i) {
    const auto& mode = structure.modes[static_cast<std::size_t>(i)];
    const Eigen::Index angle = first + 2 * i;
    const Eigen::Index rate = angle + 1;
    a(bull_rate, bull) -= mode.stiffness / jb;
    a(bull_rate, angle) += mode.stiffness / jb;
    a(bull_rate, bull_rate) -= mode.damping / jb;
    a(bull_rate, rate) += mode.damping / jb;
    a(angle, rate) = 1.0;
    a(rate, bull) = mode.stiffness / mode.inertia;
    a(rate, angle) = -mode.stiffness / mode.inertia;
    a(rate, bull_rate) = mode.damping / mode.inertia;
    a(rate, rate) = -mode.damping / mode.inertia;
    system.b(rate, 1) = mode.wind_fraction / mode.inertia;
    system.c(3, angle) = mode.beam_weight;
    system.states.push_back(fmt::format("mode_{}_angle", i + 1));
    system.states.push_back(fmt::format("mode_{}_rate", i + 1));
  }
  return system;
}

}  // namespace boresight::plant
