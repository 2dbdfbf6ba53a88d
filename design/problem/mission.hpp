#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <boresight/control/controllers/control_law.hpp>
#include <boresight/design/problem/goals.hpp>
#include <boresight/design/problem/pointing_budget.hpp>
#include <boresight/design/problem/tracking_problem.hpp>
#include <boresight/design/problem/wind_climate.hpp>
#include <boresight/plant/antenna/antenna_change.hpp>
#include <boresight/plant/wind/torque_coefficients.hpp>
#include <boresight/plant/wind/wind_record.hpp>

namespace boresight::design {

/// A loop structure by the name that its user has for it.
struct NamedStructure {
  std::string name;
  control::LoopStructure structure;
};

/// A controller, a structure with its gains, by its structure's name.
struct NamedController {
  std::string name;
  control::ControlLaw law;
};

/// Another antenna that the same evidence allows.
struct AlternativeAntenna {
  std::string name;
  std::vector<plant::AntennaChange> changes;
};

/// The ends of a range, SI, or factors on the antenna's own number.
struct Ends {
  double lower = 1.0, upper = 1.0;
};

/// What members of the plant ensemble are drawn from: factors on all structure frequencies (modes
/// and locked rotor) and on the oil stiffness; 1/s; N m s/rad.
struct MemberRanges {
  Ends structure_frequency, oil_stiffness, leakage_rate, viscous_friction;
};

/// How far an antenna's numbers may be off.
struct AntennaUncertainty {
  MemberRanges ranges;
  std::size_t draws = 24;  // of the ensemble, beside nominal and corners
  /// Relative standard uncertainties.
  double antenna_inertia = 0.0, motor_inertia = 0.0, wind_torque = 0.0;
};

/// Everything that is asked of one axis of an antenna: SI, angles at the sky, without file
/// positions or text for a reader. io::mission_of makes it of a case file.
struct Mission {
  plant::Antenna antenna;
  AntennaUncertainty uncertainty;
  /// Other readings of the evidence that a result is held against.
  std::vector<AlternativeAntenna> alternatives;

  WindCondition wind;  // of the design
  /// Of the site, by their share of the time; empty: not known. The winds are climate_parts by
  /// quadrature.
  std::vector<WeightedWind> climate;
  std::vector<ClimatePart> climate_parts;
  std::optional<plant::TorqueCoefficientTable> torque_table;
  /// A measured wind that the antenna is to track in; none: one drawn of the design wind.
  std::optional<plant::WindRecord> wind_record;
  /// Where the dish points; with a torque table it gives a measured wind its coefficient.
  std::optional<plant::DishDirection> pointing;

  std::vector<PointingBand> bands;
  std::vector<PointingBudget> budgets;
  control::FrequencyBand rms_band{1e-4, 25.0};  // Hz
  /// Without limits in gusts, which follow from the antenna: see constraints().
  HardGoals stated_constraints;
  bool limits_gusts = false;
  SoftGoal objective;
  std::optional<double> rms_goal;  // rad
  bool minimises_climate = false;  // the climate's mean square instead of one speed's

  std::vector<NamedStructure> structures;  // to be tuned unless others are asked for
  /// The usual structures with lag, with bounds for this antenna: searches start others from them.
  std::vector<NamedStructure> usual_structures;
  std::vector<NamedController> present_controllers;  // that the antenna runs on now
  int starts = 0;                                    // of each search; 0: as the tuner has it
  double most_disks = 0.0;                           // on each motor, of a matching study
};

/// The antenna of a mission, so changed, in its design wind.
/// @throws InvalidInput as plant::changed and plant::linear_plant.
TrackingProblem tracking_problem(const Mission& mission,
                                 const std::vector<plant::AntennaChange>& changes = {});
/// Another antenna in the mission's wind.
TrackingProblem tracking_problem(const Mission& mission, const plant::Antenna& antenna);

/// The constraints; where gusts are limited, to valve demands within its stroke
/// (plant::largest_demand) and torques within plant::available_wind_torque.
/// @throws InvalidInput where friction and offset leave no torque.
HardGoals constraints(const Mission& mission);

/// Mean wind speed (m/s) at which the mean wind torque takes plant::available_wind_torque; 0 where
/// that is 0, infinite without mean torque.
double torque_limited_wind_speed(const Mission& mission);

/// Rms error of one axis (rad) of the tightest pointing budget; 1 mdeg without one.
double tightest_budget(const Mission& mission);

}  // namespace boresight::design
