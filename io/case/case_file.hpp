#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <boresight/io/case/case_campaign.hpp>
#include <boresight/io/case/case_tuning.hpp>
#include <boresight/io/units/quantity.hpp>
#include <boresight/plant/wind/gust_spectrum.hpp>
#include <boresight/plant/wind/torque_coefficients.hpp>
#include <boresight/plant/wind/wind_record.hpp>

namespace boresight::io {

/// A solid disk of a rotating assembly, or a part whose inertia is given.
struct AssemblyPart {
  std::string name;
  std::string description;
  std::optional<Quantity> radius;
  std::optional<Quantity> length;
  std::optional<Quantity> inertia;
};

/// Bodies that turn together behind the first `stages` reductions; `count` of them, one per motor.
struct RotatingAssembly {
  std::string name;
  std::string description;
  long count = 1;
  std::size_t stages = 0;
  std::optional<Quantity> inertia;  // of one, about its own axis; else the sum of the parts
  std::vector<AssemblyPart> parts;
};

struct GearStageEntry {
  Quantity driven_teeth;
  Quantity driving_teeth;
};

struct GearTrainEntry {
  std::vector<GearStageEntry> stages;
  std::optional<Quantity> density;
  std::vector<RotatingAssembly> assemblies;
};

/// The antenna inertia according to another passage of the source.
struct AntennaAlternative {
  std::string name;
  std::optional<Quantity> inertia;            // about the antenna axis
  std::optional<Quantity> reflected_inertia;  // at the motor shaft
  /// The springs are the case's and the frequencies others, as of another attitude; else the other
  /// way round, as of another estimate.
  bool keeps_springs = false;
};

struct AntennaEntry {
  Quantity dish_diameter;
  Quantity inertia;  // about the antenna axis
  /// Where the dish points in the design wind and at the start of simulated tests.
  std::optional<Quantity> azimuth, elevation;
  /// Angle of the Y axis of an X-Y mount, 0 with the boresight perpendicular to X; for an X
  /// axis only.
  std::optional<Quantity> y_angle;
  std::vector<AntennaAlternative> alternatives;
};

struct MotorEntry {
  long count = 1;
  Quantity inertia;  // one motor as built, flywheel included
  double flywheel_disks = 0.0;
  Quantity rotor_inertia;                                          // one bare motor
  Quantity disk_inertia;                                           // one flywheel disk
  bool disk_inertia_stated = true;                                 // else of a solid disk
  std::optional<Quantity> disk_radius, disk_length, disk_density;  // where a solid disk is stated
  Quantity displacement;
  Quantity torque_efficiency;
  Quantity volumetric_efficiency;
};

/// A line whose pressure wave was measured.
struct OilLine {
  std::string name;
  Quantity length;
  Quantity slosh_frequency;
};

struct OilEntry {
  std::optional<Quantity> density;       // always where there are lines, known by length or wave
  std::optional<Quantity> bulk_modulus;  // else the mean over the lines
  Quantity volume_1;
  Quantity volume_2;
  bool efficiency_in_stiffness = true;
  std::vector<OilLine> lines;
};

struct TachometerEntry {
  Quantity voltage;
  Quantity shaft_speed;
  Quantity motor_teeth;       // motor turns per tachometer turn, numerator
  Quantity tachometer_teeth;  // and denominator
  Quantity recorder_limit;
};

struct FrictionTestsEntry {
  std::optional<Quantity> constant_speed_coulomb;
  std::optional<Quantity> constant_speed_slope;
  std::optional<Quantity> slow_ramp_up;
  std::optional<Quantity> slow_ramp_down;
};

/// A reflected inertia found by impulse and momentum.
struct ImpulseResult {
  std::string name;
  std::string friction;  // "constant_speed" or "slow_ramp": the friction that was subtracted
  Quantity reflected_inertia;
};

struct DriveEntry {
  Quantity leakage_rate;  // as stated, or by a flow at a pressure
  /// True if stated as a flow: the rate then scales with the oil's bulk modulus. A stated rate does
  /// not.
  bool leakage_by_flow = false;
  Quantity viscous_friction;
  Quantity valve_frequency;
  Quantity valve_damping;
  /// Flow at a total pressure drop over both edges, the valve fully open.
  std::optional<Quantity> valve_rated_flow, valve_rated_pressure_drop;
  Quantity supply_pressure;
  Quantity slew_rate;
  Quantity tracking_rate;
};

/// Friction measured at a steady rate, all motors, at the motor shaft.
struct SteadyFrictionTest {
  double rate = 0.0;      // rad/s of the motors; 0 for what just moved the antenna
  double torque = 0.0;    // N m
  double residual = 0.0;  // N m, of the torque over the curve through all tests
  /// N m, at least 0: the torque's own standard uncertainty where it is stated, else half a unit of
  /// its last printed digit.
  double leeway = 0.0;
};

struct FrictionCurveEntry {
  Quantity coulomb, breakaway, stribeck_rate, saturating, saturating_rate, viscous;
  /// The tests at steady rates that the curve goes through; empty if its numbers are stated.
  std::vector<SteadyFrictionTest> tests;
};

/// Quantities that the linear plant omits and `boresight simulate` needs, all motors at the motor
/// shaft.
struct SimulationEntry {
  Quantity return_pressure;
  Quantity null_leakage_share, case_leakage_share;
  Quantity valve_stroke;            // no-load motor speed with the valve fully open
  bool valve_stroke_stated = true;  // else by the valve's rated flow, or assumed
  Quantity valve_stroke_time;       // from centre to fully open
  Quantity valve_overlap;           // fraction of the stroke
  Quantity bristle_stiffness, bristle_damping;
  Quantity line_damping_ratio;
  Quantity makeup_pressure;
  Quantity air_fraction;
  Quantity offset_torque;
  std::optional<Quantity> offset_cosine, offset_sine;  // by the elevation; else 0
  Quantity preload_torque;
  std::optional<Quantity> backlash;           // of the motor; else none
  Quantity rate_loop_gain, rate_loop_corner;  // the analog rate loop of the tests
};

/// Properties of the antenna's recorder.
struct RecorderEntry {
  Quantity sample_rate;
  Quantity pressure_gain, pressure_zero, pressure_noise, pressure_resolution, pressure_range;
  Quantity tachometer_gain, tachometer_noise, tachometer_resolution;
  long filter_order = 0;                     // of the low-pass before the converter; 0: none
  std::optional<Quantity> filter_frequency;  // its corner
};

struct StructureModeEntry {
  Quantity frequency, damping_ratio;
  /// With the bull gear held: as stated, or without a key by the effective fractions as read.
  Quantity inertia_fraction;
  Quantity wind_fraction, beam_weight;
  /// Of the mode with the motors held, where the case states that; then of every mode.
  std::optional<Quantity> effective_fraction = std::nullopt;
};

struct StructureEntry {
  /// As stated, or computed from gear_stiffness; then with the annotations of that number, its key
  /// included.
  Quantity locked_rotor_frequency;
  /// Of the gear train between motors, held, and bull gear, at the antenna's axis.
  std::optional<Quantity> gear_stiffness;
  /// Whether the modes' frequencies are with the motors held, as locked_rotor_frequency is; else
  /// with the bull gear held.
  bool motors_held = false;
  Quantity gear_damping_ratio;
  Quantity bull_gear_wind_fraction;
  Quantity bull_gear_beam_weight;
  std::vector<StructureModeEntry> modes;
  /// A bound from a structural model and the axis it was computed for.
  std::optional<Quantity> lowest_predicted;
  std::string lowest_predicted_axis;
};

struct SensorsEntry {
  Quantity encoder_noise, tachometer_noise, noise_bandwidth, tachometer_frequency;
  std::optional<Quantity> torque_noise;  // of the torque that a controller feeds back
};

/// Attitude (rad) at which the torque coefficients were taken from their table: wind direction less
/// azimuth of the dish, and elevation of the dish.
struct WindAttitude {
  double yaw = 0.0;
  double elevation = 0.0;
};

/// The mast that a case's mean speeds are from: they grow with the height above ground as
/// height^shear_exponent, and a case holds them at the height of the dish's centre.
struct WindMast {
  double height = 0.0;       // m
  double dish_height = 0.0;  // m
  double shear_exponent = 0.0;
  double speed_ratio = 1.0;  // mean speed at the dish's centre over that at the mast
};

struct WindEntry {
  Quantity air_density, torque_coefficient, gradient_coefficient, coherence_decay;
  Quantity design_speed;
  std::optional<WindMast> mast;  // none: speeds are stated at the height of the dish's centre
  std::string model;
  plant::GustSpectrum gusts;
  /// How often which mean speed blows; empty: not stated.
  std::vector<design::WeightedSpeed> climate;
  std::vector<design::ClimatePart> climate_parts;  // the same as the case states it
  /// Root of the mean square of the torque coefficients over the attitudes that the case gives.
  std::optional<double> climate_torque_coefficient;
  /// Torque coefficients over yaw and elevation; torque_coefficient is then the table's.
  std::optional<plant::TorqueCoefficientTable> torque_table;
  std::optional<WindAttitude> attitude;
  /// A measured wind, for simulated tracking.
  std::optional<plant::WindRecord> record;
  std::string record_path;
};

struct BandEntry {
  std::string name;
  Quantity frequency;
  Quantity beamwidth_factor;  // as stated, or by the illumination
  std::string illumination;   // in words; empty if the factor is stated
};

/// A pointing budget: a loss in a band by a named convention, or an rms error per axis.
struct BudgetEntry {
  std::string name;
  std::string band;
  std::optional<Quantity> loss;  // dB
  std::string convention;
  std::optional<Quantity> rms;
  std::optional<Quantity> wind_speed;  // up to which it must be met
};

/// A derived number printed in the source, for the audit.
struct StatedEntry {
  std::string quantity;  // id, see docs/case-file.md
  Quantity value;
};

/// The author's notes on the source: equations, captions, conventions.
struct RemarkEntry {
  std::string place;
  std::string text;
};

/// One antenna axis as a case file describes it.
struct Case {
  std::string path;
  std::string title;
  std::string axis;
  AntennaEntry antenna;
  GearTrainEntry gear_train;
  MotorEntry motor;
  OilEntry oil;
  std::optional<Quantity> resonance_frequency, resonance_damping;
  /// They are of the mode with most oil, not of the lowest one.
  bool resonance_of_oil = false;
  /// If it has a voltage and a recorder limit; see campaign for one of another kind.
  std::optional<TachometerEntry> tachometer;
  FrictionTestsEntry friction_tests;
  std::vector<ImpulseResult> impulse_results;
  DriveEntry drive;
  FrictionCurveEntry friction_curve;
  StructureEntry structure;
  std::optional<SimulationEntry> simulation;
  std::optional<RecorderEntry> recorder;
  SensorsEntry sensors;
  Quantity controller_delay;
  WindEntry wind;
  std::vector<BandEntry> bands;
  std::vector<BudgetEntry> budgets;
  GoalsEntry goals;
  std::vector<LoopEntry> loops;
  std::optional<PresentGainsEntry> present_gains;
  EnsembleEntry ensemble;
  TuningEntry tuning;
  std::vector<double> matching_disks;
  std::vector<StatedEntry> stated;
  std::vector<RemarkEntry> remarks;
  /// The recorded tests and the instruments.
  CampaignEntry campaign;
  /// Every quantity of the file, in file order, for the list of assumptions.
  std::vector<Quantity> quantities;
};

/// Reads and checks a case file. @throws InvalidInput with one message: file, line, column, key,
/// what was expected and what was found.
Case read_case(const std::string& path);
/// Same, of a text; files that it names stand relative to the path's folder.
Case parse_case(std::string_view text, const std::string& path);

/// A loop structure by the name of one of the case's own, else as control::LoopStructure::named.
/// Its bounds are for the case's antenna (LoopStructure::with_bounds_for, driven_load), except
/// those in the case's [[tuning.bound]].
/// @throws InvalidInput listing them
control::LoopStructure loop_structure(const Case& antenna, const std::string& name);
/// The usual structures with lag, with the same bounds.
std::vector<control::LoopStructure> usual_structures_with_lag(const Case& antenna);

/// Replaces goals of the case: each change is KEY=VALUE, with a key and value of [goals],
/// "valve_effort=0.4 rad/s".
/// @throws InvalidInput for keys and values that [goals] would not take
void change_goals(GoalsEntry& goals, const std::vector<std::string>& changes);

/// The kind of a stated quantity's id ("reflected_inertia" is an inertia), from the closed list of
/// docs/case-file.md; nothing for an unknown id.
std::optional<Kind> stated_kind(const std::string& id, const Case& antenna);

}  // namespace boresight::io
