#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include <boresight/numerics/error.hpp>
#include <boresight/plant/antenna/antenna_change.hpp>

namespace boresight::plant {
namespace {

constexpr std::string_view all_frequencies = "structure.frequencies";

struct Place {
  std::string path;
  double* number = nullptr;
};

// A number found at the shaft, and what it is without a test.
struct ShaftPlace {
  std::string_view path;
  std::optional<double> ShaftNumbers::*number;
  double (*of_parts)(const Antenna&);
  // Numbers of parts that count for nothing once this one is set.
  std::array<std::string_view, 5> replaces;
};

constexpr std::array shaft_places{
    ShaftPlace{"at_shaft.antenna_inertia",
               &ShaftNumbers::antenna_inertia,
               [](const Antenna& antenna) { return antenna_inertia(antenna); },
               {"antenna.inertia"}},
    ShaftPlace{"at_shaft.motor_inertia",
               &ShaftNumbers::motor_inertia,
               [](const Antenna& antenna) { return motor_inertia(antenna); },
               {"motor.inertia", "motor.flywheel_disks", "motor.disk_inertia"}},
    ShaftPlace{"at_shaft.gear_train_inertia",
               &ShaftNumbers::gear_train_inertia,
               [](const Antenna& antenna) { return gear_train_inertia(antenna); },
               {"gear_train.assembly"}},
    ShaftPlace{"at_shaft.oil_stiffness",
               &ShaftNumbers::oil_stiffness,
               [](const Antenna& antenna) { return oil_stiffness(antenna); },
               {"oil.bulk_modulus", "oil.volume", "motor.displacement", "motor.torque_efficiency",
                "motor.volumetric_efficiency"}}};

void add_structure(std::vector<Place>& places, AntennaStructure& structure) {
  places.insert(places.end(),
                {{"structure.locked_rotor_frequency", &structure.locked_rotor_frequency},
                 {"structure.gear_damping_ratio", &structure.gear_damping_ratio},
                 {"structure.bull_gear_wind_fraction", &structure.bull_gear_wind_fraction},
                 {"structure.bull_gear_beam_weight", &structure.bull_gear_beam_weight},
                 {"structure.wind_torque_factor", &structure.wind_torque_factor}});
  for (std::size_t i = 0; i < structure.modes.size(); ++i) {
    auto& mode = structure.modes[i];
    const std::string path = fmt::format("structure.mode[{}].", i);
    places.insert(places.end(), {{path + "frequency", &mode.frequency},
                                 {path + "damping_ratio", &mode.damping_ratio},
                                 {path + "inertia_fraction", &mode.inertia_fraction},
                                 {path + "wind_fraction", &mode.wind_fraction},
                                 {path + "beam_weight", &mode.beam_weight}});
  }
}

void add_gear_train(std::vector<Place>& places, GearTrain& train) {
  for (std::size_t i = 0; i < train.stages.size(); ++i) {
    const std::string path = fmt::format("gear_train.stage[{}].", i);
    places.insert(places.end(), {{path + "driven_teeth", &train.stages[i].driven_teeth},
                                 {path + "driving_teeth", &train.stages[i].driving_teeth}});
  }
  for (std::size_t i = 0; i < train.assemblies.size(); ++i) {
    places.push_back(
        {fmt::format("gear_train.assembly[{}].inertia", i), &train.assemblies[i].inertia});
  }
}

void add_nonlinear(std::vector<Place>& places, NonlinearDrive& drive) {
  places.insert(places.end(), {{"simulation.return_pressure", &drive.return_pressure},
                               {"simulation.null_leakage_share", &drive.null_leakage_share},
                               {"simulation.case_leakage_share", &drive.case_leakage_share},
                               {"simulation.valve_stroke", &drive.valve_stroke},
                               {"simulation.valve_stroke_time", &drive.valve_stroke_time},
                               {"simulation.valve_overlap", &drive.valve_overlap},
                               {"simulation.makeup_pressure", &drive.makeup_pressure},
                               {"simulation.air_fraction", &drive.air_fraction},
                               {"simulation.line_damping_ratio", &drive.line_damping_ratio},
                               {"simulation.bristle_stiffness", &drive.bristle_stiffness},
                               {"simulation.bristle_damping", &drive.bristle_damping},
                               {"simulation.offset_torque", &drive.offset_torque},
                               {"simulation.offset_cosine", &drive.offset_cosine},
                               {"simulation.offset_sine", &drive.offset_sine},
                               {"simulation.preload_torque", &drive.preload_torque},
                               {"simulation.backlash", &drive.backlash}});
}

std::vector<Place> places_of(Antenna& antenna) {
  HydraulicDrive& hydraulics = antenna.hydraulics;
  FrictionCurve& curve = antenna.friction_curve;
  std::vector<Place> places{{"antenna.inertia", &antenna.inertia},
                            {"antenna.elevation", &antenna.elevation}};
  add_gear_train(places, antenna.gear_train);
  places.insert(places.end(), {{"motor.inertia", &antenna.flywheels.motor_inertia},
                               {"motor.flywheel_disks", &antenna.flywheels.disks},
                               {"motor.disk_inertia", &antenna.flywheels.disk_inertia},
                               {"motor.displacement", &hydraulics.displacement},
                               {"motor.torque_efficiency", &hydraulics.torque_efficiency},
                               {"motor.volumetric_efficiency", &hydraulics.volumetric_efficiency},
                               {"oil.bulk_modulus", &hydraulics.bulk_modulus},
                               {"oil.volume_1", &hydraulics.volume_1},
                               {"oil.volume_2", &hydraulics.volume_2},
                               {"drive.leakage_rate", &antenna.drive.leakage_rate},
                               {"drive.viscous_friction", &antenna.drive.viscous_friction},
                               {"drive.valve_frequency", &antenna.drive.valve_frequency},
                               {"drive.valve_damping", &antenna.drive.valve_damping},
                               {"drive.supply_pressure", &antenna.drive.supply_pressure},
                               {"drive.tracking_rate", &antenna.drive.tracking_rate},
                               {"drive.slew_rate", &antenna.drive.slew_rate},
                               {"friction_curve.coulomb", &curve.coulomb_torque},
                               {"friction_curve.breakaway", &curve.breakaway_torque},
                               {"friction_curve.stribeck_rate", &curve.stribeck_rate},
                               {"friction_curve.saturating", &curve.saturating_torque},
                               {"friction_curve.saturating_rate", &curve.saturating_rate},
                               {"friction_curve.viscous", &curve.viscous_friction}});
  add_structure(places, antenna.structure);
  places.insert(places.end(),
                {{"sensors.encoder_noise", &antenna.sensors.encoder_noise},
                 {"sensors.tachometer_noise", &antenna.sensors.tachometer_noise},
                 {"sensors.torque_noise", &antenna.sensors.torque_noise},
                 {"sensors.noise_bandwidth", &antenna.sensors.noise_bandwidth},
                 {"sensors.tachometer_frequency", &antenna.sensors.tachometer_frequency},
                 {"controller.delay", &antenna.dead_time}});
  if (antenna.nonlinear) add_nonlinear(places, *antenna.nonlinear);
  return places;
}

double result(const AntennaChange& change, double before) {
  return change.how == AntennaChange::How::scale ? change.number * before : change.number;
}

// Whether it was a number at the shaft.
bool change_at_shaft(Antenna& antenna, const AntennaChange& change) {
  for (const ShaftPlace& place : shaft_places) {
    if (change.path != place.path) continue;
    antenna.at_shaft.*place.number = result(change, place.of_parts(antenna));
    return true;
  }
  return false;
}

void refuse_replaced(const Antenna& antenna, const std::string& path) {
  for (const ShaftPlace& place : shaft_places) {
    if (!(antenna.at_shaft.*place.number)) continue;
    const bool replaced = std::ranges::any_of(place.replaces, [&](std::string_view part) {
      return !part.empty() && path.starts_with(part);
    });
    if (replaced) {
      throw InvalidInput(fmt::format(
          "changed: expected a number that counts, found {}, in whose place the antenna has {}",
          path, place.path));
    }
  }
}

void scale_frequencies(AntennaStructure& structure, const AntennaChange& change) {
  if (change.how != AntennaChange::How::scale) {
    throw InvalidInput(
        fmt::format("changed: expected a factor for {}, found a value", all_frequencies));
  }
  structure.locked_rotor_frequency *= change.number;
  for (auto& mode : structure.modes) mode.frequency *= change.number;
}

}  // namespace

AntennaChange set_to(std::string path, double number) {
  return {std::move(path), AntennaChange::How::set, number};
}

AntennaChange scaled_by(std::string path, double factor) {
  return {std::move(path), AntennaChange::How::scale, factor};
}

Antenna changed(Antenna antenna, const std::vector<AntennaChange>& changes) {
  const std::vector<Place> places = places_of(antenna);
  for (const AntennaChange& change : changes) {
    if (!std::isfinite(change.number)) {
      throw InvalidInput(fmt::format("changed: expected a finite number for {}, found {}",
                                     change.path, change.number));
    }
    if (change_at_shaft(antenna, change)) continue;
    if (change.path == all_frequencies) {
      scale_frequencies(antenna.structure, change);
      continue;
    }
    const auto place = std::ranges::find(places, change.path, &Place::path);
    if (place == places.end()) {
      throw InvalidInput(fmt::format(
          "changed: expected the path of a number, as oil.bulk_modulus, found '{}'", change.path));
    }
    refuse_replaced(antenna, change.path);
    *place->number = result(change, *place->number);
  }
  return antenna;
}

std::vector<std::string> change_paths(const Antenna& antenna) {
  Antenna copy = antenna;
  std::vector<std::string> paths;
  for (Place& place : places_of(copy)) paths.push_back(std::move(place.path));
  paths.emplace_back(all_frequencies);
  for (const ShaftPlace& place : shaft_places) paths.emplace_back(place.path);
  return paths;
}

}  // namespace boresight::plant
