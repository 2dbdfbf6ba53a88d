#include <cmath>
#include <initializer_list>

#include <fmt/format.h>

#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/antenna/antenna.hpp>

namespace boresight::plant {
namespace {

struct Named {
  const char* name;
  double value;
};

void require(bool satisfied, const char* expected, const Named& number) {
  if (!satisfied || !std::isfinite(number.value)) {
    throw InvalidInput(
        fmt::format("antenna: expected {} of {}, found {}", expected, number.name, number.value));
  }
}

void positive(std::initializer_list<Named> numbers) {
  for (const Named& number : numbers) require(number.value > 0.0, "a positive value", number);
}

void not_negative(std::initializer_list<Named> numbers) {
  for (const Named& number : numbers) require(number.value >= 0.0, "a value of at least 0", number);
}

}  // namespace

double gear_ratio(const Antenna& antenna) {
  return gear_ratio(antenna.gear_train.stages);
}

double sky_to_motor(const Antenna& antenna, double at_sky) {
  return at_sky * gear_ratio(antenna);
}

double motor_to_sky(const Antenna& antenna, double of_motor) {
  return of_motor / gear_ratio(antenna);
}

double antenna_inertia(const Antenna& antenna) {
  if (antenna.at_shaft.antenna_inertia) return *antenna.at_shaft.antenna_inertia;
  return reflected_inertia(antenna.inertia, gear_ratio(antenna));
}

double gear_train_inertia(const Antenna& antenna) {
  if (antenna.at_shaft.gear_train_inertia) return *antenna.at_shaft.gear_train_inertia;
  const GearTrain& train = antenna.gear_train;
  double sum = 0.0;
  for (const GearAssembly& assembly : train.assemblies) {
    sum += reflected_inertia(assembly.inertia, gear_ratio(train.stages, assembly.stages),
                             assembly.count);
  }
  return sum;
}

double motor_inertia(const Antenna& antenna) {
  if (antenna.at_shaft.motor_inertia) return *antenna.at_shaft.motor_inertia;
  const Flywheels& flywheels = antenna.flywheels;
  return antenna.hydraulics.motor_count *
         (flywheels.motor_inertia +
          (flywheels.disks - flywheels.counted_disks) * flywheels.disk_inertia);
}

double oil_stiffness(const Antenna& antenna) {
  return antenna.at_shaft.oil_stiffness ? *antenna.at_shaft.oil_stiffness
                                        : oil_stiffness(antenna.hydraulics);
}

StructureSpecification structure_specification(const Antenna& antenna) {
  const AntennaStructure& structure = antenna.structure;
  return {antenna_inertia(antenna),         structure.bull_gear_wind_fraction,
          structure.bull_gear_beam_weight,  structure.modes,
          structure.locked_rotor_frequency, structure.gear_damping_ratio};
}

AntennaPlant linear_plant(const Antenna& antenna) {
  AntennaPlant plant;
  plant.drive.oil_stiffness = oil_stiffness(antenna);
  plant.drive.leakage_rate = antenna.drive.leakage_rate;
  plant.drive.viscous_friction = antenna.drive.viscous_friction;
  plant.drive.motor_inertia = motor_inertia(antenna) + gear_train_inertia(antenna);
  plant.drive.valve_corner = two_pi * antenna.drive.valve_frequency;
  plant.drive.valve_damping = antenna.drive.valve_damping;
  plant.drive.tachometer_corner = two_pi * antenna.sensors.tachometer_frequency;
  plant.structure = make_structure(structure_specification(antenna));
  plant.structure.bull_gear_wind_fraction *= antenna.structure.wind_torque_factor;
  plant.structure.bull_gear_beam_weight *= antenna.boresight_factor;
  for (auto& mode : plant.structure.modes) {
    mode.wind_fraction *= antenna.structure.wind_torque_factor;
    mode.beam_weight *= antenna.boresight_factor;
  }
  return plant;
}

void validate(const Antenna& antenna) {
  const Flywheels& flywheels = antenna.flywheels;
  const DriveRatings& drive = antenna.drive;
  const Sensors& sensors = antenna.sensors;
  positive({{"inertia", antenna.inertia},
            {"inertia of a motor", flywheels.motor_inertia},
            {"boresight factor", antenna.boresight_factor},
            {"valve frequency", drive.valve_frequency},
            {"supply pressure", drive.supply_pressure},
            {"tracking rate", drive.tracking_rate},
            {"slew rate", drive.slew_rate},
            {"noise bandwidth", sensors.noise_bandwidth},
            {"tachometer frequency", sensors.tachometer_frequency}});
  not_negative({{"dead time", antenna.dead_time},
                {"counted disks", flywheels.counted_disks},
                {"disk inertia", flywheels.disk_inertia},
                {"disks", flywheels.disks},
                {"leakage rate", drive.leakage_rate},
                {"viscous friction", drive.viscous_friction},
                {"valve damping", drive.valve_damping},
                {"gear damping ratio", antenna.structure.gear_damping_ratio},
                {"wind torque factor", antenna.structure.wind_torque_factor},
                {"encoder noise", sensors.encoder_noise},
                {"tachometer noise", sensors.tachometer_noise},
                {"torque noise", sensors.torque_noise}});
  for (const GearAssembly& assembly : antenna.gear_train.assemblies) {
    positive({{"count of an assembly", assembly.count}});
    not_negative({{"inertia of an assembly", assembly.inertia}});
  }
  to_state_space(linear_plant(antenna));
}

}  // namespace boresight::plant
