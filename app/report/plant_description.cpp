#include <boresight/app/report/identification_description.hpp>
#include <boresight/io/description/design_results.hpp>

namespace boresight::app {
namespace {

namespace unit = io::key_units;

constexpr io::NumberForm known{.finite = true};
constexpr io::NumberForm positive{.above = 0.0, .finite = true};
constexpr io::NumberForm not_negative{.minimum = 0.0, .finite = true};
constexpr io::KeyUnit inertia_unit{.suffix = "kg_m2"};
constexpr io::KeyUnit stiffness_unit{.suffix = "N_m_per_rad"};
constexpr io::KeyUnit slope_unit{.suffix = "N_m_s_per_rad"};

void describe_curve(io::Visitor& v, const PlantSection& section) {
  const plant::FrictionCurve& curve = section.friction;
  v.number("coulomb", curve.coulomb_torque, unit::newton_metre, "Level once it slides.",
           not_negative);
  v.number("breakaway", curve.breakaway_torque, unit::newton_metre, "At standstill.", not_negative);
  v.number("stribeck_rate", curve.stribeck_rate, unit::radian_per_second,
           "Over which it falls from the one to the other.", positive);
  v.number("saturating", curve.saturating_torque, unit::newton_metre,
           "Part that rises with the rate and levels off.", not_negative);
  v.number("saturating_rate", curve.saturating_rate, unit::radian_per_second, "Over which it does.",
           positive);
  v.number("viscous", curve.viscous_friction, slope_unit, "Slope at high rates.", not_negative);
  v.list("tests", section.friction_tests,
         "At steady rates, through which the curve goes; empty if the case states it.",
         [&](const FrictionTestRow& test) {
           v.number("motor_rate", test.rate, unit::radian_per_second,
                    "0 for what just moves the antenna.", not_negative);
           v.number("torque", test.torque, unit::newton_metre, "All motors.", not_negative);
           v.number("residual", test.residual, unit::newton_metre, "The test less the curve.",
                    known);
         });
}

}  // namespace

void describe(io::Visitor& v, const PlantSection& section) {
  const auto& drive = section.plant.drive;
  v.defined_as("plant", "The linear plant at the motor shaft, all motors lumped.");
  v.flag("identified_from_records", section.records > 0,
         "Whether the plant is the combined estimate of the case's records, not as the case "
         "states it.");
  v.number("gear_ratio", section.gear_ratio, unit::ratio, "Motor turns per turn of the axis.",
           positive);
  v.number("motor_side_inertia", drive.motor_inertia, inertia_unit,
           "Motors, flywheels and gear train.", positive);
  v.number("antenna_inertia", plant::antenna_inertia(section.plant.structure), inertia_unit,
           "The antenna at the motor shaft.", positive);
  v.number("reflected_inertia", section.reflected_inertia, inertia_unit, "Their sum.", positive);
  v.number("motor_to_load_ratio", section.motor_to_load_ratio, unit::ratio,
           "Motors against gear train and antenna.");
  v.number("oil_stiffness", drive.oil_stiffness, stiffness_unit, "Oil spring.", positive);
  v.number("leakage_rate", drive.leakage_rate, unit::per_second,
           "Oil stiffness over leakage damper.", not_negative);
  v.number("viscous_friction", drive.viscous_friction, slope_unit, "Of the linear plant.",
           not_negative);
  v.number("tracking_friction_slope", section.tracking_slope, slope_unit,
           "Slope of the friction curve at the tracking rate.", known);
  v.group("friction_curve", "Torque of all motors against their rate.",
          [&] { describe_curve(v, section); });
  v.number("gear_stiffness", section.plant.structure.gear_stiffness, stiffness_unit,
           "Gearbox spring.", positive);
  v.number("valve_frequency", drive.valve_corner, unit::hertz_of_radians,
           "Natural frequency of the valve.", positive);
  v.number("supply_torque", section.supply_torque, unit::newton_metre,
           "All motors at supply pressure.", positive);
  v.number("available_wind_torque", section.available_wind_torque, unit::newton_metre,
           "What friction at the tracking rate and offset torque leave of it; 0: nothing.",
           not_negative);
  v.number("mean_wind_torque", section.mean_wind_torque, unit::newton_metre,
           "At the design wind speed.", not_negative);
  v.number("slew_rate_margin", section.slew_rate_margin, unit::ratio,
           "Highest rate that valve and supply hold against friction and offset over the slew "
           "rate; null where the case says nothing of its valve's stroke.",
           {.minimum = 0.0});
  v.number("rigid_hydraulic_frequency", section.rigid_frequency, unit::hertz,
           "All masses rigid on the oil spring.", positive);
  v.object("hydraulic_mode", section.hydraulic, "The mode on the oil spring.");
  v.list("modes", section.modes, "In order of frequency.", io::ListSize{.minimum = 1});
}

}  // namespace boresight::app
