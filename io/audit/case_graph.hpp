#pragma once

#include <boresight/design/audit/audit_graph.hpp>
#include <boresight/io/case/case_declaration.hpp>
#include <boresight/io/units/units.hpp>

namespace boresight::io {

/// Columns of a table printed in two systems of units.
enum class UnitColumn { either = -1, metric = 0, inch_pound = 1 };

/// The column a number with this text belongs to: inch-pound if its unit names an inch, foot,
/// pound, slug or the like; either where both columns would print the same unit (Hz, V, rpm, 1).
UnitColumn column_of(const std::string& text, Kind kind);

/// Every number of the case that others follow from or that follows from others, with what the
/// case prints of it. The ids are those that [[stated]] takes, and for inputs:
///   gear_train.density, part.NAME.radius, part.NAME.length, part.NAME.inertia,
///   assembly.NAME.inertia, gear_train.stage[I].driven_teeth and .driving_teeth, antenna.inertia,
///   motor.inertia, motor.displacement, motor.torque_efficiency, motor.volumetric_efficiency,
///   oil.density, oil.volume_1, oil.volume_2, tachometer.voltage, tachometer.shaft_speed,
///   tachometer.motor_teeth, tachometer.tachometer_teeth, friction.slow_ramp.up and .down.
/// A part or an assembly that is built from others counts as derived, its printed inertia as a
/// statement about it; so does a bulk modulus where there are lines to take it from. Teeth are
/// exact. Formulas are the plant library's.
/// @throws InvalidInput if two parts bear the same name.
design::AuditGraph case_graph(const Case& antenna);

}  // namespace boresight::io
