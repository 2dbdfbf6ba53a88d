#pragma once

#include <optional>
#include <string>
#include <vector>

#include <boresight/control/controllers/loop_structure.hpp>
#include <boresight/io/case/case_declaration.hpp>
#include <boresight/io/units/quantity.hpp>
#include <boresight/plant/antenna/friction.hpp>
#include <boresight/plant/antenna/gear_train.hpp>
#include <boresight/plant/antenna/hydraulics.hpp>

namespace boresight::io {

/// Quantities computed from the drive data of a case. SI, at the motor shaft.

std::vector<plant::GearStage> gear_stages(const Case& antenna);
double gear_ratio(const Case& antenna);

/// The antenna on its locked rotor, from which the bounds of the usual loop structures are derived.
control::DrivenLoad driven_load(const Case& antenna);

/// Inertia of a solid disk (kg m2) about its axis; value and standard uncertainty to first order.
Quantity solid_disk(const Quantity& radius, const Quantity& length, const Quantity& density);

/// The oil's bulk modulus (Pa) as stated, or the mean over the lines by their slosh frequencies,
/// which have the density in common; value and standard uncertainty to first order.
Quantity bulk_modulus_of(const OilEntry& oil);

plant::FrictionCurve friction_curve(const Case& antenna);
/// Slope of the friction curve at the tracking rate (N m s/rad of motor). A negative slope,
/// friction falling with rate, causes stick-slip.
double tracking_slope(const Case& antenna);
/// The same as the viscous friction of a linear plant, at least 0. Stability on a falling slope
/// needs the simulation, which has the whole curve.
double tracking_friction(const Case& antenna);
/// The motors and the oil between valve and motors, by the case's convention for the oil spring.
plant::HydraulicDrive hydraulic_drive(const Case& antenna);
/// Torque of all motors at the supply pressure (N m), return pressure not subtracted.
double supply_torque(const Case& antenna);

/// No-load rate of the motors (rad/s) with the valve fully open, by its rated flow; nothing if the
/// case does not state that flow. The flow scales with the square root of the drop over both edges.
/// Without load this drop is the supply pressure less `return_pressure` (none: 0). The volumetric
/// efficiency is excluded: without load nothing drives oil past the pistons, and under load that
/// flow is part of the leakage rate.
std::optional<Quantity> rated_stroke(const Case& antenna,
                                     const std::optional<Quantity>& return_pressure);
/// The same with simulation.return_pressure, else drive.return_pressure.
std::optional<Quantity> rated_stroke(const Case& antenna);

}  // namespace boresight::io
