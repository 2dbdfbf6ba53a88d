#pragma once

#include <optional>
#include <string>
#include <vector>

#include <boresight/app/redesign/guessed_shares.hpp>
#include <boresight/design/problem/pointing.hpp>
#include <boresight/design/tuning/design_study.hpp>
#include <boresight/identification/campaign/inertia_methods.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/plant/antenna/friction.hpp>

namespace boresight::app {

/// What a study changes about the antenna of a case. SI, at the motor shaft. The structure keeps
/// the frequencies that the case states, but for structure_frequency_scale, whatever the inertia:
/// they are what was measured or reckoned, and another estimate of the inertia is another one of
/// the springs with it.
struct PlantVariant {
  std::optional<double> flywheel_disks = std::nullopt;  // on each motor
  std::optional<double> viscous_friction = std::nullopt;
  std::optional<double> antenna_inertia = std::nullopt;
  std::optional<double> oil_stiffness = std::nullopt;
  std::optional<double> leakage_rate = std::nullopt;
  /// Multiplies every inertia, motors' and antenna's.
  double inertia_scale = 1.0;
  /// Multiplies the motors' inertia, flywheels included.
  double motor_inertia_scale = 1.0;
  /// Multiplies the frequencies of locked rotor and modes.
  double structure_frequency_scale = 1.0;
  /// Which of the antennas that have the stated frequencies: structure_specifications.
  std::size_t structure = 0;
  GuessedShares guessed_shares = GuessedShares::as_stated;
  /// Multiplies the shares of the wind torque that act on bull gear and modes, which is a wind
  /// torque so many times as large.
  double wind_torque_scale = 1.0;
};

/// Gear train and counter-torque motors at the motor shaft (kg m2).
double gear_train_inertia(const io::Case& antenna);
/// All motors with `disks` flywheel disks each (kg m2).
double motor_inertia(const io::Case& antenna, double disks);
/// The antenna inertia of the case, and of an alternative, at the motor shaft (kg m2).
double antenna_inertia(const io::Case& antenna);
double antenna_inertia(const io::Case& antenna, const io::AntennaAlternative& alternative);
/// The antenna of an alternative: with the case's frequencies, or with the case's springs and
/// inertia fractions, which scales all frequencies alike.
PlantVariant variant_of(const io::Case& antenna, const io::AntennaAlternative& alternative);
/// That of the case, or the mean over its lines (Pa).
double bulk_modulus(const io::Case& antenna);
/// Oil spring by the case's bulk modulus, or the mean of its lines (N m/rad).
double oil_stiffness(const io::Case& antenna, plant::EfficiencyInStiffness efficiency);
double oil_stiffness(const io::Case& antenna);
/// Leakage rate (1/s) with a bulk modulus so many times the case's: so many times as high where the
/// case states a flow, whose conductance stays; the case's where that states a rate, as measured.
double leakage_rate_at(const io::Case& antenna, double bulk_modulus_factor);

plant::AntennaPlant make_plant(const io::Case& antenna, const PlantVariant& variant = {});
/// The most viscous friction that a linear plant may have (N m s/rad): tracking_friction, or what
/// the case states for it.
double largest_viscous_friction(const io::Case& antenna);
design::TrackingProblem make_problem(const io::Case& antenna, const PlantVariant& variant = {});
/// Mean wind speed (m/s) at which the mean wind torque takes all that friction at the tracking rate
/// and the offset torque leave of the supply's (torque_for_wind); 0 where they leave nothing,
/// infinite without mean torque.
double supply_wind_speed(const io::Case& antenna, const design::TrackingProblem& problem);
/// What the mean wind bends the structure between encoder and beam (rad at the sky): no part of any
/// rms, and seen by no encoder.
double static_bending(const design::TrackingProblem& problem);
/// Goals against saturation: valve demand within the valve's stroke (largest_demand) and torque
/// within what friction and offset leave of the supply's (torque_for_wind).
/// @throws InvalidInput for a crest_factor where they leave nothing.
design::HardGoals make_goals(const io::Case& antenna);
design::SoftGoal make_soft_goal(const io::Case& antenna);
/// The winds of the site by their share of the time; empty if the case does not state them.
std::vector<design::WeightedWind> make_climate(const io::Case& antenna);
/// What a case states for identification::identify_inertia: the resonance only where
/// rings_as_rigid, the antenna's alternatives only where they are of the same attitude.
/// @throws InvalidInput and NumericalFailure as make_plant and plant::plant_modes, with a
/// resonance.
identification::DriveEvidence make_evidence(const io::Case& antenna);

/// A pointing budget as rms error an axis (rad).
struct PointingBudget {
  std::string name;
  std::string band;
  double beamwidth = 0.0;            // rad
  double rms = 0.0;                  // rad
  std::string convention;            // in words
  std::optional<double> wind_speed;  // m/s, up to which it must be met
};
std::vector<PointingBudget> make_budgets(const io::Case& antenna);
/// Rms error an axis (rad) of the tightest of them; 1 mdeg where the case states none.
double tightest_budget(const io::Case& antenna);

struct PointingBand {
  std::string name;
  double frequency = 0.0;    // Hz
  double beamwidth = 0.0;    // rad
  std::string illumination;  // that the beamwidth rests on; empty if its factor is stated
};
std::vector<PointingBand> make_bands(const io::Case& antenna);

/// Number of flywheel disks at which motors and load (gear train and antenna) have one inertia;
/// nothing if that would need fewer than none.
std::optional<double> disks_at_unit_ratio(const io::Case& antenna, double load_inertia);

}  // namespace boresight::app
