#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/document/document.hpp>
#include <boresight/app/redesign/oil_remark.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/app/report/text_report.hpp>
#include <boresight/io/case/friction_leeway.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/plant/antenna/motors_held_modes.hpp>

namespace boresight::app {
namespace {

// What single torques make of the curve, and whether anything is left to check it by.
std::string friction_doubts(const PlantSection& section, bool exact) {
  constexpr double worth_telling = 0.02;  // of the number
  const std::vector<identification::SteadyFriction> points(section.friction_tests.begin(),
                                                           section.friction_tests.end());
  const auto intervals = identification::steady_friction_intervals(points);
  std::vector<std::string> moved;
  if (intervals.stribeck_rate) {
    moved.push_back(
        fmt::format("the Stribeck rate is {}", io::in_words(*intervals.stribeck_rate, "rad/s")));
  }
  const auto add = [&](const char* name, const identification::FrictionInterval& interval,
                       double value) {
    if (std::max(interval.largest - value, value - interval.minimum) > worth_telling * value) {
      moved.push_back(fmt::format("{} is {}", name, io::in_words(interval, "N.m")));
    }
  };
  add("breakaway", intervals.breakaway_torque, section.friction.breakaway_torque);
  add("Coulomb", intervals.coulomb_torque, section.friction.coulomb_torque);
  std::string text;
  if (!moved.empty()) text = fmt::format("{} {}.", io::moved_torques(), fmt::join(moved, ", "));
  if (identification::steady_friction_freedom(points) > 0) return text;
  const bool told = intervals.stribeck_rate.has_value();
  return fmt::format(
      "{}{}The curve has as many unknowns as there are tests: no degree of freedom is left, {}.{}",
      text, text.empty() ? "" : " ",
      exact ? "so the residuals do not check the curve"
            : "and the residuals only show a parameter at its bound",
      told && !io::is_loose(*intervals.stribeck_rate)
          ? ""
          : fmt::format(
                " Limit cycles and reversals depend on the Stribeck rate{}: test more low rates.",
                told ? "" : ", which these tests do not determine"));
}

Document friction_part(const PlantSection& section) {
  constexpr double rounding = 1e-5;  // of the fit
  const plant::FrictionCurve& curve = section.friction;
  std::vector<std::vector<std::string>> rows{
      {"axis mdeg/s", "motors rad/s", "friction N.m", "test - curve N.m"}};
  bool exact = true;
  for (const auto& test : section.friction_tests) {
    const bool hit = std::abs(test.residual) < rounding * test.torque;
    exact &= hit;
    rows.push_back({fmt::format("{:.4g}", test.rate / section.gear_ratio / millidegree),
                    fmt::format("{:.4g}", test.rate), fmt::format("{:.4g}", test.torque),
                    hit ? "0" : fmt::format("{:+.2g}", test.residual)});
  }
  return "\n" +
         wrapped(fmt::format("Friction curve through {} tests at steady rates: Coulomb {:.4g} N.m, "
                             "breakaway {:.4g} N.m, Stribeck rate {:.4g} rad/s, viscous {:.4g} "
                             "N.m.s/rad.",
                             section.friction_tests.size(), curve.coulomb_torque,
                             curve.breakaway_torque, curve.stribeck_rate, curve.viscous_friction),
                 "  ") +
         table(rows, "rrrr") + wrapped(friction_doubts(section, exact), "  ");
}

// What frequencies with the motors held make of the antenna.
Document structure_part(const plant::Structure& structure) {
  const double inertia = plant::antenna_inertia(structure);
  std::vector<std::vector<std::string>> rows{
      {"structure, bull gear locked", "frequency Hz", "inertia fraction"},
      {"bull gear", "-", fmt::format("{:.4f}", structure.bull_gear_inertia / inertia)}};
  for (std::size_t i = 0; i < structure.modes.size(); ++i) {
    const auto& mode = structure.modes[i];
    rows.push_back({fmt::format("structure.mode[{}]", i),
                    fmt::format("{:.4f}", std::sqrt(mode.stiffness / mode.inertia) / two_pi),
                    fmt::format("{:.4f}", mode.inertia / inertia)});
  }
  std::vector<std::vector<std::string>> held{
      {"structure, motors locked", "frequency Hz", "effective fraction", "gear"}};
  for (const auto& mode : plant::motors_held_modes(structure)) {
    held.push_back(
        {held.size() == 1 ? "lowest" : fmt::format("structure.mode[{}]", held.size() - 2),
         fmt::format("{:.4f}", mode.frequency), fmt::format("{:.4f}", mode.inertia_fraction),
         fmt::format("{:.2f}", mode.gear_fraction)});
  }
  return "\n" + table(held) + "\n" + table(rows) +
         wrapped(
             "From the case's frequencies with the motors locked. Wind and boresight fractions are "
             "those of the modes with the bull gear locked; use the inertia fractions as a first "
             "guess. If a structural model gives the lowest mode less than the effective fraction "
             "above, modes are missing here; with them the gearbox spring is stiffer. gear: its "
             "fraction of the mode's elastic energy.",
             "  ");
}

}  // namespace

Document document_of(const PlantSection& section) {
  const auto& drive = section.plant.drive;
  const auto& structure = section.plant.structure;
  Document text = heading("Plant, at the motor shaft, all motors lumped");
  if (section.records > 0) {
    text +=
        wrapped(fmt::format(
                    "Inertias, oil stiffness, leakage, friction curve and lowest structural "
                    "frequency are the combined estimate of {} records; the rest is the case's.",
                    section.records),
                "  ") +
        "\n";
  }
  const auto row = [](const char* name, double value, const char* unit) {
    return std::vector<std::string>{name, fmt::format("{:.6g}", value), unit};
  };
  std::vector<std::vector<std::string>> numbers{
      row("gear ratio", section.gear_ratio, "1"),
      row("motor side inertia (motors, flywheels, gear train)", drive.motor_inertia, "kg.m2"),
      row("antenna inertia", plant::antenna_inertia(structure), "kg.m2"),
      row("reflected inertia", section.reflected_inertia, "kg.m2"),
      row("motor-to-load ratio", section.motor_to_load_ratio, "1"),
      row("oil stiffness", drive.oil_stiffness, "N.m/rad"),
      row("leakage rate", drive.leakage_rate, "1/s"),
      row("viscous friction", drive.viscous_friction, "N.m.s/rad"),
      row("tracking friction slope", section.tracking_slope, "N.m.s/rad"),
      row("gear stiffness", structure.gear_stiffness, "N.m/rad"),
      row("gear stiffness at the axis", structure.gear_stiffness * std::pow(section.gear_ratio, 2),
          "N.m/rad"),
      row("valve", drive.valve_corner / two_pi, "Hz"),
      row("supply torque", section.supply_torque, "N.m"),
      row("supply torque beyond friction at tracking rate and offset",
          section.available_wind_torque, "N.m"),
      row("mean wind torque at design speed", section.mean_wind_torque, "N.m")};
  if (section.slew_rate_margin) {
    numbers.push_back(
        row("slew margin: highest rate against friction and offset, over the slew rate",
            *section.slew_rate_margin, "1"));
  }
  text += table(numbers, "l", 0);
  text += "\n";
  std::vector<std::vector<std::string>> rows{
      {"mode", "frequency Hz", "damping", "pole 1/s", "fraction", "oil", "gear"}};
  for (const auto& mode : section.modes) {
    const bool springs = mode.pole.imag() > 0.0 && mode.oil_fraction != 0.0;
    // One that rounds to nothing has no sign.
    const auto fraction = [&](double of) {
      return springs ? fmt::format("{:.2f}", std::abs(of) < 0.005 ? 0.0 : of) : "-";
    };
    rows.push_back({mode.description, fmt::format("{:.4f}", mode.frequency),
                    mode.frequency > 0.0 ? fmt::format("{:.4f}", mode.damping_ratio) : "-",
                    mode.pole.imag() > 0.0
                        ? fmt::format("{:.4f} + {:.4f}i", mode.pole.real(), mode.pole.imag())
                        : fmt::format("{:.4f}", mode.pole.real()),
                    fmt::format("{:.2f}", mode.participation), fraction(mode.oil_fraction),
                    fraction(mode.gear_fraction)});
  }
  text += table(rows);
  text += wrapped(
      "fraction: of the part that moves most, in the motion; oil, gear: of oil and gearbox spring, "
      "in the undamped elastic energy, the rest being the structure's. 1 % more stiffness of a "
      "spring raises the frequency by half its fraction of 1 %.",
      "  ");
  text +=
      wrapped(fmt::format("The hydraulic mode of the flexible antenna is {:.3f} Hz with damping "
                          "{:.3f}; the rigid masses on the oil spring would give {:.3f} Hz.{}",
                          section.hydraulic.frequency, section.hydraulic.damping_ratio,
                          section.rigid_frequency,
                          oil_remark(section.hydraulic, plant::mode_of_oil(section.modes))),
              "  ");
  if (section.motors_held) text += structure_part(section.plant.structure);
  if (!section.friction_tests.empty()) text += friction_part(section);
  return text;
}

}  // namespace boresight::app
