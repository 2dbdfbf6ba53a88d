#include <optional>

#include <fmt/format.h>
#include <pybind11/complex.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <boresight/app/redesign/sections.hpp>
#include <boresight/io/case/antenna_of.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_motor.hpp>
#include <boresight/io/case/plant_numbers.hpp>
#include <boresight/plant/antenna/antenna_change.hpp>
#include <boresight/plant/antenna/gear_train.hpp>
#include <boresight/plant/antenna/hydraulics.hpp>
#include <boresight/python/bindings.hpp>
#include <boresight/python/results.hpp>

namespace boresight::python {
namespace {

Plant make_plant(const io::Case& antenna, std::optional<double> flywheel_disks,
                 std::optional<double> antenna_inertia, std::optional<double> oil_stiffness,
                 std::optional<double> leakage_rate, std::optional<double> viscous_friction) {
  std::vector<plant::AntennaChange> changes;
  const auto set = [&](const char* path, const std::optional<double>& number) {
    if (number) changes.push_back(plant::set_to(path, *number));
  };
  set("motor.flywheel_disks", flywheel_disks);
  set("at_shaft.antenna_inertia", antenna_inertia);
  set("at_shaft.oil_stiffness", oil_stiffness);
  set("drive.leakage_rate", leakage_rate);
  set("drive.viscous_friction", viscous_friction);

  Plant result{{report_of(antenna, "model", 1)}, app::describe_plant(antenna), {}};
  auto& section = result.section;
  section.plant = io::make_plant(antenna, changes);
  result.state_space = plant::to_state_space(section.plant);
  section.reflected_inertia = plant::reflected_inertia(section.plant);
  section.motor_to_load_ratio = plant::motor_to_load_ratio(
      io::motor_inertia(antenna, flywheel_disks.value_or(antenna.motor->flywheel_disks)),
      section.reflected_inertia);
  section.rigid_frequency =
      plant::hydraulic_frequency(section.plant.drive.oil_stiffness, section.reflected_inertia);
  section.modes = plant::plant_modes(section.plant);
  section.hydraulic = plant::hydraulic_mode(section.modes);
  result.report.plant = section;
  return result;
}

}  // namespace

void add_plant(py::module_& module) {
  using plant::PlantMode;
  py::class_<PlantMode>(module, "Mode", "One mode of the plant.")
      .def_readonly("pole", &PlantMode::pole, "rad/s, upper half plane")
      .def_readonly("frequency", &PlantMode::frequency, "|pole|/(2 pi), Hz")
      .def_readonly("damping_ratio", &PlantMode::damping_ratio)
      .def_readonly("description", &PlantMode::description, "What moves most")
      .def_readonly("participation", &PlantMode::participation, "Of what moves most, 0 to 1")
      .def_readonly("oil_fraction", &PlantMode::oil_fraction,
                    "d ln frequency^2/d ln oil_stiffness: the oil spring's fraction of its elastic "
                    "energy without damping")
      .def_readonly("gear_fraction", &PlantMode::gear_fraction, "The same of the gear spring")
      .def("__repr__", [](const PlantMode& mode) {
        return fmt::format("<boresight.Mode {:.4g} Hz, damping {:.4g}: {}>", mode.frequency,
                           mode.damping_ratio, mode.description);
      });

  py::class_<Plant, Found>(
      module, "Plant",
      "The linear plant at the motor shaft. Inputs valve_command (rad/s of no-load motor speed) "
      "and "
      "wind_torque (N m); outputs tachometer (rad/s), motor_torque (N m), encoder and beam (rad of "
      "motor).")
      .def_readonly("state_space", &Plant::state_space, "StateSpace")
      .def_property_readonly(
          "abcd",
          [](const Plant& plant) -> py::object { return py::cast(plant.state_space).attr("abcd"); },
          "(A, B, C, D), for control.ss(*plant.abcd)")
      .def_property_readonly("states", [](const Plant& plant) { return plant.state_space.states; })
      .def_property_readonly("inputs", [](const Plant& plant) { return plant.state_space.inputs; })
      .def_property_readonly("outputs",
                             [](const Plant& plant) { return plant.state_space.outputs; })
      .def_property_readonly(
          "modes", [](const Plant& plant) { return plant.section.modes; },
          "Every Mode, by frequency")
      .def_property_readonly(
          "hydraulic_mode", [](const Plant& plant) { return plant.section.hydraulic; },
          "The Mode in which the motors swing on the oil")
      .def_property_readonly(
          "reflected_inertia", [](const Plant& plant) { return plant.section.reflected_inertia; },
          "kg m2, of motors, gear train and antenna")
      .def_property_readonly("motor_to_load_ratio",
                             [](const Plant& plant) { return plant.section.motor_to_load_ratio; })
      .def_property_readonly("gear_ratio",
                             [](const Plant& plant) { return plant.section.gear_ratio; })
      .def_property_readonly(
          "oil_stiffness",
          [](const Plant& plant) { return plant.section.plant.drive.oil_stiffness; }, "N m/rad")
      .def_property_readonly(
          "leakage_rate", [](const Plant& plant) { return plant.section.plant.drive.leakage_rate; },
          "1/s, of the torque at a held motor")
      .def_property_readonly(
          "viscous_friction",
          [](const Plant& plant) { return plant.section.plant.drive.viscous_friction; },
          "N m s/rad")
      .def_property_readonly(
          "supply_torque", [](const Plant& plant) { return plant.section.supply_torque; },
          "N m, of all motors at the supply pressure");

  module.def(
      "plant", &make_plant, py::arg("case"), py::kw_only(), py::arg("flywheel_disks") = py::none(),
      py::arg("antenna_inertia") = py::none(), py::arg("oil_stiffness") = py::none(),
      py::arg("leakage_rate") = py::none(), py::arg("viscous_friction") = py::none(),
      "The case's plant, or one with other numbers: flywheel disks on each motor, antenna "
      "inertia (kg m2 at the motor shaft), oil stiffness (N m/rad), leakage rate (1/s), viscous "
      "friction (N m s/rad). Raises InvalidInput for numbers that no plant has.");
}

}  // namespace boresight::python
