#include <utility>
#include <vector>

#include <boresight/io/description/adjustable_loop_description.hpp>
#include <boresight/io/description/loop_results.hpp>

namespace boresight::io {
namespace {

namespace unit = key_units;

constexpr NumberForm positive{.above = 0.0, .finite = true};
constexpr NumberForm not_negative{.minimum = 0.0, .finite = true};
constexpr NumberForm known{.finite = true};
constexpr KeyUnit inertia_unit{.suffix = "kg_m2"};
constexpr KeyUnit stiffness_unit{.suffix = "N_m_per_rad"};
constexpr KeyUnit slope_unit{.suffix = "N_m_s_per_rad"};
constexpr KeyUnit radian_unit{.suffix = "rad"};
constexpr KeyUnit metre_unit{.suffix = "m"};
constexpr KeyUnit density_unit{.suffix = "kg_per_m3"};

struct Gain {
  control::GainDescription description;
  double value = 0.0;
};

struct Block {
  control::LoopPath path = control::LoopPath::rate;
  control::BlockKind kind = control::BlockKind::gain;
  std::vector<Gain> gains;
};

std::vector<Block> blocks_of(const control::Controller& controller) {
  std::vector<Block> blocks;
  std::size_t next = 0;
  for (const auto& block : controller.structure.blocks()) {
    Block described{block.path, block.kind, {}};
    for (const auto& gain : block.gains) {
      if (next < controller.gains.size()) described.gains.push_back({gain, controller.gains[next]});
      ++next;
    }
    blocks.push_back(std::move(described));
  }
  return blocks;
}

void describe_block(Visitor& v, const Block& block) {
  v.text("path", control::to_string(block.path), "Compensator that it is a factor of.");
  v.text("kind", control::to_string(block.kind), "The factor.");
  v.list("gains", block.gains, "Its gains.", [&](const Gain& gain) {
    v.text("symbol", gain.description.symbol, "Key of --gains.");
    v.text("name", gain.description.name, "Its name.");
    v.text("unit", gain.description.unit, "SI; 1: none.");
    v.number("value", gain.value, unit::none, "In that unit.", positive);
  });
}

void describe_drive(Visitor& v, const plant::Drive& drive) {
  v.number("oil_stiffness", drive.oil_stiffness, stiffness_unit, "Oil spring.", positive);
  v.number("leakage_rate", drive.leakage_rate, unit::per_second,
           "Oil stiffness over leakage damper.", not_negative);
  v.number("viscous_friction", drive.viscous_friction, slope_unit, "Friction slope.", not_negative);
  v.number("motor_inertia", drive.motor_inertia, inertia_unit, "Motors, flywheels and gear train.",
           positive);
  v.number("valve_corner", drive.valve_corner, unit::radian_per_second, "Natural frequency.",
           positive);
  v.number("valve_damping", drive.valve_damping, unit::ratio, "Of critical.", not_negative);
  v.number("tachometer_corner", drive.tachometer_corner, unit::radian_per_second,
           "First-order lag.", positive);
}

void describe_antenna(Visitor& v, const plant::Structure& structure) {
  v.number("bull_gear_inertia", structure.bull_gear_inertia, inertia_unit, "At the motor shaft.",
           positive);
  v.number("gear_stiffness", structure.gear_stiffness, stiffness_unit, "Motor to bull gear.",
           positive);
  v.number("gear_damping", structure.gear_damping, slope_unit, "In parallel.", not_negative);
  v.number("bull_gear_wind_fraction", structure.bull_gear_wind_fraction, unit::ratio,
           "Fraction of the wind torque on the bull gear.", known);
  v.number("bull_gear_beam_weight", structure.bull_gear_beam_weight, unit::ratio,
           "Weight of its angle in the boresight angle.", known);
  v.list("modes", structure.modes, "Masses on springs from the bull gear.",
         [&](const plant::StructuralMode& mode) {
           v.number("inertia", mode.inertia, inertia_unit, "At the motor shaft.", positive);
           v.number("stiffness", mode.stiffness, stiffness_unit, "Spring.", positive);
           v.number("damping", mode.damping, slope_unit, "In parallel.", not_negative);
           v.number("wind_fraction", mode.wind_fraction, unit::ratio,
                    "Fraction of the wind torque on the mass.", known);
           v.number("beam_weight", mode.beam_weight, unit::ratio,
                    "Weight of its angle in the boresight angle.", known);
         });
}

void describe_wind(Visitor& v, const design::WindCondition& wind) {
  const plant::WindSite& site = wind.site;
  const plant::GustSpectrum gusts = plant::site_gusts(site);
  v.text("model", plant::to_string(wind.model), "Of the gusts over the dish.");
  v.number("mean_speed", wind.mean_speed, unit::metre_per_second, "Mean wind speed.", not_negative);
  v.number("air_density", site.air_density, density_unit, "Of the air.", not_negative);
  v.number("dish_diameter", site.dish_diameter, metre_unit, "Of the dish.", not_negative);
  v.number("torque_coefficient", site.torque_coefficient, unit::ratio, "Of the mean torque.",
           known);
  v.number("gradient_coefficient", site.gradient_coefficient, unit::ratio,
           "Of the torque by uneven gusts.", known);
  v.number("coherence_decay", site.coherence_decay, unit::ratio, "Davenport's.", not_negative);
  v.group("gusts", "Spectrum at one point.", [&] {
    v.text("kind", plant::to_string(gusts.kind), "Its formula.");
    v.number("surface_drag", gusts.surface_drag, unit::ratio, "Davenport's kappa.", not_negative);
    v.number("turbulence_intensity", gusts.turbulence_intensity, unit::ratio,
             "Of the other formulas.", not_negative);
    v.number("length_scale", gusts.length_scale, metre_unit, "Of the other formulas.",
             not_negative);
  });
}

}  // namespace

void describe(Visitor& v, const design::AdjustableLoop& loop) {
  const design::TrackingProblem& problem = loop.problem;
  v.text("structure", loop.structure, "As --structure takes it.");
  v.list("blocks", blocks_of(loop.controller), "Factors of the compensators.",
         [&](const Block& block) { describe_block(v, block); });
  v.group("drive", "Oil, motors, valve and tachometer.",
          [&] { describe_drive(v, problem.plant.drive); });
  v.group("antenna", "Bull gear and structural modes.",
          [&] { describe_antenna(v, problem.plant.structure); });
  v.number("gear_ratio", problem.gear_ratio, unit::ratio, "Motor turns per turn of the axis.",
           positive);
  v.number("dead_time", problem.delay, unit::second, "On the valve command.", not_negative);
  v.group("noise", "Of the sensors, rms, white up to the bandwidth.", [&] {
    v.number("encoder", problem.noise.encoder_rms, radian_unit, "Of motor.", not_negative);
    v.number("tachometer", problem.noise.tachometer_rms, unit::radian_per_second, "Of motor.",
             not_negative);
    v.number("torque", problem.noise.torque_rms, unit::newton_metre,
             "Where a controller feeds torque back.", not_negative);
    v.number("bandwidth", problem.noise.bandwidth, unit::hertz, "Of all.", positive);
  });
  v.group("wind", "The wind that the rms is in.", [&] { describe_wind(v, problem.wind); });
  v.number("lowest_frequency", problem.rms_band.lowest, unit::hertz, "Of the rms.", not_negative);
  v.number("highest_frequency", problem.rms_band.highest, unit::hertz, "Of the rms.", positive);
  v.count("points_per_decade", problem.points_per_decade, "Of the frequency grid.");
  v.group("limits", "Constraints.", [&] {
    describe_breaks(v, loop.goals);
    v.number("control_effort", loop.goals.control_effort, unit::radian_per_second,
             "Largest rms of the valve command from sensor noise.", positive);
  });
}

}  // namespace boresight::io
