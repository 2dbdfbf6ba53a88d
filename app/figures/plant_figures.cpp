#include <algorithm>
#include <cmath>
#include <complex>

#include <fmt/format.h>

#include <boresight/app/figures/frequency_curves.hpp>
#include <boresight/app/figures/plant_figures.hpp>
#include <boresight/app/report/sky_units.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/plant/antenna/plant_response.hpp>

namespace boresight::app {
namespace {

constexpr const char* section_title = "Plant, at the motor shaft, all motors lumped";

bool oscillates(const plant::PlantMode& mode) {
  return mode.frequency > 0.0 && mode.damping_ratio > 0.0 && mode.damping_ratio < 1.0;
}

std::string basis(const PlantSection& section) {
  return fmt::format(
      "Linear plant{}: friction {:g} N.m.s/rad, oil stiffness {:.4g} N.m/rad, leakage rate {:.3g} "
      "1/s, reflected inertia {:.4g} kg.m2.",
      section.records > 0 ? fmt::format(" identified from {} records", section.records) : "",
      section.plant.drive.viscous_friction, section.plant.drive.oil_stiffness,
      section.plant.drive.leakage_rate, section.reflected_inertia);
}

Figure modes_figure(const PlantSection& section) {
  Figure figure;
  figure.id = "plant-modes";
  figure.section = section_title;
  figure.title = "Modes of the plant";
  figure.caption = fmt::format(
      "Each oscillatory mode by frequency and damping ratio, named after its largest motion. {} "
      "The hydraulic mode is at {:.3f} Hz; a rigid antenna on the oil spring would be at {:.3f} "
      "Hz.",
      basis(section), section.hydraulic.frequency, section.rigid_frequency);
  figure.x = frequency_axis();
  FigurePanel panel;
  panel.y = {.label = "damping ratio", .scale = AxisScale::logarithmic};
  FigureSeries modes{.style = SeriesStyle::points};
  for (const auto& mode : section.modes) {
    if (!oscillates(mode)) continue;
    modes.x.push_back(mode.frequency);
    modes.y.push_back(mode.damping_ratio);
    modes.labels.push_back(mode.description);
  }
  panel.series.push_back(std::move(modes));
  panel.lines.push_back({FigureLine::Direction::vertical, section.rigid_frequency,
                         "rigid antenna on the oil spring"});
  figure.panels.push_back(std::move(panel));
  return figure;
}

// From a decade below the hydraulic mode to beyond valve and highest mode.
Eigen::ArrayXd grid(const PlantSection& section) {
  double lowest = section.hydraulic.frequency;
  double highest = std::max(section.plant.drive.valve_corner / two_pi, lowest);
  for (const auto& mode : section.modes) {
    if (!oscillates(mode)) continue;
    lowest = std::min(lowest, mode.frequency);
    highest = std::max(highest, mode.frequency);
  }
  return plant::frequency_grid(section.plant, 0.05 * lowest, 2.0 * highest, 60);
}

Figure valve_figure(const PlantSection& section, const plant::PlantResponse& response) {
  Figure figure;
  figure.id = "plant-valve-response";
  figure.section = section_title;
  figure.title = "Response to the valve command";
  figure.caption = fmt::format(
      "Open-loop rates of motor, encoder and boresight, referred to the motor shaft, per valve "
      "command (no-load motor rate). Boresight and encoder differ by flexure beyond the encoder. "
      "{}",
      basis(section));
  figure.x = frequency_axis();
  const std::complex<double> j(0.0, 1.0);
  const Eigen::ArrayXcd derivative = j * response.frequency;
  figure.panels = bode_panels(response.frequency,
                              {{"motor (tachometer)", response.tachometer_command},
                               {"encoder", derivative * response.encoder_command},
                               {"boresight", derivative * response.boresight_command}},
                              "rate per commanded rate");
  const double peak = section.hydraulic.frequency;
  figure.panels[0].lines.push_back({FigureLine::Direction::vertical, peak, "hydraulic mode"});
  figure.panels[1].lines.push_back({FigureLine::Direction::vertical, peak, ""});
  return figure;
}

Figure wind_figure(const PlantSection& section, const plant::PlantResponse& response) {
  Figure figure;
  figure.id = "plant-wind-response";
  figure.section = section_title;
  figure.title = "Response to wind torque";
  figure.caption = fmt::format(
      "Open-loop angle at the sky per wind torque about the axis: boresight, encoder, and "
      "boresight with the bull gear locked (flexure beyond the encoder). {}",
      basis(section));
  figure.x = frequency_axis();
  FigurePanel panel;
  panel.y = {.label = "angle at the sky per torque about the axis",
             .unit = "mdeg/(kN.m)",
             .scale = AxisScale::logarithmic};
  // rad of motor per N m at the motor: by the gear ratio to the sky, once for each.
  const double scale = 1e3 / (millidegree * section.gear_ratio * section.gear_ratio);
  const auto bending = plant::structure_response(section.plant.structure, response.frequency);
  const auto add = [&](const char* name, SeriesStyle style, const Eigen::ArrayXcd& values) {
    panel.series.push_back({.name = name,
                            .style = style,
                            .x = in_hertz(response.frequency),
                            .y = numbers(scale * values.abs())});
  };
  add("boresight", SeriesStyle::line, response.boresight_wind);
  add("encoder", SeriesStyle::line, response.encoder_wind);
  add("boresight, bull gear locked", SeriesStyle::dashed, bending.boresight_per_wind);
  figure.panels.push_back(std::move(panel));
  return figure;
}

}  // namespace

std::vector<Figure> plant_figures(const PlantSection& section) {
  const auto response = plant::plant_response(section.plant, grid(section));
  std::vector<Figure> figures;
  if (std::any_of(section.modes.begin(), section.modes.end(), oscillates)) {
    figures.push_back(modes_figure(section));
  }
  figures.push_back(valve_figure(section, response));
  figures.push_back(wind_figure(section, response));
  return figures;
}

}  // namespace boresight::app
