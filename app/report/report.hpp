#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <boresight/app/audit/audit_report.hpp>
#include <boresight/app/evaluate/evaluate_section.hpp>
#include <boresight/app/figures/figure.hpp>
#include <boresight/app/match/match_section.hpp>
#include <boresight/app/redesign/input_effects.hpp>
#include <boresight/app/redesign/resonance_verdict.hpp>
#include <boresight/app/simulate/time_domain.hpp>
#include <boresight/app/tune/measured_section.hpp>
#include <boresight/app/tune/tune_section.hpp>
#include <boresight/design/ensembles/monte_carlo_statistics.hpp>
#include <boresight/design/ensembles/plant_ensemble.hpp>
#include <boresight/design/limits/pointing_limit.hpp>
#include <boresight/design/problem/pointing_budget.hpp>
#include <boresight/design/studies/redesign_study.hpp>
#include <boresight/design/studies/state_space_study.hpp>
#include <boresight/identification/friction/steady_friction.hpp>
#include <boresight/io/campaign/campaign_section.hpp>
#include <boresight/io/campaign/identified_case.hpp>
#include <boresight/io/case/pointing_axis.hpp>
#include <boresight/plant/wind/torque_coefficients.hpp>
#include <boresight/plant/wind/wind_mast.hpp>

namespace boresight::app {

struct IdentificationSection {
  identification::InertiaIdentification inertia;
  std::optional<identification::CombinedInertia> combined;
  /// Values the case states for a method's inertia and ratio, by method; empty text where none.
  struct Printed {
    std::string inertia;
    std::string ratio;
  };
  std::vector<Printed> printed;
  std::optional<numerics::PropagatedResult> tachometer_scale;   // rad/(s V), eq. 32
  std::optional<numerics::PropagatedResult> slow_ramp_coulomb;  // N m
  std::optional<numerics::PropagatedResult> slow_ramp_offset;   // N m
  /// Whether the case writes an inertia in pounds-force, so that tables show those too.
  bool pounds_force = false;
};

/// A test at a steady rate, and its residual over the curve through all tests (N m).
struct FrictionTestRow : identification::SteadyFriction {
  double residual = 0.0;
};

struct PlantSection {
  plant::AntennaPlant plant;
  double gear_ratio = 1.0;
  double reflected_inertia = 0.0;
  double motor_to_load_ratio = 0.0;
  double rigid_frequency = 0.0;  // Hz, all inertia rigid on the oil spring
  double tracking_slope = 0.0;   // N m s/rad, of the friction curve
  plant::FrictionCurve friction;
  /// The case's tests at steady rates that the friction curve goes through; empty if it is stated.
  std::vector<FrictionTestRow> friction_tests;
  std::vector<plant::PlantMode> modes;
  plant::PlantMode hydraulic;
  /// The case states its structure's frequencies with the motors held.
  bool motors_held = false;
  double supply_torque = 0.0;          // N m
  double available_wind_torque = 0.0;  // N m, what friction and offset leave of it
  double mean_wind_torque = 0.0;       // N m at the motor, design speed
  std::optional<double> slew_rate_margin = std::nullopt;  // io::slew_rate_margin
  /// Number of records whose combined estimate the plant is; 0: the plant is as stated in the case.
  std::size_t records = 0;
};

using design::BudgetResult;
using MatchingRow = design::FlywheelRow;
using MatchingSeries = design::FlywheelSeries;
using MatchingSection = design::FlywheelComparison;

/// The recommended controller in detail, and the parts of the case's text that its report needs.
struct TuningSection : design::RecommendedDesign {
  std::optional<plant::WindAttitude> wind_attitude;  // none: one torque coefficient for all
  std::optional<plant::WindMast> wind_mast;  // none: the case states speeds at the dish's centre
  std::string demand_assumption;             // that a goal on gusts rests on; empty if stated
  std::string ensemble_source;               // of the plants that `ensemble` is about
  /// Of a redesign from records: the probability of instability over the ranges of the case about
  /// the identified plant, which are wider than what the records leave open.
  std::optional<design::EstimatedNumber> instability;
  io::GainUnits gain_units;
  /// The numbers of the case on which its rms depends most; empty without a stable controller.
  std::vector<InputEffect> input_effects;
};

/// The same loop tuned on what another choice among contradictory numbers would make of the plant.
struct InterpretationResult {
  std::string name;
  std::string says;  // what it takes from where
  double oil_stiffness = 0.0;
  double reflected_inertia = 0.0;
  double motor_to_load_ratio = 0.0;
  std::optional<design::Design> design;  // none where the choice leaves no plant
  std::string impossible;                // why
  /// True for another assumption on the modal participation of wind and boresight.
  bool other_fractions = false;
  /// True for another attitude of the same antenna, on its own springs.
  bool other_attitude = false;
  /// True for another source's number or a test's result that contradicts the reference; false for
  /// a convention of computation.
  bool contradicts = false;
  /// Wind speed (m/s) up to which each budget is met with these gains fixed; none without a stable
  /// controller.
  std::optional<std::vector<double>> speed_limits = std::nullopt;
  /// The measured hydraulic frequency (Hz) that the choice was meant to give.
  std::optional<double> wanted_frequency = std::nullopt;
  /// The frequency of its flexible antenna instead (resonating_mode, Hz).
  double resonance = 0.0;

  /// That frequency (Hz) if it is 5 % or more off the wanted one: the choice then does not resolve
  /// the contradiction.
  std::optional<double> missed_resonance() const;
};

/// The heading above tuned loops, which figures name too.
std::string tuning_heading(const TuningSection& section);

/// The heading above choices: of contradictions where there are some.
std::string interpretations_heading(const std::vector<InterpretationResult>& interpretations);

/// What one command found: the sections it computed.
struct Report {
  std::string command;
  std::string title;
  io::PointingAxis axis;
  std::string case_path;
  std::uint64_t seed = 1;
  std::optional<AuditReport> audit;
  std::optional<io::CampaignSection> campaign;  // of cases with records
  std::optional<IdentificationSection> identification;
  std::optional<io::ResonanceVerdict> resonance;  // measured without records of the drive
  std::optional<PlantSection> plant;
  std::optional<TuningSection> tuning;
  std::optional<MeasuredTuneSection> measured;   // of tune --measured
  std::optional<TuneSection> tuned;              // of the command tune
  std::optional<TimeDomainSection> time_domain;  // of the best tuned controller
  std::optional<design::PointingLimit> limit;    // of tune, at the best controller's wind speed
  std::optional<design::StateSpaceStudy> state_space;  // of the limit's robust LQG
  std::vector<InterpretationResult> interpretations;
  std::optional<MatchingSection> matching;
  std::optional<MatchSection> matched;       // of the command match
  std::optional<EvaluateSection> evaluated;  // of the command evaluate
  /// What the case's records have replaced of it; `assumed` has none of these.
  std::vector<io::SupersededInput> superseded;
  std::vector<io::Quantity> assumed;
  std::vector<std::string> conclusions;
  std::vector<Figure> figures;  // report_figures of all this
  /// The user stopped the work: the sections here are whole, others are missing.
  bool interrupted = false;
};

/// Puts resonance_warning, if there is one, before the conclusions.
void lead_with_resonance(Report& report);

/// A report of that command on a case, whose sections are still missing.
Report begin_report(std::string command, const io::Case& antenna, std::string case_path,
                    std::uint64_t seed);

}  // namespace boresight::app
