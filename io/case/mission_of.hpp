#pragma once

#include <vector>

#include <boresight/design/problem/mission.hpp>
#include <boresight/io/case/case_declaration.hpp>

/// What a case asks of its antenna, as the design takes it.
namespace boresight::io {

/// Requirements of the case on its antenna. Alternative interpretations: the other convention of
/// the oil spring, the inertias printed elsewhere in the source, other assumed fractions of wind
/// and boresight.
/// @throws InvalidInput as antenna_of.
design::Mission mission_of(const Case& stated);

/// The structures of these names, or without names those that the case's [tuning] asks for, else
/// PI, LL, DPF, FULL, LL+L, FULL+L+C, the case's own and, if the case has a [simulation] that can
/// show its limit cycles, a state-space controller. design::state_space_name asks for the latter by
/// name; alone, beside the loops that no names would give. Where a static_encoder_error of 0 is
/// stated, only those with integral action (LoopStructure), unless named.
/// @throws InvalidInput as loop_structure, and for a name given twice.
design::CandidateStructures asked_structures(const Case& stated,
                                             std::vector<std::string> names = {});

/// The antenna of a case (antenna_of) with these changes, in the case's wind.
/// @throws InvalidInput as antenna_of, plant::changed and plant::linear_plant.
design::TrackingProblem make_problem(const Case& antenna,
                                     const std::vector<plant::AntennaChange>& changes = {});
/// Another antenna in the case's wind.
design::TrackingProblem make_problem(const Case& antenna, const plant::Antenna& other);

/// Mean wind speed (m/s) at which the mean wind torque uses all available wind torque
/// (available_wind_torque): the supply's torque less friction at the tracking rate and offset
/// torque. 0 if nothing is available, infinite without mean torque.
double torque_limited_wind_speed(const Case& antenna, const design::TrackingProblem& problem);

/// Constraints against saturation: valve demand within the valve's stroke (largest_demand), and
/// torque within the available wind torque, the supply's less friction and offset
/// (available_wind_torque).
/// @throws as design::constraints.
design::Constraints make_goals(const Case& antenna);
design::Objective make_objective(const Case& antenna);

/// The winds of the site with their fractions of the time; empty if the case does not state them.
std::vector<design::WeightedWind> make_climate(const Case& antenna);

std::vector<design::PointingBand> make_bands(const Case& antenna);
std::vector<design::PointingBudget> make_budgets(const Case& antenna);
/// Rms error per axis (rad) of the tightest of them; 1 mdeg if the case states none.
double tightest_budget(const Case& antenna);

}  // namespace boresight::io
