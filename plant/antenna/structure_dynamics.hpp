#pragma once

#include <variant>

#include <Eigen/Core>

#include <boresight/plant/antenna/antenna_plant.hpp>
#include <boresight/plant/linear/state_space.hpp>
#include <boresight/plant/modal/modal_system.hpp>

namespace boresight::plant {

/// The flexible antenna behind the gear spring, in one of two forms. Structure: bull gear, springs
/// and masses. VibrationModes: modes of the free antenna (pinions removed) as exported by a
/// finite-element program, reflected to the motor shaft. Their forces are gear_torque (N m) first,
/// then the wind's, one per patch of the dish. Their displacements are bull_gear_angle (the same
/// shape as gear_torque's force), encoder, `boresight` (rad of motor). One mode has frequency 0,
/// the rotation about the axis.
using StructureModel = std::variant<Structure, VibrationModes>;

/// The structure alone. Inputs gear_torque, then wind_torque (or the wind forces of the modes);
/// outputs bull_gear_angle, bull_gear_rate, encoder, `boresight`. States: angle and rate of the
/// bull gear, then of each mass; or the coordinate and rate of each mode.
/// @throws InvalidInput for an inertia or stiffness that is not positive, a damping below 0, or a
/// value that is not finite. Also for modes without the ports above, of inconsistent sizes, or
/// without exactly one of frequency 0.
StateSpace structure_dynamics(const StructureModel& structure);

/// What a turn of the whole antenna by one radian of motor adds to the states of
/// structure_dynamics(structure).
Eigen::VectorXd rigid_rotation(const StructureModel& structure);

/// Inertia of the whole antenna at the motor shaft (kg m2).
double antenna_inertia(const StructureModel& structure);

/// Energy of motion and of the springs in a state of structure_dynamics(structure) (N m rad).
/// @throws InvalidInput for a state of another length.
double structure_energy(const StructureModel& structure, const Eigen::VectorXd& state);

/// Converts bull gear, springs and masses to vibration modes with the same motion; wind force
/// wind_torque. Each mode keeps its own part of the damping matrix. Damping coupling between modes
/// is neglected, which is of second order in the damping ratios.
/// @throws as structure_dynamics; NumericalFailure if the eigenvalues do not converge.
VibrationModes to_vibration_modes(const Structure& structure);

}  // namespace boresight::plant
