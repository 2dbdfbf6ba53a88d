#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <boresight/control/controllers/controller.hpp>
#include <boresight/design/problem/goals.hpp>
#include <boresight/design/problem/pointing_budget.hpp>
#include <boresight/design/problem/tracking_problem.hpp>
#include <boresight/design/problem/wind_climate.hpp>
#include <boresight/plant/antenna/antenna_change.hpp>
#include <boresight/plant/wind/torque_coefficients.hpp>
#include <boresight/plant/wind/wind_record.hpp>

namespace boresight::design {

/// A loop structure with the user's name for it.
struct NamedStructure {
  std::string name;
  control::LoopStructure structure;
};

/// The user's name for a state-space controller among loop structures.
inline constexpr std::string_view state_space_name = "SS";

/// The controllers among which a study chooses.
struct CandidateStructures {
  std::vector<NamedStructure> loops;
  /// Also a state-space controller (study_controllers), which starts from the best of the loops.
  bool state_space = false;
  /// Asked for by name: a study that can't design one refuses, instead of leaving it out.
  bool state_space_named = false;

  bool empty() const { return loops.empty() && !state_space; }
};

/// A controller (structure and gains) with the name of its structure.
struct NamedController {
  std::string name;
  control::Controller controller;
};

/// An alternative antenna that is consistent with the same evidence.
struct AlternativeAntenna {
  std::string name;
  std::vector<plant::AntennaChange> changes;
};

/// Ends of a range, in SI units or as factors on the antenna's own value.
struct Ends {
  double lower = 1.0, upper = 1.0;
};

/// Ranges from which the ensemble members are sampled. Factors on all structure frequencies (modes
/// and locked rotor) and on the oil stiffness; leakage rate in 1/s; viscous friction in N m s/rad.
struct MemberRanges {
  Ends structure_frequency, oil_stiffness, leakage_rate, viscous_friction;
};

/// Uncertainties of an antenna's parameters.
struct AntennaUncertainty {
  MemberRanges ranges;
  std::size_t random_samples = 24;  // samples of the ensemble, in addition to nominal and corners
  /// Relative standard uncertainties.
  double antenna_inertia = 0.0, motor_inertia = 0.0, wind_torque = 0.0;
};

/// All requirements and data for one axis of an antenna: SI, angles at the sky, without file
/// positions or text for a reader. io::mission_of creates it from a case file.
struct Mission {
  plant::Antenna antenna;
  AntennaUncertainty uncertainty;
  /// Alternative interpretations of the evidence, to compare a result with.
  std::vector<AlternativeAntenna> alternatives;

  WindCondition wind;  // of the design
  /// Winds of the site, weighted by their fraction of the time; empty if not known. They represent
  /// climate_parts by quadrature.
  std::vector<WeightedWind> climate;
  std::vector<ClimatePart> climate_parts;
  std::optional<plant::TorqueCoefficientTable> torque_table;
  /// A measured wind in which the antenna must track; if absent, a realisation of the design wind.
  std::optional<plant::WindRecord> wind_record;
  /// Direction of the dish. With a torque table it gives the torque coefficient of a measured wind.
  std::optional<plant::DishDirection> pointing;

  std::vector<PointingBand> bands;
  std::vector<PointingBudget> budgets;
  control::FrequencyBand rms_band{1e-4, 25.0};  // Hz
  /// Constraints without limits in gusts and the friction at standstill, which depend on the
  /// antenna: see constraints().
  Constraints stated_constraints;
  bool limits_gusts = false;
  Objective objective;
  std::optional<double> rms_goal;  // rad
  /// rad, of the boresight: largest limit cycle of a controller to recommend. See
  /// allowed_limit_cycle.
  std::optional<double> limit_cycle_amplitude;
  bool minimises_climate = false;  // the climate's mean square instead of one speed's

  CandidateStructures structures;  // to be tuned unless others are requested
  /// The usual structures with lag, with bounds for this antenna. Searches use them as starts for
  /// others.
  std::vector<NamedStructure> usual_structures;
  std::vector<NamedController> present_controllers;  // controllers in use on the antenna now
  /// Where the present gains are not known: the name of the present structure, one of the loops;
  /// empty if that is not known either.
  std::string present_structure;
  int starts = 0;          // of each search; 0: the tuner's default
  double max_disks = 0.0;  // per motor, of a matching study
};

/// Tracking problem of the mission's antenna with these changes, in its design wind.
/// @throws InvalidInput as plant::changed and plant::linear_plant.
TrackingProblem tracking_problem(const Mission& mission,
                                 const std::vector<plant::AntennaChange>& changes = {});
/// Tracking problem of another antenna in the mission's wind.
TrackingProblem tracking_problem(const Mission& mission, const plant::Antenna& antenna);

/// The constraints of a mission. Gusts, where limited, are limited to valve demands within the
/// stroke (plant::largest_demand) and to torques within plant::available_wind_torque. Those at
/// standstill, where given, have standstill_friction and encoder_edges.
/// @throws InvalidInput where friction and offset leave no torque; InfeasibleRequirement for a
/// limit_cycle_amplitude of less than half an encoder step, within which no loop senses motion.
Constraints constraints(const Mission& mission);

/// Mean wind speed (m/s) at which the mean wind torque equals plant::available_wind_torque. 0 if
/// the available torque is 0, infinite without mean torque.
double torque_limited_wind_speed(const Mission& mission);

/// Rms error per axis (rad) of the tightest pointing budget; 1 mdeg without a budget.
double tightest_budget(const Mission& mission);

/// Largest boresight amplitude (rad) of a limit cycle that does not exclude a controller: the
/// mission's limit_cycle_amplitude, else that of a sinusoid with the rms of the tightest budget.
double allowed_limit_cycle(const Mission& mission);

}  // namespace boresight::design
